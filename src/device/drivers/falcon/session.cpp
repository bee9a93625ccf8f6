#include "device/drivers/falcon/session.h"

namespace myotact::device::falcon {

namespace {

using std::chrono::milliseconds;

constexpr int kWaits = 5;     // of a millisecond each: then the reply, or the command, was lost
constexpr int kMostLeft = 8;  // replies to commands that were given up too early

}  // namespace

/// True: at least one good report was in it.
bool Session::take_transfer(milliseconds patience) noexcept {
  const std::size_t count = transport_.receive(transfer_, patience);
  reader_.take_transfer(std::span(transfer_).first(count));
  bool reported = false;
  while (const auto packet = reader_.next()) {
    const auto report = decode(*packet);
    if (!report) continue;
    exchange_.take(*report, now_ns());
    ++reports_;
    reported = true;
  }
  return reported;
}

void Session::exchange_once(const WantedForce& wanted) noexcept {
  transport_.send(exchange_.command(wanted, now_ns()));
  bool reported = false;
  for (int wait = 0; wait < kWaits && !reported && !transport_.is_gone(); ++wait)
    reported = take_transfer(milliseconds(1));
  // What else is there is newer: with one report an exchange, each exchange would act on one that is as many exchanges
  // old.
  for (int left = 0; left < kMostLeft && reported; ++left) reported = take_transfer(milliseconds(0));
}

void Session::rest() noexcept {
  constexpr int kTries = 2;  // one that is not taken waited long enough for those before it to be taken back
  for (int t = 0; t < kTries; ++t)
    if (transport_.send(encode(Command{{}, false}))) return;
}

}  // namespace myotact::device::falcon

#include "device/drivers/falcon/session.h"

namespace myotact::device::falcon {

namespace {

constexpr int kWaits = 5;  // of a millisecond each: then the reply, or the command, was lost

}  // namespace

/// True: at least one good report was in it.
bool Session::take_transfer() noexcept {
  const std::size_t count = transport_.receive(transfer_, std::chrono::milliseconds(1));
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

void Session::turn(const WantedForce& wanted) noexcept {
  transport_.send(exchange_.command(wanted, now_ns()));
  for (int wait = 0; wait < kWaits && !transport_.is_gone(); ++wait)
    if (take_transfer()) return;
}

void Session::rest() noexcept {
  transport_.send(encode(Command{{}, false}));
}

}  // namespace myotact::device::falcon

#include "device/drivers/touch/servo.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "realtime/periodic_loop.h"

namespace myotact::device::touch {

namespace {

void require_none(const Hdapi& api, const char* doing) {
  const Code error = api.take_error();
  if (error == kNone) return;
  throw Error(ExitStatus::Unavailable,
              fmt::format("the Touch's library cannot {}: {} ({:#06x}); end other programs that use the device, and "
                          "plug it in again",
                          doing, api.error_string(error), error));
}

}  // namespace

void Servo::add(ServoClient& client) {
  clients_.push_back(&client);
}

void Servo::remove(ServoClient& client) noexcept {
  stop();
  std::erase(clients_, &client);
}

void Servo::start(std::function<void(std::uint64_t)> tick) {
  stop();
  tick_ = std::move(tick);
  stopping_ = sent_last_ = false;
  api_.take_error();
  handle_ = api_.schedule_asynchronous(&Servo::on_tick, this, kDefaultPriority);
  require_none(api_, "take our servo function");
  api_.start_scheduler();
  try {
    require_none(api_, "start its servo loop");
  } catch (...) {
    api_.unschedule(handle_);
    throw;
  }
  is_ticking_ = true;
}

/// A servo thread that hangs sends nothing either; then we do not wait for ever.
void Servo::wait_for_last_frame() const noexcept {
  constexpr auto kPatience = std::chrono::milliseconds(100);
  const auto until = std::chrono::steady_clock::now() + kPatience;
  while (!sent_last_ && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void Servo::stop() noexcept {
  if (!is_ticking_) return;
  stopping_ = true;
  wait_for_last_frame();
  api_.stop_scheduler();
  api_.unschedule(handle_);
  api_.take_error();
  is_ticking_ = false;
}

unsigned int Servo::on_tick(void* self) noexcept {
  static_cast<Servo*>(self)->tick();
  return kCallbackContinues;
}

void Servo::tick() noexcept {
  const std::uint64_t now_ns = realtime::steady_now_ns();
  const bool is_last = stopping_;
  for (ServoClient* client : clients_) client->begin_frame(now_ns);
  if (!is_last) tick_(now_ns);
  for (ServoClient* client : clients_) client->end_frame(is_last);
  if (is_last) sent_last_ = true;
}

}  // namespace myotact::device::touch

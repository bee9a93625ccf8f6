#include "device/drivers/touch/servo.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "realtime/periodic_loop.h"

namespace myotact::device::touch {

namespace {

Error refusal(const Hdapi& api, const char* doing, Code error) {
  return {ExitStatus::Unavailable, fmt::format("the Touch's library cannot {}: {}; end other programs that use the "
                                               "device, and plug it in again",
                                               doing, api.text_of(error))};
}

/// Until the flag is set, a tenth of a second at most: a servo thread that hangs is not waited for.
void wait_for(const std::atomic<bool>& flag) {
  constexpr auto kPatience = std::chrono::milliseconds(100);
  const auto until = std::chrono::steady_clock::now() + kPatience;
  while (!flag && std::chrono::steady_clock::now() < until) std::this_thread::sleep_for(std::chrono::milliseconds(1));
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
  for (ServoClient* client : clients_) client->recover(hung_);
  hung_ = false;
  tick_ = std::move(tick);
  stopping_ = sent_last_ = has_ticked_ = false;
  api_.take_error();
  handle_ = api_.schedule_asynchronous(&Servo::on_tick, this, kDefaultPriority);
  if (const Code error = api_.take_error(); error != kNone) {
    api_.unschedule(handle_);
    api_.take_error();
    throw refusal(api_, "take our servo function", error);
  }
  is_ticking_ = true;
  api_.start_scheduler();
  wait_for(has_ticked_);
  if (has_ticked_) return;  // its errors are the frames' from now on
  if (const Code error = api_.take_error(); error != kNone) {
    stop();
    throw refusal(api_, "start its servo loop", error);
  }
}

void Servo::stop() noexcept {
  if (!is_ticking_) return;
  stopping_ = true;
  if (has_ticked_) wait_for(sent_last_);
  hung_ = has_ticked_ && !sent_last_;
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
  has_ticked_ = true;
  const std::uint64_t now_ns = realtime::steady_now_ns();
  const bool is_last = stopping_;
  for (ServoClient* client : clients_) client->begin_frame(now_ns);
  if (!is_last) tick_(now_ns);
  for (ServoClient* client : clients_) client->end_frame(is_last);
  if (is_last) sent_last_ = true;
}

}  // namespace myotact::device::touch

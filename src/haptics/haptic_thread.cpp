#include "haptics/haptic_thread.h"

#include "realtime/periodic_loop.h"

namespace myotact::haptics {

void HapticThread::start() {
  thread_ = std::thread([this] {
    permission_ = realtime::make_this_thread_real_time();
    running_.store(true, std::memory_order_release);
    running_.notify_one();
    run();
  });
  running_.wait(false, std::memory_order_acquire);
}

void HapticThread::stop() noexcept {
  if (!thread_.joinable()) return;
  stopping_.store(true, std::memory_order_relaxed);
  thread_.join();
  // The thread is gone: this one may send the last, empty command.
  loop_.stop_forces(true);
  loop_.tick(realtime::steady_now_ns());
  if (watchdog_ != nullptr) watchdog_->rest();
}

void HapticThread::run() noexcept {
  realtime::PeriodicLoop beat(kTickPeriod_ns);
  beat.start();
  std::uint64_t last_ns = 0;
  while (!stopping_.load(std::memory_order_relaxed)) {
    const realtime::PeriodicLoop::Wake wake = beat.wait();
    if (last_ns != 0) periods_.add(wake.now_ns - last_ns);
    last_ns = wake.now_ns;
    missed_.fetch_add(wake.missed, std::memory_order_relaxed);
    loop_.note_missed(wake.missed);
    if (watchdog_ != nullptr && watchdog_->tripped()) loop_.note_cut();
    loop_.tick(wake.now_ns);
    if (watchdog_ != nullptr) watchdog_->beat();
    count_.fetch_add(1, std::memory_order_relaxed);
    durations_.add(realtime::steady_now_ns() - wake.now_ns);
  }
}

}  // namespace myotact::haptics

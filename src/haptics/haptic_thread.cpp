#include "haptics/haptic_thread.h"

#include "realtime/periodic_loop.h"

namespace myotact::haptics {

namespace {

/// Deadlines that went by between two ticks of a servo clock.
std::uint64_t periods_between(std::uint64_t last_ns, std::uint64_t now_ns) noexcept {
  const std::uint64_t since_ns = last_ns != 0 && now_ns > last_ns ? now_ns - last_ns : 0;
  return since_ns < 2 * kTickPeriod_ns ? 0 : since_ns / kTickPeriod_ns - 1;
}

}  // namespace

HapticThread::HapticThread(std::span<HapticLoop* const> loops, realtime::Watchdog* watchdog, device::ServoClock* servo)
    : loops_(loops.begin(), loops.end()), watchdog_(watchdog), servo_(servo), loop_durations_(loops.size()) {}

HapticThread::HapticThread(HapticLoop& loop, realtime::Watchdog* watchdog, device::ServoClock* servo)
    : loops_{&loop}, watchdog_(watchdog), servo_(servo), loop_durations_(1) {}

void HapticThread::start() {
  if (servo_ != nullptr) {
    servo_->start([this](std::uint64_t now_ns) { round(now_ns, periods_between(last_ns_, now_ns)); });
    running_.store(true, std::memory_order_release);
    return;
  }
  thread_ = std::thread([this] {
    realtime::name_this_thread("haptics");
    permission_ = realtime::make_this_thread_real_time();
    running_.store(true, std::memory_order_release);
    running_.notify_one();
    run();
  });
  running_.wait(false, std::memory_order_acquire);
}

void HapticThread::stop() noexcept {
  if (!running_.exchange(false, std::memory_order_acq_rel)) return;
  stopping_.store(true, std::memory_order_relaxed);
  if (servo_ != nullptr) servo_->stop();
  if (thread_.joinable()) thread_.join();
  // No other thread ticks any more: this thread may send the last, empty commands.
  stop_forces(loops_, true);
  tick_all(loops_, realtime::steady_now_ns());
  if (watchdog_ != nullptr) watchdog_->rest();
}

/// One loop is a group of one: its tick counts from the wake, as the round does.
void HapticThread::tick_loops(std::uint64_t now_ns, std::uint64_t missed) noexcept {
  const bool cut = watchdog_ != nullptr && watchdog_->tripped();
  for (HapticLoop* loop : loops_) {
    loop->note_missed(missed);
    if (cut) loop->note_cut();
  }
  std::uint64_t begin_ns = now_ns;
  for (std::size_t i = 0; i < loops_.size(); ++i) {
    loops_[i]->tick(now_ns);
    share_stop(*loops_[i], loops_);
    const std::uint64_t end_ns = realtime::steady_now_ns();
    loop_durations_[i].add(end_ns - begin_ns);
    begin_ns = end_ns;
  }
}

void HapticThread::round(std::uint64_t now_ns, std::uint64_t missed) noexcept {
  if (last_ns_ != 0) periods_.add(now_ns - last_ns_);
  last_ns_ = now_ns;
  missed_.fetch_add(missed, std::memory_order_relaxed);
  tick_loops(now_ns, missed);
  if (watchdog_ != nullptr) watchdog_->beat();
  count_.fetch_add(1, std::memory_order_relaxed);
  durations_.add(realtime::steady_now_ns() - now_ns);
}

void HapticThread::run() noexcept {
  realtime::PeriodicLoop beat(kTickPeriod_ns);
  beat.start();
  while (!stopping_.load(std::memory_order_relaxed)) {
    const realtime::PeriodicLoop::Wake wake = beat.wait();
    round(wake.now_ns, wake.missed);
  }
}

}  // namespace myotact::haptics

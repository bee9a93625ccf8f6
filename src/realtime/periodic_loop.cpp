#include "realtime/periodic_loop.h"

#include <ctime>

namespace myotact::realtime {

namespace {

/// Sleeps up to this long before the deadline. Idle kernels wake within 40 us in 99 % of cases (measured, SCHED_FIFO);
/// longer spins cost processor time and make throttling more likely.
constexpr std::uint64_t kSpin_ns = 60'000;
constexpr std::uint64_t kNanosecondsPerSecond = 1'000'000'000;

void sleep_until(std::uint64_t time_ns) noexcept {
  timespec until{};
  until.tv_sec = static_cast<std::time_t>(time_ns / kNanosecondsPerSecond);
  until.tv_nsec = static_cast<long>(time_ns % kNanosecondsPerSecond);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) != 0) {
    if (steady_now_ns() >= time_ns) return;  // a signal woke us: the deadline stands
  }
}

}  // namespace

std::uint64_t steady_now_ns() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::uint64_t>(now.tv_sec) * kNanosecondsPerSecond + static_cast<std::uint64_t>(now.tv_nsec);
}

void PeriodicLoop::start() noexcept {
  deadline_ns_ = steady_now_ns() + period_ns_;
}

PeriodicLoop::Wake PeriodicLoop::wait() noexcept {
  if (steady_now_ns() + kSpin_ns < deadline_ns_) sleep_until(deadline_ns_ - kSpin_ns);
  Wake wake;
  do {
    wake.now_ns = steady_now_ns();
  } while (wake.now_ns < deadline_ns_);
  const std::uint64_t behind = (wake.now_ns - deadline_ns_) / period_ns_;
  wake.missed = behind > catch_up_ ? behind - catch_up_ : 0;
  deadline_ns_ += (wake.missed + 1) * period_ns_;
  return wake;
}

}  // namespace myotact::realtime

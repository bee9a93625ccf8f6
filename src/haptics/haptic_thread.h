#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

#include "haptics/haptic_loop.h"
#include "realtime/period_histogram.h"
#include "realtime/real_time_thread.h"
#include "realtime/watchdog.h"

namespace myotact::haptics {

/// Runs a loop free on the steady clock at 1 kHz, with real-time priority where the system permits.
class HapticThread {
 public:
  /// `loop` outlives the thread and is prepared before start().
  /// `watchdog`, which outlives the thread, is told of every tick; null: none.
  explicit HapticThread(HapticLoop& loop, realtime::Watchdog* watchdog = nullptr) : loop_(loop), watchdog_(watchdog) {}
  ~HapticThread() { stop(); }
  HapticThread(const HapticThread&) = delete;
  HapticThread& operator=(const HapticThread&) = delete;

  /// Returns when the thread runs. Once.
  void start();
  /// The force is zero when it returns. Any number of times.
  void stop() noexcept;

  /// After start(): why the thread has no real-time priority; empty when it was granted.
  const std::string& refused() const noexcept { return permission_.why_not; }
  // ---- any thread, while it runs
  const realtime::PeriodHistogram& periods() const noexcept { return periods_; }  // from tick to tick
  const realtime::PeriodHistogram& ticks() const noexcept { return durations_; }  // how long a tick takes
  std::uint64_t tick_count() const noexcept { return count_.load(std::memory_order_relaxed); }
  std::uint64_t missed_count() const noexcept { return missed_.load(std::memory_order_relaxed); }

 private:
  void run() noexcept;

  HapticLoop& loop_;
  realtime::Watchdog* watchdog_;
  realtime::RealTimePermission permission_;
  realtime::PeriodHistogram periods_;
  realtime::PeriodHistogram durations_;
  std::atomic<std::uint64_t> count_{0};
  std::atomic<std::uint64_t> missed_{0};
  std::atomic<bool> running_{false};
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace myotact::haptics

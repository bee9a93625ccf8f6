#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "device/device.h"
#include "haptics/haptic_group.h"
#include "realtime/period_histogram.h"
#include "realtime/real_time_thread.h"
#include "realtime/watchdog.h"

namespace myotact::haptics {

/// Runs the loops of a group of devices free on the steady clock at 1 kHz, one after the other at each deadline, with
/// real-time priority where the system permits; or at the ticks that a maker's library makes, in its thread.
class HapticThread {
 public:
  /// The loops outlive the thread and are prepared before start(). At least one.
  /// `watchdog`, which outlives the thread, is notified of every round; null: none. It guards all devices of the group.
  /// `servo`, which outlives it too: whose ticks these are; null: those of a thread of its own.
  explicit HapticThread(std::span<HapticLoop* const> loops, realtime::Watchdog* watchdog = nullptr,
                        device::ServoClock* servo = nullptr);
  explicit HapticThread(HapticLoop& loop, realtime::Watchdog* watchdog = nullptr, device::ServoClock* servo = nullptr);
  ~HapticThread() { stop(); }
  HapticThread(const HapticThread&) = delete;
  HapticThread& operator=(const HapticThread&) = delete;

  /// Returns when the thread runs. Once. Throws Error Unavailable: the maker's library gives no ticks.
  void start();
  /// All forces are zero when it returns. Any number of times.
  void stop() noexcept;

  /// After start(): why the thread has no real-time priority; empty when it was granted.
  const std::string& refused() const noexcept { return permission_.why_not; }
  // ---- any thread, while it runs
  const realtime::PeriodHistogram& periods() const noexcept { return periods_; }  // from round to round
  /// How long a round takes, from its wake.
  const realtime::PeriodHistogram& ticks() const noexcept { return durations_; }
  /// How long the tick of one loop takes; the first one's from the wake.
  const realtime::PeriodHistogram& ticks(std::size_t loop) const noexcept { return loop_durations_[loop]; }
  std::uint64_t tick_count() const noexcept { return count_.load(std::memory_order_relaxed); }  // rounds
  std::uint64_t missed_count() const noexcept { return missed_.load(std::memory_order_relaxed); }

 private:
  void run() noexcept;
  void round(std::uint64_t now_ns, std::uint64_t missed) noexcept;
  void tick_loops(std::uint64_t now_ns, std::uint64_t missed) noexcept;

  std::vector<HapticLoop*> loops_;
  realtime::Watchdog* watchdog_;
  device::ServoClock* servo_;
  realtime::RealTimePermission permission_;
  realtime::PeriodHistogram periods_;
  realtime::PeriodHistogram durations_;
  std::deque<realtime::PeriodHistogram> loop_durations_;  // one a loop; never moved
  std::uint64_t last_ns_ = 0;                             // when the last round began; of the thread that ticks
  std::atomic<std::uint64_t> count_{0};
  std::atomic<std::uint64_t> missed_{0};
  std::atomic<bool> running_{false};
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace myotact::haptics

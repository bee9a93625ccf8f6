#pragma once

#include <atomic>
#include <cstdint>

#include <sys/types.h>

#include "realtime/shared_page.h"

namespace myotact::realtime {

/// How another process takes the force from a device whose owner died or hangs. Called in the watchdog's process, again
/// and again while the owner hangs: no allocation, no lock, no exception.
class ForceCutout {
 public:
  virtual ~ForceCutout() = default;
  virtual void cut() noexcept = 0;
};

/// A small process that outlives this one by a moment and sees to zero force when it dies (kill -9, a crash) or hangs:
///
///   program  --- pipe, closed by the kernel when it ends, however it ends ---> watchdog: cut(), and end
///            --- beat() once a tick, one atomic store --> shared page -------> no beat for 60 ms: cut() until the next
///            <-- tripped() ---------------------------------------------------'
///
/// 60 ms and a look every 5 ms: zero force within 100 ms, also on a machine that is busy. A program that only hung goes
/// on, notified by tripped(), from zero force. The watchdog is a fork without exec: nothing can be missing at run time.
/// It is in a session of its own, so that neither Ctrl-C nor Ctrl-Z reaches it, and ends with the program.
class Watchdog {
 public:
  /// Forks, and returns when the watchdog stands on its own: before this process has other threads. `cutout` is used by
  /// the watchdog's copy of it. Throws std::system_error when the system gives no process, pipe or memory.
  explicit Watchdog(ForceCutout& cutout);
  /// The watchdog cuts the force once more and is gone when this returns.
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  // ---- haptic thread, real-time safe
  void beat() noexcept { page_->beats.fetch_add(1, std::memory_order_release); }
  /// Ticks end on purpose: silence is no fault until the next beat().
  void rest() noexcept { page_->beats.store(0, std::memory_order_release); }
  /// True once after the watchdog cut the force because no beat came.
  bool tripped() noexcept { return page_->tripped.exchange(false, std::memory_order_acq_rel); }

  pid_t process() const noexcept { return process_; }

 private:
  struct Page {
    std::atomic<std::uint64_t> beats{0};  // 0: no ticks yet, or no more
    std::atomic<bool> tripped{false};
    std::atomic<bool> ready{false};  // the watchdog stands on its own feet
  };
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

  [[noreturn]] void watch(int pipe_end, ForceCutout& cutout) noexcept;

  SharedPage<Page> page_;
  int pipe_ = -1;  // the end whose closing ends the watchdog
  pid_t process_ = -1;
};

}  // namespace myotact::realtime

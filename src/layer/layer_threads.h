#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>

#include "haptics/haptic_thread.h"
#include "layer/force_layer.h"
#include "realtime/period_histogram.h"
#include "realtime/watchdog.h"

namespace myotact::layer {

/// Runs a layer free on the wall clock: the engine's thread at the engine's own rate, the devices' thread at 1 kHz, and
/// one that only looks whether the engine still reports, and logs it when it does not. An engine that is slower than
/// its own step slows simulated time.
class LayerThreads {
 public:
  /// `watchdog`: of the devices, notified of every tick; null: none. All arguments outlive this.
  explicit LayerThreads(ForceLayer& layer, realtime::Watchdog* watchdog = nullptr);
  ~LayerThreads();
  LayerThreads(const LayerThreads&) = delete;
  LayerThreads& operator=(const LayerThreads&) = delete;

  /// Opens the devices; returns when all run. Once. Throws Error Unavailable.
  void start();
  /// Forces to zero first, then waits for the engine's step. Rethrows what ended the engine's thread, if anything did.
  void stop();

  // ---- any thread
  const haptics::HapticThread& devices() const noexcept { return devices_; }
  const realtime::PeriodHistogram& steps() const noexcept { return durations_; }  // how long the engine's steps take

 private:
  void join() noexcept;
  void run_engine();
  void watch_engine();

  ForceLayer& layer_;
  haptics::HapticThread devices_;
  std::thread engine_thread_, watch_thread_;
  std::atomic<bool> running_{false};
  std::mutex watch_mutex_;  // of the looking thread and stop() alone
  std::condition_variable wake_watch_;
  std::exception_ptr failure_;
  realtime::PeriodHistogram durations_;
};

}  // namespace myotact::layer

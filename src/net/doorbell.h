#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace myotact::net {

/// Wakes all threads that wait for news. Any thread but a haptic one.
class Doorbell {
 public:
  void ring() {
    {
      const std::lock_guard lock(mutex_);
      ++rings_;
    }
    rung_.notify_all();
  }

  /// Until it rang beyond `heard`, or `wait` is over; returns how often it rang so far.
  std::uint64_t wait(std::uint64_t heard, std::chrono::milliseconds wait) {
    std::unique_lock lock(mutex_);
    rung_.wait_for(lock, wait, [&] { return rings_ != heard; });
    return rings_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable rung_;
  std::uint64_t rings_ = 0;
};

}  // namespace myotact::net

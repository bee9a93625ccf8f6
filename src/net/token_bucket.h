#pragma once

#include <algorithm>
#include <chrono>

namespace myotact::net {

/// A steady rate with room for a burst of a tenth of a second. One thread.
class TokenBucket {
 public:
  explicit TokenBucket(double rate_per_s) : rate_per_s_(rate_per_s), tokens_(burst()) {}

  /// How long to wait before the next one is within the rate; it counts as taken.
  std::chrono::nanoseconds take(std::chrono::steady_clock::time_point now) {
    tokens_ = std::min(burst(), tokens_ + rate_per_s_ * std::chrono::duration<double>(now - last_).count()) - 1.0;
    last_ = now;
    if (tokens_ >= 0.0) return std::chrono::nanoseconds(0);
    return std::chrono::nanoseconds(static_cast<std::int64_t>(-1e9 * tokens_ / rate_per_s_));
  }

 private:
  double burst() const { return std::max(1.0, 0.1 * rate_per_s_); }

  double rate_per_s_;
  double tokens_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace myotact::net

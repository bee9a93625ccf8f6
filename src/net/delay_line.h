#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <random>

namespace myotact::net {

/// One direction of a link that is not there.
struct LinkSettings {
  double delay_s = 0.0;
  double jitter_s = 0.0;      // a message takes up to that much longer, all values as likely
  double stalls_per_s = 0.0;  // nothing arrives for a while: so often in the mean, at any time as likely
  double stall_s = 0.1;       // for so long
  std::uint64_t seed = 1;
};

/// A stream in order on a virtual clock, as TCP shows a slow network: what is late holds up all that follows, which
/// then comes at once. Holds at most `kMost` messages, far more than arrive in the longest delay; the oldest is lost
/// then. Same calls, same bits. One thread; allocates.
template <class T>
class DelayLine {
 public:
  static constexpr std::size_t kMost = 4096;

  explicit DelayLine(const LinkSettings& link) : link_(link), random_(link.seed) { stall_begin_ns_ = next_stall_ns(0); }

  /// `now_ns` never runs backwards.
  void send(std::uint64_t now_ns, const T& message) {
    arrives_ns_ = std::max(arrives_ns_, free_at_ns(now_ns) + to_ns(link_.delay_s + link_.jitter_s * unit()));
    if (on_the_way_.size() == kMost) on_the_way_.pop_front();
    on_the_way_.push_back({arrives_ns_, std::make_unique<T>(message)});
  }

  /// The newest of what has arrived since the last call, null: nothing has. Stays in place until the next call.
  const T* receive(std::uint64_t now_ns) {
    bool any = false;
    for (; !on_the_way_.empty() && on_the_way_.front().arrives_ns <= now_ns; on_the_way_.pop_front()) {
      newest_ = std::move(on_the_way_.front().message);
      any = true;
    }
    return any ? newest_.get() : nullptr;
  }

 private:
  struct Message {
    std::uint64_t arrives_ns;
    std::unique_ptr<T> message;
  };

  static std::uint64_t to_ns(double seconds) { return static_cast<std::uint64_t>(std::llround(1e9 * seconds)); }
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }  // the same with every library

  std::uint64_t next_stall_ns(std::uint64_t from_ns) {
    if (!(link_.stalls_per_s > 0.0)) return std::numeric_limits<std::uint64_t>::max();
    return from_ns + to_ns(-std::log(1.0 - unit()) / link_.stalls_per_s);
  }

  /// When what is sent now leaves: now, or at the end of the stall.
  std::uint64_t free_at_ns(std::uint64_t now_ns) {
    const std::uint64_t lasts_ns = to_ns(link_.stall_s);
    while (stall_begin_ns_ <= now_ns && now_ns - stall_begin_ns_ >= lasts_ns)
      stall_begin_ns_ = next_stall_ns(stall_begin_ns_ + lasts_ns);
    return stall_begin_ns_ <= now_ns ? stall_begin_ns_ + lasts_ns : now_ns;
  }

  LinkSettings link_;
  std::mt19937_64 random_;
  std::uint64_t stall_begin_ns_ = 0;
  std::uint64_t arrives_ns_ = 0;  // the newest message
  std::deque<Message> on_the_way_;
  std::unique_ptr<T> newest_;
};

}  // namespace myotact::net

#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace myotact::realtime {

/// Newest-wins channel: one writer, one reader, neither ever waits, values in between are lost.
///
///   writer: back() --publish()--> [ middle slot ] --update()--> front() :reader
///
/// Three slots change places through one atomic, so that a large T is filled and read in place, never copied.
template <class T>
class LatestValue {
 public:
  LatestValue() = default;
  /// All three slots start as copies of `initial`: for values that hold sized vectors.
  explicit LatestValue(const T& initial) : slots_{initial, initial, initial} {}
  LatestValue(const LatestValue&) = delete;
  LatestValue& operator=(const LatestValue&) = delete;

  /// Writer thread only: the slot to fill. It holds an old value of any age.
  T& back() noexcept { return slots_[back_]; }
  /// Writer thread only: makes the filled slot the newest.
  void publish() noexcept {
    back_ = middle_.exchange(static_cast<std::uint8_t>(back_ | kFresh), std::memory_order_acq_rel) & kSlot;
  }
  /// Writer thread only.
  void publish(const T& value) {
    back() = value;
    publish();
  }

  /// Reader thread only: brings the newest value to front(). False: nothing newer than front().
  bool update() noexcept {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kSlot;
    return true;
  }
  /// Reader thread only: the value of the last update(), unchanged until the next.
  const T& front() const noexcept { return slots_[front_]; }

 private:
  static constexpr std::uint8_t kFresh = 4;  // set: the middle slot was published and not yet read
  static constexpr std::uint8_t kSlot = 3;

  std::array<T, 3> slots_{};
  std::uint8_t back_ = 0;   // writer's
  std::uint8_t front_ = 1;  // reader's
  std::atomic<std::uint8_t> middle_{2};
};

}  // namespace myotact::realtime

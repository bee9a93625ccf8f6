#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace myotact::realtime {

/// Everything in order, up to a capacity: one writer, one reader, neither waits. What does not fit is dropped and
/// counted.
template <class T>
class BoundedFifo {
 public:
  explicit BoundedFifo(std::size_t capacity) : ring_(capacity + 1) {}  // one place stays empty: full differs from empty
  BoundedFifo(const BoundedFifo&) = delete;
  BoundedFifo& operator=(const BoundedFifo&) = delete;

  /// Writer thread only. False: full, the value is dropped.
  bool push(const T& value) noexcept {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (after(tail) == head_.load(std::memory_order_acquire)) {
      dropped_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    ring_[tail] = value;
    tail_.store(after(tail), std::memory_order_release);
    return true;
  }

  /// Reader thread only. False: empty, `value` is left as it was.
  bool pop(T& value) noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head == tail_.load(std::memory_order_acquire)) return false;
    value = ring_[head];
    head_.store(after(head), std::memory_order_release);
    return true;
  }

  std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }  // any thread

 private:
  std::size_t after(std::size_t place) const noexcept { return place + 1 == ring_.size() ? 0 : place + 1; }

  std::vector<T> ring_;
  std::atomic<std::size_t> head_{0};
  std::atomic<std::size_t> tail_{0};
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace myotact::realtime

#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace myotact::net {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");

/// Puts numbers one after the other into a fixed room, or at the end of a growing one. What does not fit is a mistake
/// of the program: the room is chosen by whoever knows what comes.
class ByteWriter {
 public:
  explicit ByteWriter(std::span<std::uint8_t> room) noexcept : room_(room) {}
  explicit ByteWriter(std::vector<std::uint8_t>& grows) noexcept : grows_(&grows) {}

  template <typename T>
  void put(const T& value) {
    static_assert(std::is_arithmetic_v<T>);
    put_bytes(reinterpret_cast<const std::uint8_t*>(&value), sizeof value);
  }
  template <typename T, std::size_t N>
  void put(const std::array<T, N>& values) {
    for (const T& value : values) put(value);
  }
  void put_bytes(const std::uint8_t* bytes, std::size_t count) {
    if (count == 0) return;
    if (grows_ != nullptr) {
      grows_->insert(grows_->end(), bytes, bytes + count);
    } else {
      std::memcpy(room_.data() + size_, bytes, count);
    }
    size_ += count;
  }
  std::size_t size() const noexcept { return size_; }

 private:
  std::span<std::uint8_t> room_;
  std::vector<std::uint8_t>* grows_ = nullptr;
  std::size_t size_ = 0;
};

/// Takes numbers one after the other; when too few bytes are left, everything from there on is 0 and ok() false.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) noexcept : left_(bytes) {}

  template <typename T>
  void get(T& value) noexcept {
    static_assert(std::is_arithmetic_v<T>);
    if (left_.size() < sizeof value) {
      ok_ = false;
      left_ = {};
      value = 0;
      return;
    }
    std::memcpy(&value, left_.data(), sizeof value);
    left_ = left_.subspan(sizeof value);
  }
  template <typename T, std::size_t N>
  void get(std::array<T, N>& values) noexcept {
    for (T& value : values) get(value);
  }
  /// The next `count` bytes, or none.
  std::span<const std::uint8_t> take(std::size_t count) noexcept {
    if (left_.size() < count) {
      ok_ = false;
      left_ = {};
      return {};
    }
    const auto taken = left_.first(count);
    left_ = left_.subspan(count);
    return taken;
  }

  bool ok() const noexcept { return ok_; }
  std::size_t left() const noexcept { return left_.size(); }
  /// All was there and nothing is left over.
  bool done() const noexcept { return ok_ && left_.empty(); }

 private:
  std::span<const std::uint8_t> left_;
  bool ok_ = true;
};

}  // namespace myotact::net

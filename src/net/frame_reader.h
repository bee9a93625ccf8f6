#pragma once

#include <optional>
#include <span>

#include "net/wire.h"

namespace myotact::net {

/// Cuts a stream of bytes into frames. Holds no more than one frame and what came with it; a bad header, check sum or
/// sequence number is its end.
class FrameReader {
 public:
  FrameReader();
  /// From now on longer payloads are refused before any of them came; at first: whatever their type ever has.
  void set_most_payload(std::size_t bytes) { most_payload_ = bytes; }

  /// Where the next bytes go; never empty. Frames returned before are invalid.
  std::span<std::uint8_t> room();
  void filled(std::size_t count) { end_ += count; }

  /// The next whole frame, valid until room(); nothing: more bytes are needed, or a fault was found.
  std::optional<Frame> next();
  WireFault fault() const { return fault_; }

 private:
  Bytes buffer_;
  std::size_t begin_ = 0, end_ = 0;  // of what came and was not returned yet
  std::size_t most_payload_ = kMostPayload;
  std::uint32_t sequence_ = 0;  // of the next frame
  WireFault fault_ = WireFault::None;
};

}  // namespace myotact::net

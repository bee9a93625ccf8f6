#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "net/frame_reader.h"
#include "net/small_frames.h"
#include "net/socket.h"

namespace myotact::net {

/// Frames to and from one peer, one after the other: for programs in lockstep, which wait for each other. One thread.
class FrameStream {
 public:
  /// `patience`: how long to wait for a frame. `stopped`: asked ten times a second whether to wait no longer.
  FrameStream(Socket socket, std::chrono::milliseconds patience, std::function<bool()> stopped = {});

  void set_patience(std::chrono::milliseconds patience) { patience_ = patience; }

  /// False: the peer is gone or takes nothing.
  bool write(FrameType type, std::uint8_t flags, std::span<const std::uint8_t> payload, std::uint64_t time_ns);
  bool write(const SmallFrame& frame, std::uint64_t time_ns) {
    return write(frame.type, frame.flags, frame.payload(), time_ns);
  }
  bool write_text(const std::string& text, std::uint64_t time_ns);  // as a Control

  /// The next frame, valid until the next call; nothing: why() states the reason.
  std::optional<Frame> read();
  const std::string& why() const { return why_; }

 private:
  Received wait_for_bytes(std::size_t& count);

  Socket socket_;
  std::chrono::milliseconds patience_;
  std::function<bool()> stopped_;
  FrameReader reader_;
  std::uint32_t sequence_ = 0;
  std::string why_;
};

}  // namespace myotact::net

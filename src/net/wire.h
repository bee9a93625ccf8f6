#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace myotact::net {

// What goes over the wire, byte for byte: README.md of this folder. All numbers little-endian.

inline constexpr std::uint8_t kMagic = 0x4D, kWireVersion = 1;
inline constexpr std::size_t kHeaderBytes = 24;
inline constexpr std::size_t kSmallPayload = 104;  // of frames that a real-time exchange needs: 128 bytes in all
inline constexpr std::size_t kMostPayload = 1u << 20;
inline constexpr std::size_t kMostControl = 1u << 16;

enum class FrameType : std::uint8_t {
  Hello = 1,
  Welcome = 2,
  ToolState = 3,
  ToolContact = 4,
  ToolGrip = 5,
  Force = 6,
  Event = 7,
  Ping = 8,
  Pong = 9,
  Bye = 10,
  LocalModel = 16,
  SceneKey = 17,
  SceneDelta = 18,
  BonePoses = 19,
  Readings = 20,
  Mesh = 21,
  InForce = 22,
  Picture = 23,
  PictureSeen = 24,
  Control = 32,
};

struct FrameHeader {
  FrameType type = FrameType::Bye;
  std::uint8_t flags = 0;
  std::uint32_t length = 0;    // of the payload
  std::uint32_t sequence = 0;  // of the frames of one connection in one direction: 0, 1, 2 ...
  std::uint64_t time_ns = 0;   // by the sender's steady clock, or the virtual one
};

/// A frame within a buffer that belongs to somebody else.
struct Frame {
  FrameHeader header;
  std::span<const std::uint8_t> payload;
};

/// What is wrong with a frame.
enum class WireFault : std::uint8_t { None, Magic, Version, Type, Length, Crc, Sequence, Text, Value };
inline constexpr std::size_t kWireFaults = 9;
const char* describe(WireFault fault) noexcept;

using Bytes = std::vector<std::uint8_t>;
using HeaderBytes = std::array<std::uint8_t, kHeaderBytes>;

/// The header with length and check sum of the payload that follows it.
HeaderBytes header_bytes(const FrameHeader& header, std::span<const std::uint8_t> payload) noexcept;

/// Reads a header; a payload longer than its type ever is, is refused before any of it has come.
WireFault parse_header(std::span<const std::uint8_t, kHeaderBytes> bytes, FrameHeader& header) noexcept;

/// Whether header and payload are what their sender sent.
bool has_right_crc(std::span<const std::uint8_t, kHeaderBytes> header, std::span<const std::uint8_t> payload) noexcept;

/// Well-formed UTF-8 (RFC 3629), without the byte 0.
bool is_utf8(std::span<const std::uint8_t> text) noexcept;

}  // namespace myotact::net

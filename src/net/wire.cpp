#include "net/wire.h"

#include <cstring>

#include <zlib.h>

#include "net/byte_cursor.h"

namespace myotact::net {

namespace {

constexpr std::size_t kCrcAt = 20;

std::uint32_t crc_of(std::span<const std::uint8_t> header, std::span<const std::uint8_t> payload) noexcept {
  uLong crc = crc32(0, header.data(), static_cast<uInt>(kCrcAt));
  if (!payload.empty()) crc = crc32(crc, payload.data(), static_cast<uInt>(payload.size()));
  return static_cast<std::uint32_t>(crc);
}

/// The longest payload of a type; nothing: there is no such type.
std::optional<std::size_t> most_of(std::uint8_t type) noexcept {
  switch (static_cast<FrameType>(type)) {
    case FrameType::Hello:
    case FrameType::Welcome:
    case FrameType::ToolState:
    case FrameType::ToolContact:
    case FrameType::ToolGrip:
    case FrameType::Force:
    case FrameType::Event:
    case FrameType::Ping:
    case FrameType::Pong:
    case FrameType::Bye:
    case FrameType::InForce:
    case FrameType::PictureSeen:
      return kSmallPayload;
    case FrameType::LocalModel:
    case FrameType::SceneKey:
    case FrameType::SceneDelta:
    case FrameType::BonePoses:
    case FrameType::Readings:
    case FrameType::Mesh:
    case FrameType::Picture:
      return kMostPayload;
    case FrameType::Control:
      return kMostControl;
  }
  return std::nullopt;
}

}  // namespace

const char* describe(WireFault fault) noexcept {
  constexpr std::array<const char*, kWireFaults> kTexts = {
      "nothing",
      "it does not begin with the byte 0x4D",
      "its version is not 1",
      "its type is unknown",
      "its length is beyond what its type may have",
      "its check sum is wrong",
      "its sequence number is not the next one",
      "its text is not UTF-8",
      "a number in it is out of its range",
  };
  return kTexts[static_cast<std::size_t>(fault)];
}

HeaderBytes header_bytes(const FrameHeader& header, std::span<const std::uint8_t> payload) noexcept {
  HeaderBytes bytes{};
  ByteWriter out(bytes);
  out.put(kMagic);
  out.put(kWireVersion);
  out.put(static_cast<std::uint8_t>(header.type));
  out.put(header.flags);
  out.put(static_cast<std::uint32_t>(payload.size()));
  out.put(header.sequence);
  out.put(header.time_ns);
  out.put(crc_of(bytes, payload));
  return bytes;
}

WireFault parse_header(std::span<const std::uint8_t, kHeaderBytes> bytes, FrameHeader& header) noexcept {
  ByteReader in(bytes);
  std::uint8_t magic = 0, version = 0, type = 0;
  in.get(magic);
  in.get(version);
  in.get(type);
  if (magic != kMagic) return WireFault::Magic;
  if (version != kWireVersion) return WireFault::Version;
  const auto most = most_of(type);
  if (!most) return WireFault::Type;
  header.type = static_cast<FrameType>(type);
  in.get(header.flags);
  in.get(header.length);
  in.get(header.sequence);
  in.get(header.time_ns);
  return header.length > *most ? WireFault::Length : WireFault::None;
}

bool has_right_crc(std::span<const std::uint8_t, kHeaderBytes> header, std::span<const std::uint8_t> payload) noexcept {
  std::uint32_t received = 0;
  std::memcpy(&received, header.data() + kCrcAt, sizeof received);
  return received == crc_of(header, payload);
}

bool is_utf8(std::span<const std::uint8_t> text) noexcept {
  std::size_t i = 0;
  while (i < text.size()) {
    const std::uint8_t lead = text[i++];
    if (lead == 0) return false;
    if (lead < 0x80) continue;
    int more = 0;
    std::uint32_t point = 0, least = 0;
    if ((lead & 0xE0) == 0xC0) {
      more = 1, point = lead & 0x1Fu, least = 0x80;
    } else if ((lead & 0xF0) == 0xE0) {
      more = 2, point = lead & 0x0Fu, least = 0x800;
    } else if ((lead & 0xF8) == 0xF0) {
      more = 3, point = lead & 0x07u, least = 0x10000;
    } else {
      return false;
    }
    for (; more > 0; --more) {
      if (i >= text.size() || (text[i] & 0xC0) != 0x80) return false;
      point = point << 6 | (text[i++] & 0x3Fu);
    }
    const bool is_surrogate = point >= 0xD800 && point <= 0xDFFF;
    if (point < least || point > 0x10FFFF || is_surrogate) return false;
  }
  return true;
}

}  // namespace myotact::net

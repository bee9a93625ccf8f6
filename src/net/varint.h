#pragma once

#include <cstdint>

#include "net/byte_cursor.h"
#include "net/wire.h"

namespace myotact::net {

/// 7 bits a byte, the lowest first; the sign in the lowest bit, so that small numbers are short.
inline void put_varint(Bytes& out, std::int64_t value) {
  auto zigzag = static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63);
  while (zigzag >= 0x80) {
    out.push_back(static_cast<std::uint8_t>(zigzag | 0x80));
    zigzag >>= 7;
  }
  out.push_back(static_cast<std::uint8_t>(zigzag));
}

/// False: cut off, or longer than a difference between two numbers of 32 bits ever is.
inline bool get_varint(ByteReader& in, std::int64_t& value) {
  constexpr int kMostBits = 35;
  std::uint64_t zigzag = 0;
  for (int shift = 0; shift < kMostBits; shift += 7) {
    std::uint8_t byte = 0;
    in.get(byte);
    zigzag |= std::uint64_t{byte & 0x7Fu} << shift;
    if ((byte & 0x80) != 0) continue;
    value = static_cast<std::int64_t>(zigzag >> 1) ^ -static_cast<std::int64_t>(zigzag & 1);
    return in.ok();
  }
  return false;
}

}  // namespace myotact::net

#include <algorithm>
#include <array>

#include "fuzz/check.h"
#include "net/scene_decoder.h"

// The bytes as frames of a scene whose check sums are right: {type, length of 16 bits, payload} one after the other.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace myotact;
  constexpr std::array<net::FrameType, 5> kTypes = {net::FrameType::SceneKey, net::FrameType::SceneDelta,
                                                    net::FrameType::BonePoses, net::FrameType::Readings,
                                                    net::FrameType::InForce};
  std::span<const std::uint8_t> bytes(data, size);
  net::SceneDecoder decoder;
  while (bytes.size() >= 3) {
    net::Frame frame;
    frame.header.type = kTypes[bytes[0] % kTypes.size()];
    const std::size_t length = std::min(bytes[1] + 256u * std::size_t{bytes[2]}, bytes.size() - 3);
    frame.payload = bytes.subspan(3, length);
    bytes = bytes.subspan(3 + length);
    if (!decoder.take(frame)) return 0;
    testing::require(decoder.frame().skins_world_m.size() <= 256);
  }
  return 0;
}

#include <algorithm>

#include "fuzz/check.h"
#include "net/frame_reader.h"
#include "net/small_frames.h"
#include "net/tool_state_frames.h"

namespace {

using namespace myotact;

/// What decodes is what encodes to the same bytes.
template <typename Message>
void check_small(std::span<const std::uint8_t> payload) {
  Message message;
  if (!net::decode(payload, message)) return;
  const net::SmallFrame again = net::encode(message);
  testing::require(std::ranges::equal(again.payload(), payload));
}

void check_frame(const net::Frame& frame, net::ToolStateJoiner& joiner) {
  check_small<net::Hello>(frame.payload);
  check_small<net::Welcome>(frame.payload);
  check_small<net::ForceAnswer>(frame.payload);
  check_small<net::Event>(frame.payload);
  check_small<net::Ping>(frame.payload);
  check_small<net::Pong>(frame.payload);
  check_small<net::Bye>(frame.payload);
  if (!joiner.take(frame)) return;
  for (const double place : joiner.state().tool_position_world_m) testing::require(place >= -1e3 && place <= 1e3);
  for (const double place : joiner.state().contact.target_world_m) testing::require(place >= -1e3 && place <= 1e3);
  testing::require(joiner.state().contact.stiffness_N_m >= 0.0);
}

/// The bytes as a peer might send them. No frame is longer than its type may be.
void read_stream(std::span<const std::uint8_t> bytes, net::ToolStateJoiner& joiner) {
  net::FrameReader reader;
  while (!bytes.empty() && reader.fault() == net::WireFault::None) {
    const auto room = reader.room();
    testing::require(!room.empty());
    const std::size_t piece = std::min({room.size(), bytes.size(), std::size_t{1} + bytes.front()});
    std::copy_n(bytes.begin(), piece, room.begin());
    reader.filled(piece);
    bytes = bytes.subspan(piece);
    while (const auto frame = reader.next()) check_frame(*frame, joiner);
  }
}

/// The bytes as payloads of frames whose check sums are right: {type, flags, length, payload} one after the other.
void read_payloads(std::span<const std::uint8_t> bytes, net::ToolStateJoiner& joiner) {
  while (bytes.size() >= 3) {
    net::Frame frame;
    frame.header.type = static_cast<net::FrameType>(bytes[0]);
    frame.header.flags = bytes[1];
    const std::size_t size = std::min<std::size_t>(bytes[2], bytes.size() - 3);
    frame.payload = bytes.subspan(3, size);
    bytes = bytes.subspan(3 + size);
    check_frame(frame, joiner);
  }
}

}  // namespace

// Frames of hands and of the handshake, from a stream of bytes and one by one.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  net::ToolStateJoiner joiner;
  read_stream({data, size}, joiner);
  read_payloads({data, size}, joiner);
  return 0;
}

#include "net/frame_stream.h"

#include <utility>

namespace myotact::net {

FrameStream::FrameStream(Socket socket, std::chrono::milliseconds patience) : socket_(std::move(socket)) {
  set_patience(socket_, patience);
}

bool FrameStream::write(FrameType type, std::uint8_t flags, std::span<const std::uint8_t> payload,
                        std::uint64_t time_ns) {
  constexpr std::chrono::milliseconds kPatience(2000);
  FrameHeader header;
  header.type = type;
  header.flags = flags;
  header.sequence = sequence_++;
  header.time_ns = time_ns;
  return send(socket_, header_bytes(header, payload), payload, false, kPatience) == Sent::All;
}

bool FrameStream::write_text(const std::string& text, std::uint64_t time_ns) {
  return write(FrameType::Control, 0, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, time_ns);
}

std::optional<Frame> FrameStream::read() {
  for (;;) {
    if (const auto frame = reader_.next()) return frame;
    if (reader_.fault() != WireFault::None) {
      why_ = describe(reader_.fault());
      return std::nullopt;
    }
    std::size_t count = 0;
    const Received received = receive(socket_, reader_.room(), count);
    if (received == Received::Some) {
      reader_.filled(count);
      continue;
    }
    why_ = received == Received::Closed ? "the other side closed the connection" : "the other side is silent";
    return std::nullopt;
  }
}

}  // namespace myotact::net

#include "net/frame_stream.h"

#include <algorithm>
#include <utility>

namespace myotact::net {

namespace {

constexpr std::chrono::milliseconds kLook(100);

}  // namespace

FrameStream::FrameStream(Socket socket, std::chrono::milliseconds patience, std::function<bool()> stopped)
    : socket_(std::move(socket)), patience_(patience), stopped_(std::move(stopped)) {
  net::set_patience(socket_, std::min(patience, kLook));
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

Received FrameStream::wait_for_bytes(std::size_t& count) {
  const auto until = std::chrono::steady_clock::now() + patience_;
  for (;;) {
    const Received received = receive(socket_, reader_.room(), count);
    const bool waits_on = std::chrono::steady_clock::now() < until && !(stopped_ && stopped_());
    if (received != Received::TimedOut || !waits_on) return received;
  }
}

std::optional<Frame> FrameStream::read() {
  for (;;) {
    if (const auto frame = reader_.next()) return frame;
    if (reader_.fault() != WireFault::None) {
      why_ = describe(reader_.fault());
      return std::nullopt;
    }
    std::size_t count = 0;
    const Received received = wait_for_bytes(count);
    if (received == Received::Some) {
      reader_.filled(count);
      continue;
    }
    why_ = received == Received::Closed ? "the other side closed the connection" : "the other side is silent";
    return std::nullopt;
  }
}

}  // namespace myotact::net

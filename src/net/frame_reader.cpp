#include "net/frame_reader.h"

#include <algorithm>
#include <cstring>

namespace myotact::net {

namespace {

constexpr std::size_t kUsualRoom = 1u << 14;  // some small frames, or most of a local model

}  // namespace

FrameReader::FrameReader() : buffer_(kUsualRoom) {}

std::span<std::uint8_t> FrameReader::room() {
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  if (end_ == buffer_.size()) {  // a longer frame; its header has been found sound
    buffer_.resize(std::min(2 * buffer_.size(), kHeaderBytes + kMostPayload));
  }
  return std::span(buffer_).subspan(end_);
}

std::optional<Frame> FrameReader::next() {
  if (fault_ != WireFault::None || end_ - begin_ < kHeaderBytes) return std::nullopt;
  const auto bytes = std::span<const std::uint8_t>(buffer_).subspan(begin_, end_ - begin_);
  const auto header_part = bytes.first<kHeaderBytes>();
  Frame frame;
  fault_ = parse_header(header_part, frame.header);
  if (fault_ == WireFault::None && frame.header.length > most_payload_) fault_ = WireFault::Length;
  if (fault_ != WireFault::None || bytes.size() < kHeaderBytes + frame.header.length) return std::nullopt;
  frame.payload = bytes.subspan(kHeaderBytes, frame.header.length);
  if (!has_right_crc(header_part, frame.payload)) {
    fault_ = WireFault::Crc;
  } else if (frame.header.sequence != sequence_) {
    fault_ = WireFault::Sequence;
  } else if (frame.header.type == FrameType::Control && !is_utf8(frame.payload)) {
    fault_ = WireFault::Text;
  }
  if (fault_ != WireFault::None) return std::nullopt;
  ++sequence_;
  begin_ += kHeaderBytes + frame.payload.size();
  return frame;
}

}  // namespace myotact::net

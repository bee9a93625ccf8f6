#include "net/frame_reader.h"

#include <algorithm>

#include <gtest/gtest.h>

// A stream that is cut, spoilt or too long, and the frames that are told all the same.

namespace myotact::net {
namespace {

Bytes streamed_frame(FrameType type, std::uint32_t sequence, const Bytes& payload) {
  FrameHeader header;
  header.type = type;
  header.flags = 5;
  header.sequence = sequence;
  header.time_ns = 0x0102030405060708u;
  const HeaderBytes head = header_bytes(header, payload);
  Bytes bytes(head.begin(), head.end());
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  return bytes;
}

/// As much of it as the reader has room for at a time; nothing is told meanwhile.
void pour(std::span<const std::uint8_t> bytes, FrameReader& reader) {
  while (!bytes.empty()) {
    const auto room = reader.room();
    ASSERT_FALSE(room.empty());
    const std::size_t count = std::min(room.size(), bytes.size());
    std::copy_n(bytes.begin(), count, room.begin());
    reader.filled(count);
    bytes = bytes.subspan(count);
    ASSERT_TRUE(bytes.empty() || !reader.next());
  }
}

TEST(FrameReader, FindsEveryBitThatIsWrong) {
  const Bytes sound = streamed_frame(FrameType::Ping, 0, {1, 2, 3, 4, 5, 6, 7, 8});
  for (std::size_t bit = 0; bit < 8 * sound.size(); ++bit) {
    Bytes spoilt = sound;
    spoilt[bit / 8] = static_cast<std::uint8_t>(spoilt[bit / 8] ^ (1u << bit % 8));
    FrameReader reader;
    pour(spoilt, reader);
    EXPECT_FALSE(reader.next()) << "bit " << bit;
  }
}

TEST(FrameReader, WaitsForTheRestWhereverAFrameIsCut) {
  const Bytes payload = {9, 8, 7, 6, 5, 4, 3, 2};
  const Bytes sound = streamed_frame(FrameType::Ping, 0, payload);
  for (std::size_t cut = 0; cut < sound.size(); ++cut) {
    FrameReader reader;
    pour(std::span(sound).first(cut), reader);
    EXPECT_FALSE(reader.next()) << cut;
    EXPECT_EQ(reader.fault(), WireFault::None) << cut;
    pour(std::span(sound).subspan(cut), reader);
    const auto frame = reader.next();
    ASSERT_TRUE(frame) << cut;
    EXPECT_TRUE(std::equal(frame->payload.begin(), frame->payload.end(), payload.begin(), payload.end()));
    EXPECT_EQ(frame->header.flags, 5);
    EXPECT_EQ(frame->header.time_ns, 0x0102030405060708u);
  }
}

TEST(FrameReader, TellsWhatCameBeforeAFaultAndNothingAfterIt) {
  Bytes stream = streamed_frame(FrameType::Ping, 0, Bytes(8, 1));
  Bytes spoilt = streamed_frame(FrameType::Ping, 1, Bytes(8, 2));
  spoilt.back() ^= 1u;
  const Bytes sound = streamed_frame(FrameType::Ping, 1, Bytes(8, 3));
  stream.insert(stream.end(), spoilt.begin(), spoilt.end());
  stream.insert(stream.end(), sound.begin(), sound.end());
  FrameReader reader;
  std::copy(stream.begin(), stream.end(), reader.room().begin());
  reader.filled(stream.size());
  const auto first = reader.next();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->payload[0], 1);
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.fault(), WireFault::Crc);
}

TEST(FrameReader, AFrameThatIsMissingOrComesTwiceIsAFault) {
  for (const std::uint32_t second : {0u, 2u}) {
    FrameReader reader;
    pour(streamed_frame(FrameType::Ping, 0, Bytes(8)), reader);
    ASSERT_TRUE(reader.next());
    pour(streamed_frame(FrameType::Ping, second, Bytes(8)), reader);
    EXPECT_FALSE(reader.next());
    EXPECT_EQ(reader.fault(), WireFault::Sequence) << second;
  }
}

/// The longest payload of each type, from the table in the format's description.
TEST(FrameReader, TakesTheLongestPayloadOfEachTypeAndNotAByteMore) {
  struct Row {
    int first, last;
    std::size_t most;
  };
  for (const Row& row : {Row{1, 10, 104}, Row{16, 21, std::size_t{1} << 20}, Row{22, 22, 104}, Row{32, 32, 65536}}) {
    for (int type = row.first; type <= row.last; ++type) {
      FrameReader reader;
      pour(streamed_frame(static_cast<FrameType>(type), 0, Bytes(row.most, ' ')), reader);
      const auto frame = reader.next();
      ASSERT_TRUE(frame) << type;
      EXPECT_EQ(frame->payload.size(), row.most);
      pour(streamed_frame(FrameType::Ping, 1, Bytes(8)), reader);
      EXPECT_TRUE(reader.next()) << "after the longest one of type " << type;
      const Bytes longer = streamed_frame(static_cast<FrameType>(type), 2, Bytes(row.most + 1, ' '));
      pour(std::span(longer).first(kHeaderBytes), reader);
      EXPECT_FALSE(reader.next());
      EXPECT_EQ(reader.fault(), WireFault::Length) << type;
    }
  }
}

TEST(FrameReader, ALimitHoldsUntilItIsLifted) {
  FrameReader reader;
  reader.set_most_payload(100);
  pour(streamed_frame(FrameType::Control, 0, Bytes(100, 'a')), reader);
  EXPECT_TRUE(reader.next());
  reader.set_most_payload(kMostControl);
  pour(streamed_frame(FrameType::Control, 1, Bytes(101, 'a')), reader);
  EXPECT_TRUE(reader.next());
  reader.set_most_payload(100);
  pour(streamed_frame(FrameType::Control, 2, Bytes(101, 'a')), reader);
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.fault(), WireFault::Length);
}

}  // namespace
}  // namespace myotact::net

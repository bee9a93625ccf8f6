#include "device/drivers/falcon/packet.h"

#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

// Byte vectors: worked by hand from the published layout; "JFKP" is the example that its authors give (-1447).

namespace myotact::device::falcon {
namespace {

Packet packet_of(const std::string& text) {
  Packet packet{};
  EXPECT_EQ(text.size(), packet.size());
  std::copy(text.begin(), text.end(), packet.begin());
  return packet;
}

std::string text_of(const Packet& packet) {
  return {packet.begin(), packet.end()};
}

/// As the serial chip sends it: two bytes of status first.
std::vector<std::uint8_t> transfer_of(const std::string& text) {
  std::vector<std::uint8_t> bytes = {0x01, 0x60};
  for (const char letter : text) bytes.push_back(static_cast<std::uint8_t>(letter));
  return bytes;
}

TEST(FalconPacket, ACommandIsItsPublishedBytes) {
  EXPECT_EQ(text_of(encode(Command{{0, 0, 0}, false})), "<AAAAAAAAAAAAAA>");
  EXPECT_EQ(text_of(encode(Command{{0, 0, 0}, true})), "<AAAAAAAAAAAABA>");
  EXPECT_EQ(text_of(encode(Command{{-1447, 1, 4095}, true})), "<JFKPBAAAPPPABA>");
}

TEST(FalconPacket, MoreThanAMotorTakesIsCutNotWrapped) {
  const Command cut = decode_command(encode(Command{{32767, -32768, 4096}, true}));
  EXPECT_EQ(cut.motor_counts, (std::array<std::int16_t, 3>{4095, -4095, 4095}));
}

TEST(FalconPacket, AReportIsReadFromItsPublishedBytes) {
  const auto report =
      decode(packet_of("<JFKPAAAABAAAuA>"));  // 'u' = 0x41 + 0x34: encoders 1 and 2 homed, middle button
  ASSERT_TRUE(report);
  EXPECT_EQ(report->encoder_counts, (std::array<std::int16_t, 3>{-1447, 0, 1}));
  EXPECT_EQ(report->is_homed, (std::array{true, true, false}));
  EXPECT_FALSE(report->all_homed());
  EXPECT_EQ(report->buttons, 4);
}

TEST(FalconPacket, AllButtonsWithAllHomedGoBeyondTheLettersOfNibbles) {
  Report report;
  report.is_homed = {true, true, true};
  report.buttons = 0xf;
  const Packet packet = encode(report);
  EXPECT_EQ(packet[13], 0x41 + 0x7f);
  ASSERT_TRUE(decode(packet));
  EXPECT_TRUE(decode(packet)->all_homed());
  EXPECT_EQ(decode(packet)->buttons, 0xf);
}

TEST(FalconPacket, WhatIsNoReportIsRefused) {
  for (const char* text :
       {"xJFKPAAAABAAAuA>", "<JFKPAAAABAAAuAx", "<@FKPAAAABAAAuA>", "<JFKPAAQABAAAuA>", "<JFKPAAAABAAA@A>"})
    EXPECT_FALSE(decode(packet_of(text))) << text;
}

TEST(FalconPacket, EveryNumberGoesThereAndBack) {
  for (int value = -32768; value <= 32767; value += 7) {
    Report report;
    report.encoder_counts = {static_cast<std::int16_t>(value), 0, static_cast<std::int16_t>(-value - 1)};
    ASSERT_TRUE(decode(encode(report)));
    EXPECT_EQ(decode(encode(report))->encoder_counts, report.encoder_counts);
  }
}

TEST(FalconPacketReader, JoinsPartsAndPartsWhatIsJoined) {
  PacketReader reader;
  reader.take_transfer(transfer_of("<JFKPAA"));
  EXPECT_FALSE(reader.next());
  reader.take_transfer(transfer_of(""));  // nothing but status
  reader.take_transfer(transfer_of("AABAAAuA><AAAAAAAAAAAAAA>"));
  EXPECT_EQ(text_of(reader.next().value()), "<JFKPAAAABAAAuA>");
  EXPECT_EQ(text_of(reader.next().value()), "<AAAAAAAAAAAAAA>");
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.skipped_bytes(), 0u);
}

TEST(FalconPacketReader, FindsTheNextPacketBehindGarbage) {
  PacketReader reader;
  reader.take_transfer(transfer_of("zz<<AAAAAAAAAAAAAA>"));
  EXPECT_EQ(text_of(reader.next().value()), "<AAAAAAAAAAAAAA>");
  EXPECT_EQ(reader.skipped_bytes(), 3u);
}

TEST(FalconPacketReader, RandomBytesNeverBreakItAndTheNextPacketIsFound) {
  std::mt19937 random(11);
  PacketReader reader;
  for (int round = 0; round < 20000; ++round) {
    std::vector<std::uint8_t> bytes(random() % 65);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() % 4 == 0 ? '<' : random());
    reader.take_transfer(bytes);
    if (random() % 3 == 0) reader.next();
  }
  while (reader.next()) {
  }
  for (int again = 0; again < 3; ++again) reader.take_transfer(transfer_of("<AAAAAAAAAAAAAA>"));
  std::string last;
  while (const auto packet = reader.next()) last = text_of(*packet);
  EXPECT_EQ(last, "<AAAAAAAAAAAAAA>");
}

}  // namespace
}  // namespace myotact::device::falcon

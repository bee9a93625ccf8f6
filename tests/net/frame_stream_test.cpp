#include "net/frame_stream.h"

#include <algorithm>
#include <array>
#include <functional>
#include <thread>

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.h"
#include "net/scene_inquiry.h"

// Two programs that wait for each other, over lines that are slow, full, cut or lead to somebody else.

namespace myotact::net {
namespace {

constexpr std::chrono::milliseconds kLong(20'000), kShort(10);

Bytes pattern_of(std::size_t size) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(i * 131 + i / 256);
  return bytes;
}

Bytes raw_frame(FrameType type, std::uint32_t sequence, const Bytes& payload) {
  FrameHeader header;
  header.type = type;
  header.sequence = sequence;
  const HeaderBytes head = header_bytes(header, payload);
  Bytes bytes(head.begin(), head.end());
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  return bytes;
}

void put_raw(const Socket& socket, std::span<const std::uint8_t> bytes) {
  ASSERT_EQ(send(socket, bytes, {}, false, kLong), Sent::All);
}

TEST(FrameStream, FramesOfAnySizeGoBothWays) {
  auto [here, there] = socket_pair();
  FrameStream left(std::move(here), kLong), right(std::move(there), kLong);
  const std::vector<std::size_t> sizes = {0, 1, 104, 16'383, 70'000, kMostPayload};
  std::thread echo([&] {
    while (const auto frame = right.read()) {
      const Bytes payload(frame->payload.begin(), frame->payload.end());
      right.write(FrameType::SceneKey, frame->header.flags, payload, frame->header.time_ns + 1);
    }
  });
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const Bytes payload = pattern_of(sizes[i]);
    ASSERT_TRUE(left.write(FrameType::LocalModel, static_cast<std::uint8_t>(i), payload, 1000 * i));
    const auto answer = left.read();
    ASSERT_TRUE(answer) << left.why();
    EXPECT_EQ(answer->header.type, FrameType::SceneKey);
    EXPECT_EQ(answer->header.sequence, i);
    EXPECT_EQ(answer->header.time_ns, 1000 * i + 1);
    EXPECT_TRUE(std::equal(payload.begin(), payload.end(), answer->payload.begin(), answer->payload.end()));
  }
  left = FrameStream(Socket(), kShort);  // closes it
  echo.join();
}

TEST(FrameStream, AFrameMayComeByteByByte) {
  auto [here, there] = socket_pair();
  FrameStream stream(std::move(here), kLong);
  const Bytes bytes = raw_frame(FrameType::Ping, 0, {1, 2, 3, 4, 5, 6, 7, 8});
  std::thread slow([&, peer = std::move(there)] {
    for (const std::uint8_t byte : bytes) put_raw(peer, {&byte, 1});
  });
  const auto frame = stream.read();
  slow.join();
  ASSERT_TRUE(frame) << stream.why();
  EXPECT_EQ(frame->payload[7], 8);
}

TEST(FrameStream, SaysWhyThereIsNoMore) {
  const Bytes sound = raw_frame(FrameType::Ping, 0, Bytes(8));
  Bytes spoilt = raw_frame(FrameType::Ping, 1, Bytes(8));
  spoilt[30] ^= 4u;
  struct Case {
    std::size_t size;  // of the second frame: what comes of it
    bool closes;
    const char* why;
  };
  for (const Case& at : {Case{0, true, "closed"}, Case{20, true, "closed"}, Case{0, false, "silent"},
                         Case{31, false, "silent"}, Case{32, false, "check sum"}}) {
    auto [here, there] = socket_pair();
    put_raw(there, sound);
    put_raw(there, std::span(spoilt).first(at.size));
    if (at.closes) there = Socket();
    FrameStream stream(std::move(here), kShort);
    EXPECT_TRUE(stream.read()) << "what came before is told";
    EXPECT_FALSE(stream.read());
    EXPECT_NE(stream.why().find(at.why), std::string::npos) << stream.why() << " after " << at.size;
  }
}

TEST(FrameStream, WaitsNoLongerOnceItIsStopped) {
  auto [here, there] = socket_pair();
  int asked = 0;
  FrameStream stream(std::move(here), kLong, [&] { return ++asked == 2; });
  EXPECT_FALSE(stream.read());
  EXPECT_EQ(asked, 2);
}

TEST(FrameStream, WritingToWhoIsGoneIsNoMoreThanFalse) {
  auto [here, there] = socket_pair();
  FrameStream stream(std::move(here), kShort);
  there = Socket();
  EXPECT_FALSE(stream.write_text("anybody there?", 0));
  EXPECT_FALSE(stream.read());
}

TEST(Sending, WhatAFullLineDoesNotTakeIsDroppedWhole) {
  const auto [here, there] = socket_pair();
  const Bytes head(24, 0xAA), body(976, 0xBB);
  std::size_t sent = 0;
  while (sent < 100'000 && send(here, head, body, true, kShort) == Sent::All) ++sent;
  ASSERT_GT(sent, 0u);
  ASSERT_LT(sent, 100'000u) << "a line without an end";
  EXPECT_EQ(send(here, head, body, true, kShort), Sent::None);
  shut_down(here);
  Bytes came;
  std::array<std::uint8_t, 4096> room{};
  for (std::size_t count = 0; receive(there, room, count) == Received::Some;) {
    came.insert(came.end(), room.begin(), room.begin() + static_cast<std::ptrdiff_t>(count));
  }
  ASSERT_EQ(came.size(), 1000 * sent);
  for (std::size_t i = 0; i < came.size(); ++i) ASSERT_EQ(came[i], i % 1000 < 24 ? 0xAA : 0xBB) << i;
}

/// What a person is told who names this server, which says that.
std::string told_about(const std::function<void(FrameStream&, const Socket&)>& server) {
  const Socket listener = listen_at({"127.0.0.1", 0});
  std::thread serving([&] {
    std::string peer;
    Socket socket = accept_from(listener, kLong, peer);
    const Socket raw(::dup(socket.descriptor()));
    FrameStream stream(std::move(socket), kLong);
    server(stream, raw);
    stream.read();  // until the other side is done
  });
  std::string told;
  try {
    const SceneAnswer answer = ask_scene({"127.0.0.1", port_of(listener)}, {});
    told = "hand " + std::to_string(answer.welcome.hand) + ", " + answer.scene_json;
  } catch (const Error& failure) {
    EXPECT_EQ(failure.status(), ExitStatus::Unavailable);
    EXPECT_TRUE(std::string(failure.what()).starts_with("127.0.0.1:" + std::to_string(port_of(listener)) + ": "));
    told = failure.what();
  }
  serving.join();
  return told;
}

TEST(SceneInquiry, TellsWhatAServerShowsOrWhyItDoesNot) {
  const auto has = [](const std::string& told, const char* part) { return told.find(part) != std::string::npos; };
  EXPECT_EQ(told_about([](FrameStream& stream, const Socket&) {
              const auto hello = stream.read();
              EXPECT_EQ(hello->header.type, FrameType::Hello);
              stream.write(encode(Welcome{}), 0);
              stream.write_text("{}", 0);
            }),
            "hand -1, {}");
  const std::string refused = told_about([](FrameStream& stream, const Socket&) {
    stream.read();
    stream.write(encode(Bye{ByeReason::Token, "wrong token"}), 0);
  });
  EXPECT_TRUE(has(refused, "wrong token")) << refused;
  const std::string another = told_about([](FrameStream&, const Socket& raw) {
    const std::string page = "HTTP/1.1 400 Bad Request\r\nConnection: close\r\n\r\n";
    put_raw(raw, {reinterpret_cast<const std::uint8_t*>(page.data()), page.size()});
  });
  EXPECT_TRUE(has(another, "0x4D")) << another;
  const std::string other_order =
      told_about([](FrameStream& stream, const Socket&) { stream.write(encode(Ping{}), 0); });
  EXPECT_TRUE(has(other_order, "no server of this protocol")) << other_order;
  const std::string mute = told_about([](FrameStream& stream, const Socket& raw) {
    stream.write(encode(Welcome{}), 0);
    shut_down(raw);
  });
  EXPECT_TRUE(has(mute, "closed")) << mute;
}

}  // namespace
}  // namespace myotact::net

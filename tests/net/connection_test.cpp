#include "net/connection.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "net/frame_stream.h"
#include "support/loopback_server.h"

// What a server answers one client, frame by frame: wishes, states, hands, and what is not for a server.

namespace myotact::net {
namespace {

using testing::comes_true;
using testing::LoopbackServer;

/// A client that has read its Welcome and the scene.
struct Caller {
  Caller(const LoopbackServer& host, const Hello& hello)
      : stream(connect_to({"127.0.0.1", host.server->port()}, kWait), kWait) {
    stream.write(encode(hello), 0);
    const auto answer = stream.read();
    EXPECT_TRUE(answer && answer->header.type == FrameType::Welcome && decode(answer->payload, welcome));
    const auto scene = stream.read();
    EXPECT_TRUE(scene && scene->header.type == FrameType::Control);
  }
  void tell(std::uint64_t sequence) {
    messages::ToolState state;
    state.sequence = sequence;
    const ToolStateFrames frames = encode(state);
    for (const SmallFrame& frame : frames.used()) stream.write(frame, 0);
  }
  /// All that is said before a ping is answered; of a connection that ends, its last words.
  struct Said {
    std::vector<Event> events;
    std::vector<ForceAnswer> forces;
    std::optional<Bye> bye;
    bool answers = false;
  };
  Said listen() {
    constexpr std::uint64_t kNumber = 4711;
    stream.write(encode(Ping{kNumber}), 0);
    Said said;
    while (const auto frame = stream.read()) {
      Event event;
      ForceAnswer force;
      Bye bye;
      Pong pong;
      if (frame->header.type == FrameType::Event && decode(frame->payload, event)) said.events.push_back(event);
      if (frame->header.type == FrameType::Force && decode(frame->payload, force)) said.forces.push_back(force);
      if (frame->header.type == FrameType::Bye && decode(frame->payload, bye)) said.bye = bye;
      said.answers = frame->header.type == FrameType::Pong && decode(frame->payload, pong) && pong.ping_ns == kNumber;
      if (said.answers) break;
    }
    return said;
  }

  static constexpr std::chrono::milliseconds kWait{10'000};
  FrameStream stream;
  Welcome welcome;
};

Hello hello_of(Role role, HandWish hand = HandWish::Any) {
  Hello hello;
  hello.role = role;
  hello.wants.hand = true;
  hello.hand = hand;
  return hello;
}

TEST(ServedClient, AStudentsWishIsRefusedWithTheReasonAndTheStudentStays) {
  LoopbackServer host;
  for (const Role role : {Role::Viewer, Role::Student}) {
    Caller caller(host, hello_of(role));
    caller.stream.write_text(R"({"do": "reset"})", 0);
    const auto said = caller.listen();
    ASSERT_EQ(said.events.size(), 1u);
    EXPECT_EQ(said.events[0].code, EventCode::Refused);
    EXPECT_NE(said.events[0].text.find("only an instructor"), std::string::npos) << said.events[0].text;
    EXPECT_TRUE(said.answers);
  }
  EXPECT_FALSE(host.server->take_request());
}

TEST(ServedClient, MoreWishesThanCanBeObeyedAreRefusedOneByOne) {
  ServerSettings settings;
  settings.most_controls_per_s = 1e6;  // it is the queue that is full
  LoopbackServer host(settings);
  Caller caller(host, hello_of(Role::Instructor));
  for (int i = 0; i < 260; ++i) caller.stream.write_text(std::to_string(i), 0);
  const auto said = caller.listen();
  EXPECT_EQ(said.events.size(), 4u) << "256 may wait";
  EXPECT_TRUE(said.answers);
  EXPECT_EQ(host.server->counters().dropped_controls, 4u);
  for (int i = 0; i < 256; ++i) {
    const auto request = host.server->take_request();
    ASSERT_TRUE(request) << i;
    EXPECT_EQ(request->text, std::to_string(i));
    EXPECT_EQ(request->client, caller.welcome.client);
  }
}

TEST(ServedClient, ARefusalGoesToWhoAskedAlone) {
  LoopbackServer host;
  Caller first(host, hello_of(Role::Instructor)), second(host, hello_of(Role::Instructor));
  ASSERT_NE(first.welcome.client, second.welcome.client);
  host.server->refuse(second.welcome.client, "there is no joint 7");
  Event told;
  for (auto frame = second.stream.read(); frame; frame = second.stream.read()) {
    if (frame->header.type == FrameType::Event && decode(frame->payload, told)) break;
  }
  EXPECT_EQ(told.text, "there is no joint 7");
  EXPECT_TRUE(first.listen().events.empty());
}

TEST(ServedClient, EachStateIsAnsweredByItsNumberInOrder) {
  LoopbackServer host;
  Caller caller(host, hello_of(Role::Student));
  for (const std::uint64_t sequence : {5u, 6u, 9u}) caller.tell(sequence);
  const auto said = caller.listen();
  ASSERT_EQ(said.forces.size(), 3u);
  EXPECT_EQ(said.forces[0].tool_sequence, 5u);
  EXPECT_EQ(said.forces[1].tool_sequence, 6u);
  EXPECT_EQ(said.forces[2].tool_sequence, 9u);
  EXPECT_TRUE(host.channels[0]->states.update());
  EXPECT_EQ(host.channels[0]->states.front().sequence, 9u);
}

TEST(ServedClient, TheHandIsOfTheSideThatWasAskedFor) {
  LoopbackServer host;
  const Caller left(host, hello_of(Role::Student, HandWish::Left));
  const Caller other(host, hello_of(Role::Student, HandWish::Left));
  const Caller right(host, hello_of(Role::Student, HandWish::Right));
  EXPECT_EQ(left.welcome.hand, 1);
  EXPECT_EQ(other.welcome.hand, -1);
  EXPECT_EQ(right.welcome.hand, 0);
}

TEST(ServedClient, AViewerMovesNoHandThoughItAsksForOne) {
  LoopbackServer host;
  Caller viewer(host, hello_of(Role::Viewer));
  EXPECT_EQ(viewer.welcome.hand, -1);
  viewer.tell(1);
  const auto said = viewer.listen();
  EXPECT_FALSE(said.answers);
  ASSERT_TRUE(said.bye);
  EXPECT_EQ(said.bye->reason, ByeReason::NoHand);
  EXPECT_TRUE(said.forces.empty());
  for (const auto& channels : host.channels) EXPECT_FALSE(channels->states.update());
}

/// Frames that only a server sends, and a second Hello, which would be another role without another token.
TEST(ServedClient, WhatIsNotForAServerEndsTheConnection) {
  const std::vector<SmallFrame> frames = {encode(hello_of(Role::Instructor)), encode(Welcome{}), encode(ForceAnswer{}),
                                          encode(Pong{})};
  LoopbackServer host;
  std::uint64_t faults = 0;
  const auto expect_the_end = [&](FrameType type, std::span<const std::uint8_t> payload) {
    Caller caller(host, hello_of(Role::Student));
    caller.stream.write(type, 0, payload, 0);
    const auto said = caller.listen();
    EXPECT_FALSE(said.answers) << static_cast<int>(type);
    ASSERT_TRUE(said.bye) << static_cast<int>(type);
    EXPECT_EQ(said.bye->reason, ByeReason::BadFrame);
    EXPECT_NE(said.bye->text.find(std::to_string(static_cast<int>(type))), std::string::npos) << said.bye->text;
    EXPECT_EQ(host.server->counters().faults[static_cast<std::size_t>(WireFault::Value)], ++faults);
  };
  for (const SmallFrame& frame : frames) expect_the_end(frame.type, frame.payload());
  for (const FrameType type : {FrameType::LocalModel, FrameType::SceneKey, FrameType::SceneDelta, FrameType::BonePoses,
                               FrameType::Readings, FrameType::Mesh, FrameType::InForce}) {
    expect_the_end(type, Bytes(40));
  }
  EXPECT_TRUE(comes_true([&] { return host.server->client_count() == 0; }));
}

TEST(ServedClient, MeshesAreSentInTheirOrderToWhoWantsThem) {
  ServerSettings settings;
  settings.meshes = {Bytes(10, 1), Bytes(20, 2), Bytes(30, 3)};
  LoopbackServer host(settings);
  Hello hello = hello_of(Role::Viewer);
  Caller plain(host, hello);
  hello.wants.meshes = true;
  Caller wanting(host, hello);
  for (const Bytes& mesh : settings.meshes) {
    const auto frame = wanting.stream.read();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->header.type, FrameType::Mesh);
    EXPECT_TRUE(std::equal(mesh.begin(), mesh.end(), frame->payload.begin(), frame->payload.end()));
  }
  plain.stream.write(encode(Ping{1}), 0);
  EXPECT_EQ(plain.stream.read()->header.type, FrameType::Pong);
}

}  // namespace
}  // namespace myotact::net

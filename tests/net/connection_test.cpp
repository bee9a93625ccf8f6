#include "net/connection.h"

#include <algorithm>
#include <cstring>
#include <thread>
#include <vector>

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

TEST(ServedClient, AWishIsPassedOnWithTheRoleOfWhoAsks) {
  LoopbackServer host;
  for (const Role role : {Role::Viewer, Role::Student, Role::Instructor}) {
    Caller caller(host, hello_of(role));
    caller.stream.write_text(R"({"do": "reset"})", 0);
    EXPECT_TRUE(caller.listen().answers);
    const auto request = host.server->take_request();
    ASSERT_TRUE(request);
    EXPECT_EQ(request->role, role);
    EXPECT_EQ(request->client, caller.welcome.client);
  }
}

TEST(ServedClient, HandsThatAreToRestTouchNothingButAnInstructors) {
  LoopbackServer host({}, 2);
  Caller student(host, hello_of(Role::Student)), instructor(host, hello_of(Role::Instructor));
  host.server->let_hands_rest(true);
  messages::ToolState state;
  state.sequence = 3;
  state.contact.surface = 0;
  state.contact.stiffness_N_m = 300.0;
  state.grabbed_line = 1;
  state.line_stiffness_N_m = 200.0;
  for (Caller* caller : {&student, &instructor}) {
    const ToolStateFrames frames = encode(state);
    for (const SmallFrame& frame : frames.used()) caller->stream.write(frame, 0);
    EXPECT_TRUE(caller->listen().answers);
    HandChannels& hand = host.hands->channels(caller->welcome.hand);
    ASSERT_TRUE(hand.states.update());
    EXPECT_EQ(hand.states.front().sequence, 3u);
    EXPECT_EQ(hand.states.front().contact.surface, caller == &student ? -1 : 0);
    EXPECT_EQ(hand.states.front().grabbed_line, caller == &student ? -1 : 1);
  }
}

TEST(ServedClient, AnAnnouncementIsHeardByWhoWantsItAndByWhoComesLater) {
  LoopbackServer host;
  Hello hello = hello_of(Role::Student);
  hello.wants.announcements = true;
  Caller early(host, hello);
  host.server->announce({"to all", "to instructors"});
  hello.role = Role::Instructor;
  Caller late(host, hello);
  for (Caller* caller : {&early, &late}) {
    auto frame = caller->stream.read();
    while (frame && frame->header.type != FrameType::Control) frame = caller->stream.read();
    ASSERT_TRUE(frame);
    const std::string text(frame->payload.begin(), frame->payload.end());
    EXPECT_EQ(text, caller == &early ? "to all" : "to instructors");
  }
  EXPECT_EQ(host.server->clients().size(), 2u);
}

TEST(ServedClient, PicturesWaitUntilTheLastOnesWereSeen) {
  LoopbackServer host;
  Hello hello;
  hello.wants.pictures = true;
  Caller viewer(host, hello);
  messages::SceneFrame frame;
  frame.skins_world_m.resize(1);
  std::uint32_t noise = 1;
  const auto show = [&] {  // some 25 kB that do not compress
    ++frame.sequence;
    frame.skins_world_m[0].assign(4000, {});
    for (auto& place : frame.skins_world_m[0]) {
      for (float& axis : place) axis = 1e-5f * static_cast<float>((noise = noise * 1664525u + 1013904223u) >> 16);
    }
    host.server->show(frame);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  };
  const auto pictures = [&] {
    std::vector<std::uint64_t> numbers;
    viewer.stream.write(encode(Ping{1}), 0);
    for (auto got = viewer.stream.read(); got && got->header.type != FrameType::Pong; got = viewer.stream.read()) {
      std::uint64_t number = 0;
      if (got->header.type == FrameType::Picture) std::memcpy(&number, got->payload.data(), sizeof number);
      if (number > 0) numbers.push_back(number);
    }
    return numbers;
  };
  for (int i = 0; i < 4; ++i) show();
  EXPECT_EQ(pictures(), (std::vector<std::uint64_t>{1}));
  viewer.stream.write(encode(PictureSeen{1}), 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  show();
  const auto later = pictures();
  ASSERT_EQ(later.size(), 1u);
  EXPECT_GE(later[0], 4u) << "the newest, as a change of the first";
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

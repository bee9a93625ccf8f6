#include <gtest/gtest.h>

#include "core/error.h"
#include "support/loopback_server.h"

// Client and server over the real loopback of this machine.

namespace myotact::net {
namespace {

using testing::comes_true;
using testing::LoopbackServer;

/// A haptic loop's channels and the client that serves them.
struct Hand {
  explicit Hand(const ClientSettings& settings) : client(settings, {&states, &models}) { client.start(); }

  realtime::LatestValue<messages::ToolState> states;
  realtime::LatestValue<messages::LocalModel> models;
  Client client;
};

void publish_model(HandChannels& channels, std::uint64_t sequence, Server& server) {
  channels.models.back() = {};
  channels.models.back().sequence = sequence;
  channels.models.back().dt_ns = 10'000'000;
  channels.models.publish();
  server.ring();
}

TEST(Loopback, StatesGoToTheSimulationAndModelsComeBack) {
  LoopbackServer host;
  Hand hand(host.client());
  EXPECT_EQ(hand.client.status().welcome.hand, 0);
  messages::ToolState state;
  state.sequence = 42;
  state.tool_position_world_m = {0.1, 0.2, 0.3};
  hand.states.publish(state);
  auto& channels = *host.channels[0];
  EXPECT_TRUE(comes_true([&] { return channels.states.update() && channels.states.front().sequence == 42; }));
  EXPECT_EQ(channels.states.front().tool_position_world_m, state.tool_position_world_m);
  publish_model(channels, 7, *host.server);
  EXPECT_TRUE(comes_true([&] { return hand.models.update() && hand.models.front().sequence == 7; }));
  EXPECT_TRUE(comes_true([&] { return hand.client.status().round_trip_s > 0.0; }));
  EXPECT_LT(hand.client.status().round_trip_s, 0.5);
}

TEST(Loopback, EveryHandHasOneOwnerAndIsFreeAgainAfterwards) {
  LoopbackServer host;
  auto right = std::make_unique<Hand>(host.client());
  Hand left(host.client());
  EXPECT_EQ(right->client.status().welcome.hand, 0);
  EXPECT_EQ(left.client.status().welcome.hand, 1);
  Hand third(host.client());
  EXPECT_EQ(third.client.status().welcome.hand, -1);
  messages::ToolState state;
  state.sequence = 1;
  right->states.publish(state);
  auto& channels = *host.channels[0];
  EXPECT_TRUE(comes_true([&] { return channels.states.update(); }));
  right.reset();
  EXPECT_TRUE(comes_true([&] { return channels.states.update() && channels.states.front().sequence == 0; }))
      << "the hand that left lets go";
}

TEST(Loopback, AClientConnectsAgainAfterTheServerRestarts) {
  auto host = std::make_unique<LoopbackServer>();
  const std::uint16_t port = host->server->port();
  Hand hand(host->client());
  host.reset();
  EXPECT_TRUE(comes_true([&] { return !hand.client.status().connected; }));
  EXPECT_FALSE(hand.client.status().why.empty());
  host = std::make_unique<LoopbackServer>(ServerSettings{}, 2, port);
  EXPECT_TRUE(comes_true([&] { return hand.client.status().connected; }));
  EXPECT_EQ(hand.client.status().connections, 2u);
  publish_model(*host->channels[0], 3, *host->server);
  EXPECT_TRUE(comes_true([&] { return hand.models.update() && hand.models.front().sequence == 3; }));
}

TEST(Loopback, EverybodyMayStopAndAllHear) {
  LoopbackServer host;
  Hand student(host.client());
  Client viewer(host.client(false, Role::Viewer));
  viewer.start();
  viewer.ask_stop();
  EXPECT_TRUE(comes_true([&] { return student.client.stops() == 1 && viewer.stops() == 1; }));
  EXPECT_EQ(host.server->stops(), 1u);
}

TEST(Loopback, ScenesAreShown) {
  LoopbackServer host;
  Client viewer(host.client(false, Role::Viewer));
  viewer.start();
  messages::SceneFrame frame, shown;
  frame.skins_world_m = {{{0.1f, 0.2f, 0.3f}}};
  frame.body_poses.resize(2);
  frame.notice = "hello";
  frame.sequence = 9;
  host.server->show(frame);
  EXPECT_TRUE(comes_true([&] { return viewer.fetch_frame(shown); }));
  EXPECT_EQ(shown.notice, "hello");
  EXPECT_EQ(shown.sequence, 9u);
  EXPECT_EQ(shown.skins_world_m.size(), 1u);
}

TEST(Loopback, ATokenAdmitsAndAnotherDoesNot) {
  ServerSettings settings;
  settings.access_policy.token = new_token();
  settings.access_policy.instructor_token = new_token();
  LoopbackServer host(settings);
  ClientSettings given = host.client();
  EXPECT_THROW(Client(given).start(), Error);
  given.hello.token = *settings.access_policy.token;
  Client student(given);
  EXPECT_NO_THROW(student.start());
  given.hello.role = Role::Instructor;
  EXPECT_THROW(Client(given).start(), Error) << "the students' token makes no instructor";
  given.hello.token = *settings.access_policy.instructor_token;
  Client instructor(given);
  EXPECT_NO_THROW(instructor.start());
}

TEST(Loopback, AWrongAddressIsToldAtOnce) {
  ClientSettings settings;
  settings.server = {"127.0.0.1", 1};
  try {
    Client(settings).start();
    FAIL() << "nobody listens at port 1";
  } catch (const Error& failure) {
    EXPECT_EQ(failure.status(), ExitStatus::Unavailable);
    EXPECT_NE(std::string(failure.what()).find("127.0.0.1:1"), std::string::npos);
  }
}

TEST(Tokens, AreWhatTheirTextSays) {
  const Token token = new_token();
  EXPECT_EQ(parse_token(to_text(token)), token);
  EXPECT_EQ(to_text(token).size(), 32u);
  EXPECT_FALSE(parse_token("xyz"));
  EXPECT_FALSE(parse_token(std::string(32, 'g')));
  EXPECT_NE(new_token(), token);
}

TEST(Endpoints, AreReadAsPeopleWriteThem) {
  EXPECT_EQ(parse_endpoint("lab-7", 7480).port, 7480);
  EXPECT_EQ(parse_endpoint("lab-7:99", 7480).port, 99);
  EXPECT_EQ(parse_endpoint("[::1]:99", 7480).host, "::1");
  EXPECT_EQ(parse_endpoint("::1", 7480).host, "::1");
  for (const char* bad : {"", ":80", "a:b", "a:70000", "a:1x"}) EXPECT_THROW(parse_endpoint(bad, 1), Error) << bad;
  EXPECT_TRUE(is_loopback("127.0.0.1"));
  EXPECT_TRUE(is_loopback("::1"));
  EXPECT_FALSE(is_loopback("0.0.0.0"));
}

}  // namespace
}  // namespace myotact::net

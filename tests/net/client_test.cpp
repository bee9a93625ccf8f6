#include "net/client.h"

#include <atomic>
#include <future>
#include <memory>

#include <gtest/gtest.h>

#include "core/error.h"
#include "net/frame_stream.h"
#include "net/local_model_codec.h"
#include "realtime/periodic_loop.h"
#include "support/loopback_server.h"

// A client and servers that break off, refuse, restart or send nonsense, frame by frame.

namespace myotact::net {
namespace {

using testing::comes_true;

constexpr std::chrono::milliseconds kVisit(10'000);

/// One connection of a client, seen from the server.
struct Visit {
  explicit Visit(const Socket& listener) : stream(accepted(listener), kVisit) {
    const auto first = stream.read();
    EXPECT_TRUE(first && first->header.type == FrameType::Hello && decode(first->payload, hello)) << stream.why();
  }
  static Socket accepted(const Socket& listener) {
    std::string peer;
    return accept_from(listener, kVisit, peer);
  }
  void welcome(const Welcome& answer, const std::string& scene = "{}") {
    stream.write(encode(answer), 0);
    stream.write_text(scene, 0);
  }
  void say(const Bye& bye) { stream.write(encode(bye), 0); }
  void send_model(std::uint64_t published_at_ns) {
    messages::LocalModel model;
    model.published_at_ns = published_at_ns;
    model.dt_ns = 10'000'000;
    Bytes bytes;
    encode(model, bytes);
    stream.write(FrameType::LocalModel, 0, bytes, 0);
  }
  /// Until a frame of that type has come; how many tool states came before it.
  int tool_states_before(FrameType last) {
    int states = 0;
    for (auto frame = stream.read(); frame && frame->header.type != last; frame = stream.read()) {
      states += frame->header.type == FrameType::ToolState ? 1 : 0;
    }
    return states;
  }

  FrameStream stream;
  Hello hello;
};

/// A client that has been welcomed once by the test's own server.
class VisitingClient : public ::testing::Test {
 protected:
  VisitingClient() {
    settings_.server = {"127.0.0.1", port_of(listener_)};
    settings_.silence = kVisit;
    settings_.hello.role = Role::Student;
    settings_.hello.name = "Zoë";
    settings_.hello.wants = {.hand = true, .frames = true};
  }
  void start(const Welcome& answer) {
    client_ = std::make_unique<Client>(settings_, LoopChannels{&states_, &models_});
    auto started = std::async(std::launch::async, [this] { client_->start(); });
    visit_ = std::make_unique<Visit>(listener_);
    visit_->welcome(answer);
    started.get();
  }
  void come_again() {
    visit_.reset();
    visit_ = std::make_unique<Visit>(listener_);
  }
  bool connects_again_within(std::chrono::milliseconds wait) {
    std::string peer;
    return static_cast<bool>(accept_from(listener_, wait, peer));
  }
  bool has_connected(std::uint64_t times) {
    return comes_true([&] { return client_->status().connections == times; });
  }

  Socket listener_ = listen_at({"127.0.0.1", 0});
  ClientSettings settings_;
  realtime::LatestValue<messages::ToolState> states_;
  realtime::LatestValue<messages::LocalModel> models_;
  std::unique_ptr<Visit> visit_;
  std::unique_ptr<Client> client_;  // first to go: it says good-bye
};

TEST_F(VisitingClient, ComesBackAsTheOneThatItWas) {
  start({.client = 1, .resume_id = 0xABCDEF0123456789u, .hand = 1});
  EXPECT_EQ(visit_->hello.resume_id, 0u);
  EXPECT_TRUE(client_->status().connected);
  come_again();
  EXPECT_EQ(visit_->hello.resume_id, 0xABCDEF0123456789u);
  EXPECT_EQ(visit_->hello.name, "Zoë");
  EXPECT_EQ(visit_->hello.role, Role::Student);
  EXPECT_TRUE(visit_->hello.wants.hand && visit_->hello.wants.frames);
  EXPECT_FALSE(client_->status().connected);
  EXPECT_NE(client_->status().why, "");
  visit_->welcome({.client = 2, .resume_id = 4, .hand = 0}, R"({"scene": 2})");
  ASSERT_TRUE(has_connected(2));
  EXPECT_EQ(client_->status().why, "");
  EXPECT_EQ(client_->status().scene_json, R"({"scene": 2})");
  EXPECT_EQ(client_->status().welcome.hand, 0);
  come_again();
  EXPECT_EQ(visit_->hello.resume_id, 4u) << "of the last Welcome";
}

TEST_F(VisitingClient, IsToldTheServersReasonAtItsStart) {
  Client client(settings_);
  auto started = std::async(std::launch::async, [&] { client.start(); });
  Visit(listener_).say({ByeReason::Full, "64 clients are all that may join"});
  try {
    started.get();
    FAIL() << "it was refused";
  } catch (const Error& failure) {
    const std::string told = failure.what();
    EXPECT_EQ(failure.status(), ExitStatus::Unavailable);
    EXPECT_NE(told.find("64 clients are all that may join"), std::string::npos) << told;
    EXPECT_NE(told.find(std::to_string(port_of(listener_))), std::string::npos) << told;
  }
}

TEST_F(VisitingClient, WhatIsRefusedForGoodIsNotAskedForAgain) {
  start({.resume_id = 1});
  come_again();
  visit_->say({ByeReason::Token, "wrong token"});
  ASSERT_TRUE(comes_true([&] { return client_->status().is_final; }));
  EXPECT_EQ(client_->status().why, "wrong token");
  EXPECT_FALSE(connects_again_within(std::chrono::milliseconds(300)));  // the first retry comes after 100 ms
}

TEST_F(VisitingClient, AServerThatIsFullOrStopsIsAskedAgain) {
  start({.resume_id = 1});
  for (const ByeReason reason : {ByeReason::Full, ByeReason::Closing, ByeReason::NoHand, ByeReason::Silent}) {
    come_again();
    visit_->say({reason, "not now"});
    ASSERT_TRUE(comes_true([&] { return client_->status().why == "not now"; }));
  }
  come_again();
  EXPECT_FALSE(client_->status().is_final);
  visit_->welcome({.resume_id = 1});
  EXPECT_TRUE(has_connected(2));
}

TEST_F(VisitingClient, NonsenseOfTheServerIsSaidAndAnotherConnectionTried) {
  start({.resume_id = 1});
  const std::vector<std::pair<FrameType, Bytes>> frames = {{FrameType::LocalModel, Bytes(50)},
                                                           {FrameType::SceneDelta, Bytes(15)},
                                                           {FrameType::Pong, Bytes(3)},
                                                           {FrameType::Welcome, Bytes(31, 0xFF)}};
  for (const auto& [type, payload] : frames) {
    visit_->stream.write(type, 0, payload, 0);
    visit_ = std::make_unique<Visit>(listener_);
    EXPECT_EQ(client_->status().why, "the server sent a frame with a number out of its range");
    visit_->welcome({.resume_id = 1});
  }
  EXPECT_TRUE(has_connected(1 + frames.size()));
  messages::SceneFrame frame;
  EXPECT_FALSE(client_->fetch_frame(frame));
  EXPECT_FALSE(models_.update());
}

TEST_F(VisitingClient, TimesOfModelsAreTheClientsOwnWhateverTheServersClockSays) {
  // A machine that just started, then one whose clock is far ahead: the error is that of the way of one Hello.
  for (const std::uint64_t there : {std::uint64_t{1}, std::uint64_t{9'000'000'000'000'000'000u}}) {
    const std::uint64_t before = realtime::steady_now_ns();
    const Welcome answer{.resume_id = 1, .hand = 0, .server_time_ns = there};
    if (client_) {
      come_again();
      visit_->welcome(answer);
    } else {
      start(answer);
    }
    visit_->send_model(there);
    ASSERT_TRUE(comes_true([&] { return models_.update(); }));
    EXPECT_GE(models_.front().published_at_ns, before);
    EXPECT_LE(models_.front().published_at_ns, realtime::steady_now_ns());
  }
}

TEST_F(VisitingClient, OnlyWhoHasAHandTellsWhereItIs) {
  start({.resume_id = 1, .hand = -1});
  states_.publish({.sequence = 1});
  EXPECT_EQ(visit_->tool_states_before(FrameType::Ping), 0);
  EXPECT_EQ(visit_->tool_states_before(FrameType::Ping), 0);
  come_again();
  visit_->welcome({.resume_id = 1, .hand = 0});
  ASSERT_TRUE(has_connected(2));
  states_.publish({.sequence = 2});
  EXPECT_EQ(visit_->tool_states_before(FrameType::ToolState), 0);
}

TEST_F(VisitingClient, AStopIsPassedOnOnceAndARefusalIsNone) {
  std::atomic<int> stopped{0};
  client_ = std::make_unique<Client>(settings_);
  client_->on_stop([&] { ++stopped; });
  auto started = std::async(std::launch::async, [this] { client_->start(); });
  visit_ = std::make_unique<Visit>(listener_);
  visit_->welcome({.resume_id = 1});
  started.get();
  visit_->stream.write(encode(Event{EventCode::Refused, 0, "no"}), 0);
  visit_->stream.write(encode(Event{EventCode::Stop, 0, "stop"}), 0);
  ASSERT_TRUE(comes_true([&] { return client_->stops() > 0; }));
  EXPECT_EQ(client_->stops(), 1u);
  EXPECT_EQ(stopped, 1);
  EXPECT_TRUE(client_->status().connected);
}

}  // namespace
}  // namespace myotact::net

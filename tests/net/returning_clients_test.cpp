#include <cstring>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "core/error.h"
#include "net/frame_stream.h"
#include "net/scene_decoder.h"
#include "support/loopback_server.h"
#include "support/sanitizer.h"

// Clients that come, break off and come back, frame by frame.

namespace myotact::net {
namespace {

using testing::comes_true;
using testing::LoopbackServer;

constexpr std::chrono::milliseconds kPatience(5000);

struct Guest {
  explicit Guest(const LoopbackServer& host, std::uint64_t resume_id = 0)
      : stream(connect_to({"127.0.0.1", host.server->port()}, kPatience), kPatience) {
    Hello hello;
    hello.role = Role::Student;
    hello.wants.hand = true;
    hello.resume_id = resume_id;
    stream.write(encode(hello), 0);
    const auto answer = stream.read();
    EXPECT_TRUE(answer);
    if (answer && answer->header.type == FrameType::Welcome) is_welcome = decode(answer->payload, welcome);
    if (answer && answer->header.type == FrameType::Bye) decode(answer->payload, bye);
  }
  void tell(std::uint64_t sequence) {
    messages::ToolState state;
    state.sequence = sequence;
    const ToolStateFrames frames = encode(state);
    for (const SmallFrame& frame : frames.used()) stream.write(frame, 0);
  }
  /// The next frame of a type; the test waits no longer than the stream does.
  template <typename T>
  std::optional<T> next(FrameType type) {
    while (const auto frame = stream.read()) {
      T content;
      if (frame->header.type == type && decode(frame->payload, content)) return content;
    }
    return std::nullopt;
  }
  /// Whether the next thing that is said besides answers is an emergency stop. A ping goes along, so that something is.
  bool is_stopped() {
    stream.write(encode(Ping{1}), 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));  // two looks of a sender that has nothing to do
    stream.write(encode(Ping{2}), 0);
    while (const auto frame = stream.read()) {
      Event event;
      if (frame->header.type == FrameType::Event) return decode(frame->payload, event) && event.code == EventCode::Stop;
      Pong pong;
      if (frame->header.type == FrameType::Pong && decode(frame->payload, pong) && pong.ping_ns == 2) return false;
    }
    return false;
  }

  FrameStream stream;
  Welcome welcome;
  Bye bye;
  bool is_welcome = false;
};

std::uint64_t leave(std::unique_ptr<Guest>& guest, const LoopbackServer& host) {
  const std::uint64_t id = guest->welcome.resume_id;
  guest.reset();
  EXPECT_TRUE(comes_true([&] { return host.server->client_count() == 0; }));
  return id;
}

TEST(ReturningClients, AStopThatAHandMissedIsToldWhenItComesBack) {
  LoopbackServer host;
  auto guest = std::make_unique<Guest>(host);
  const std::uint64_t id = leave(guest, host);
  guest = std::make_unique<Guest>(host, id);
  EXPECT_EQ(guest->welcome.hand, 0);
  EXPECT_FALSE(guest->is_stopped());
  leave(guest, host);
  host.server->stop_forces();
  guest = std::make_unique<Guest>(host, id);
  EXPECT_TRUE(guest->is_stopped());
  leave(guest, host);
  guest = std::make_unique<Guest>(host, id);
  EXPECT_FALSE(guest->is_stopped()) << "it was told of that one";
}

TEST(ReturningClients, AStopIsToldToWhoGetsAnotherHandThanItsOwnToo) {
  LoopbackServer host;
  host.server->stop_forces();
  EXPECT_FALSE(Guest(host).is_stopped()) << "a new one was not here";
  EXPECT_TRUE(Guest(host, 77).is_stopped());
}

TEST(ReturningClients, ADeadConnectionLeavesAtOnceWhenItsOwnerIsBack) {
  LoopbackServer host;
  Guest dead(host);
  const auto begin = std::chrono::steady_clock::now();
  const Guest back(host, dead.welcome.resume_id);
  EXPECT_EQ(back.welcome.hand, 0);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(1000));
  EXPECT_TRUE(comes_true([&] { return host.server->client_count() == 1; }));
}

TEST(ReturningClients, WhoComesBackForAHandThatIsTakenIsToComeAgain) {
  LoopbackServer host({}, 1);
  const Guest owner(host);
  const Guest late(host), back(host, 4711);
  EXPECT_TRUE(late.is_welcome);
  EXPECT_EQ(late.welcome.hand, -1) << "it may watch";
  EXPECT_EQ(back.bye.reason, ByeReason::NoHand);
}

TEST(ReturningClients, TheForceOfTheOwnerBeforeIsNotToldToTheNext) {
  LoopbackServer host;
  host.channels[0]->forces.publish({41, {1.0, 2.0, 3.0}});
  Guest guest(host);
  for (const std::uint64_t step : {41u, 42u}) {
    host.channels[0]->forces.publish({step, {1.0, 2.0, 3.0}});
    guest.tell(step);
    EXPECT_EQ(guest.next<ForceAnswer>(FrameType::Force)->force_world_N[0], 0.0) << step;
  }
  host.channels[0]->forces.publish({43, {4.0, 5.0, 6.0}});
  guest.tell(43);
  EXPECT_EQ(guest.next<ForceAnswer>(FrameType::Force)->force_world_N[0], 4.0);
}

TEST(ReturningClients, OneTooManyIsToldSo) {
  ServerSettings settings;
  settings.most_connections = 1;
  LoopbackServer host(settings);
  const Guest first(host), second(host);
  EXPECT_TRUE(first.is_welcome);
  EXPECT_EQ(second.bye.reason, ByeReason::Full);
}

TEST(ReturningClients, AServerThatStopsSaysSo) {
  auto host = std::make_unique<LoopbackServer>();
  Guest guest(*host);
  ASSERT_TRUE(guest.stream.read()) << "the scene's Control: who is being told something else is not dismissed";
  guest.is_stopped();  // a ping has been answered: nothing is on its way
  host.reset();
  const auto bye = guest.next<Bye>(FrameType::Bye);
  ASSERT_TRUE(bye);
  EXPECT_EQ(bye->reason, ByeReason::Closing);
}

TEST(ReturningClients, AStrangerGetsNoMemoryBeforeItsHello) {
  LoopbackServer host;
  FrameStream stream(connect_to({"127.0.0.1", host.server->port()}, kPatience), kPatience);
  stream.write_text(std::string(2000, 'x'), 0);
  const auto answer = stream.read();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->header.type, FrameType::Bye);
  EXPECT_EQ(host.server->counters().faults[static_cast<std::size_t>(WireFault::Length)], 1u);
}

/// The system has no descriptor left for a while.
TEST(ReturningClients, WithoutDescriptorsNobodyComesInAndNobodyIsLost) {
  if (testing::kAddressSanitizer) GTEST_SKIP() << "clang's checks of pointers want descriptors of their own";
  LoopbackServer host;
  Client witness(host.client());
  witness.start();
  rlimit usual{};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &usual), 0);
  std::vector<Socket> crowd;
  {
    const Socket probe = connect_to({"127.0.0.1", host.server->port()}, kPatience);
    rlimit few = usual;
    few.rlim_cur = static_cast<rlim_t>(probe.descriptor()) + 4;
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &few), 0);
    try {
      for (int i = 0; i < 20; ++i) crowd.push_back(connect_to({"127.0.0.1", host.server->port()}, kPatience));
      ADD_FAILURE() << "descriptors for all";
    } catch (const Error&) {
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  }
  crowd.clear();
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &usual), 0);
  EXPECT_EQ(witness.status().connections, 1u);
  EXPECT_TRUE(comes_true([&] { return Guest(host).is_welcome; }));
}

TEST(SceneDecoderMemory, HasAnEnd) {
  constexpr std::uint32_t kVertices = 80'000;
  SceneDecoder decoder;
  int taken = 0;
  for (std::uint16_t skin = 0; skin < 256; ++skin) {
    Bytes payload(12 + 12 * kVertices);
    const std::uint16_t skins = 256;
    std::memcpy(payload.data() + 4, &skin, sizeof skin);
    std::memcpy(payload.data() + 6, &skins, sizeof skins);
    std::memcpy(payload.data() + 8, &kVertices, sizeof kVertices);
    Frame frame;
    frame.header.type = FrameType::SceneKey;
    frame.payload = payload;
    taken += decoder.take(frame) ? 1 : 0;
  }
  EXPECT_EQ(taken, 12) << "a million vertices of skins of 80 000";
}

}  // namespace
}  // namespace myotact::net

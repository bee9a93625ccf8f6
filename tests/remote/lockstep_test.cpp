#include <atomic>
#include <thread>

#include <gtest/gtest.h>

#include "core/error.h"
#include "net/scene_inquiry.h"
#include "net/tool_state_frames.h"
#include "remote/lockstep_hand.h"
#include "remote/lockstep_server.h"
#include "remote/scene_message.h"
#include "scene/lockstep_session.h"
#include "scene/scene_file.h"

// The same scene in one process and over the network, on the virtual clock: the hand feels the same.

namespace myotact::remote {
namespace {

/// A lockstep server with a thread of its own.
struct Host {
  explicit Host(const scene::Scene& scene)
      : server({"127.0.0.1", 0}, scene, {}, 1), thread([this] { server.serve([this] { return done.load(); }); }) {}
  ~Host() {
    done = true;
    thread.join();
  }
  net::Endpoint endpoint() const { return {"127.0.0.1", server.port()}; }

  std::atomic<bool> done{false};
  LockstepServer server;
  std::thread thread;
};

using Forces = std::vector<std::array<double, 3>>;

Forces felt_here(const scene::Scene& scene, int steps) {
  simulation::Simulation simulation(scene.specimen, scene.settings);
  scene::SampleTable samples(scene.specimen, scene::hands_of(scene), 1);
  scene::LockstepSession session(scene, simulation, samples, nullptr);
  Forces forces;
  for (int i = 0; i < steps; ++i) {
    session.step();
    forces.push_back(session.tool().force_world_N);
  }
  return forces;
}

Forces felt_over_there(const Host& host, int steps) {
  const scene::Scene scene = scene_of_message(net::ask_scene(host.endpoint(), {}).scene_json);
  ScriptedDevice device(scene, 0);
  LockstepHand hand(host.endpoint(), {}, scene.tools[0], device);
  Forces forces;
  for (int i = 0; i < steps; ++i) {
    std::array<double, 3> last{};
    hand.step([&](double, const haptics::HapticTick& tick) { last = tick.tool.force_world_N; });
    forces.push_back(last);
  }
  return forces;
}

double largest(const Forces& forces) {
  double most = 0.0;
  for (const auto& force : forces) {
    for (const double part : force) most = std::max(most, std::abs(part));
  }
  return most;
}

class Lockstep : public ::testing::TestWithParam<const char*> {};

TEST_P(Lockstep, FeelsTheSameOverTheNetworkToTheBit) {
  constexpr int kSteps = 300;
  const scene::Scene scene = scene::load_scene(GetParam());
  const Host host(scene);
  const Forces here = felt_here(scene, kSteps);
  EXPECT_GT(largest(here), 0.5) << "the scene must be felt at all";
  EXPECT_EQ(felt_over_there(host, kSteps), here);
  EXPECT_EQ(felt_over_there(host, kSteps), here) << "the next client finds the scene at its beginning";
}

INSTANTIATE_TEST_SUITE_P(OriginalScenes, Lockstep, ::testing::Values("spring", "particle"));

TEST(SceneMessage, AnotherSpecimenOfTheSameNameIsRefused) {
  std::string message = scene_message(scene::load_scene("spring"), 1);
  EXPECT_NO_THROW(scene_of_message(message));
  const std::size_t hash = message.find("\"sha256\":\"") + 10;
  message[hash] = message[hash] == '0' ? '1' : '0';
  try {
    scene_of_message(message);
    FAIL() << "a hash that differs must be noticed";
  } catch (const Error& failure) {
    EXPECT_EQ(failure.status(), ExitStatus::BadData);
    EXPECT_NE(std::string(failure.what()).find("another than the server's"), std::string::npos) << failure.what();
  }
}

TEST(SceneMessage, WhatIsNoneIsRefusedWithItsPlace) {
  for (const char* bad :
       {"", "{}", R"({"scene": 3})", R"({"scene": {"seed": -1}})", R"({"scene": {"seed": 1, "specimen": {}}})"}) {
    EXPECT_THROW(scene_of_message(bad), Error) << bad;
  }
}

TEST(LockstepServer, AViewerMovesNoHandAndASilentOneKeepsNobodyWaitingForLong) {
  const Host host(scene::load_scene("spring"));
  constexpr std::chrono::milliseconds kPatience(10'000);
  net::Hello hello;
  hello.wants.hand = true;
  {
    net::FrameStream viewer(net::connect_to(host.endpoint(), kPatience), kPatience);
    viewer.write(net::encode(hello), 0);
    EXPECT_EQ(net::read_scene(viewer, host.endpoint()).welcome.hand, -1);
    viewer.write(net::encode(messages::ToolState{}).frames[0], 0);
    const auto answer = viewer.read();
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->header.type, net::FrameType::Bye);
  }
  const net::Socket silent = net::connect_to(host.endpoint(), kPatience);
  net::FrameStream next(net::connect_to(host.endpoint(), kPatience), kPatience);
  next.write(net::encode(hello), 0);
  EXPECT_FALSE(net::read_scene(next, host.endpoint()).scene_json.empty());
}

}  // namespace
}  // namespace myotact::remote

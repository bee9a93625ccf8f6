#include "remote/mirror.h"

#include <chrono>
#include <functional>
#include <limits>
#include <memory>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "remote/frame_fit.h"
#include "remote/scene_message.h"
#include "remote/served_scene.h"
#include "support/loopback_server.h"
#include "support/synthetic_specimen.h"

namespace myotact::remote {
namespace {

using myotact::testing::comes_true;
using ::testing::HasSubstr;

TEST(FrameFit, AFrameOfTheSpecimenFitsAndABrokenOneIsNamed) {
  const anatomy::Specimen specimen = testing::antagonist_hinge();
  const simulation::Simulation simulation(specimen, {});
  messages::SceneFrame sound;
  simulation.write_frame(sound);
  sound.tools.resize(1);
  EXPECT_EQ(misfit(sound, specimen), "");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  using Break = std::function<void(messages::SceneFrame&)>;
  const std::pair<Break, const char*> breaks[] = {
      {[](auto& f) { f.body_poses.pop_back(); }, "body poses"},
      {[](auto& f) { f.skins_world_m[1].emplace_back(); }, "vertices of a skin"},
      {[](auto& f) { f.skins_world_m.emplace_back(); }, "skins"},
      {[](auto& f) { f.tensions_N.clear(); }, "tensions"},
      {[](auto& f) { f.joints.emplace_back(); }, "joints"},
      {[](auto& f) { f.joints[0].muscles.pop_back(); }, "muscles at a joint"},
      {[nan](auto& f) { f.lines_world_m[0][0][1] = nan; }, "muscle line"},
      {[nan](auto& f) { f.tools[0].force_world_N[2] = nan; }, "tool"},
      {[](auto& f) { f.tools[0].touched_muscle = 2; }, "touched muscle 2"},
      {[](auto& f) { f.tools[0].grabbed_body = -2; }, "grabbed body -2"},
      {[](auto& f) { f.tools.resize(kMostHands + 1); }, "33 tools"},
      {[nan](auto& f) {
         f.springs_world_m.push_back({{{0, 0, nan}, {0, 0, 0}}});
       },
       "spring"}};
  for (const auto& [break_it, what] : breaks) {
    messages::SceneFrame broken = sound;
    break_it(broken);
    EXPECT_THAT(misfit(broken, specimen), HasSubstr(what));
  }
}

TEST(OwnHand, IsShownAsItIsFeltHere) {
  messages::SceneFrame frame;
  messages::FeltTool felt;
  felt.tool.tool_position_world_m = {0.10, 0.0, 0.0};
  felt.tool.force_world_N = {0.0, 0.0, 0.7};
  felt.model_age_s = 0.043;
  show_own_hand(felt, frame);  // the server did not hear of it yet
  EXPECT_TRUE(frame.tools.empty());
  frame.tools.resize(2);
  frame.tools[0].tool_world_m = {0.0, 0.0, 0.0};
  frame.tools[1].tool_world_m = {0.09, 0.0, 0.0};  // where it was
  show_own_hand(felt, frame);
  EXPECT_EQ(frame.tools[1].tool_world_m, felt.tool.tool_position_world_m);
  EXPECT_EQ(frame.tools[1].force_world_N[2], 0.7);
  EXPECT_EQ(frame.tools[1].model_age_s, 0.043);
  EXPECT_EQ(frame.tools[0].model_age_s, 0.0);
}

/// A particle on the wall clock behind a server.
struct Host {
  explicit Host(std::uint16_t port = 0) {
    ServeSettings settings;
    settings.endpoint = {"127.0.0.1", port};
    served = std::make_unique<ServedScene>(scene, simulation, settings, nullptr);
    served->start();
    obeying = std::thread([this] {
      while (!closing) {
        served->obey();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
    });
  }
  ~Host() {
    closing = true;
    obeying.join();
    served->stop();
  }
  net::ClientSettings client(net::Role role) const {
    net::ClientSettings settings;
    settings.server = {"127.0.0.1", served->server().port()};
    settings.hello.role = role;
    settings.hello.wants.frames = settings.hello.wants.readings = settings.hello.wants.in_force = true;
    settings.hello.name = "mirror";
    return settings;
  }

  scene::Scene scene = scene::load_scene("particle");
  simulation::Simulation simulation{scene.specimen, scene.settings};
  std::unique_ptr<ServedScene> served;
  std::atomic<bool> closing{false};
  std::thread obeying;
};

/// Two windows on the same scene.
struct Watcher {
  Watcher(const Host& host, net::Role role) : client(host.client(role)), mirror(client, scene) { client.start(); }
  bool sees(const std::function<bool(const messages::SceneFrame&)>& condition) {
    return comes_true([&] {
      mirror.fetch_frame(frame);
      return condition(frame);
    });
  }

  scene::Scene scene = scene::load_scene("particle");
  net::Client client;
  Mirror mirror;
  messages::SceneFrame frame;
};

bool is_later(const messages::SceneFrame& frame, double time_s) {
  return frame.notice.empty() && frame.time_s > time_s;
}

TEST(Mirror, AnInstructorLeadsAndAViewerLooksOn) {
  Host host;
  Watcher viewer(host, net::Role::Viewer), instructor(host, net::Role::Instructor);
  for (Watcher* watcher : {&viewer, &instructor}) {
    EXPECT_TRUE(watcher->sees([](const auto& f) { return is_later(f, 0.1); }));
    EXPECT_EQ(misfit(watcher->frame, watcher->scene.specimen), "");
    EXPECT_EQ(watcher->frame.springs_world_m.size(), 1u);  // no hand is there
  }
  const messages::Command pause{messages::Pause{true}};
  EXPECT_FALSE(viewer.mirror.push(pause));
  const double before_s = viewer.frame.time_s;
  EXPECT_TRUE(viewer.sees([&](const auto& f) { return is_later(f, before_s + 0.3); }));
  EXPECT_FALSE(instructor.mirror.push({messages::EndRecording{}}));  // not from elsewhere
  EXPECT_TRUE(instructor.mirror.push(pause));
  EXPECT_TRUE(viewer.sees([](const auto& f) { return f.control.paused; }));
  double last_s = 0.0;
  EXPECT_TRUE(comes_true([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    viewer.mirror.fetch_frame(viewer.frame);
    return viewer.frame.time_s == std::exchange(last_s, viewer.frame.time_s);
  }));
}

TEST(Mirror, ALostServerIsSaidAndFoundAgain) {
  auto host = std::make_unique<Host>();
  const std::uint16_t port = host->served->server().port();
  Watcher viewer(*host, net::Role::Viewer);
  EXPECT_TRUE(viewer.sees([](const auto& f) { return is_later(f, 0.0); }));
  const std::string scene_json = viewer.client.status().scene_json;
  host.reset();
  EXPECT_TRUE(viewer.sees([](const auto& f) { return f.notice.find("no connection") != std::string::npos; }));
  EXPECT_GT(viewer.frame.time_s, 0.0);  // the last picture stays
  host = std::make_unique<Host>(port);
  EXPECT_TRUE(viewer.sees([](const auto& f) { return f.notice.empty(); }));
  EXPECT_FALSE(viewer.mirror.shows_another_scene(scene_json));
  EXPECT_TRUE(viewer.mirror.shows_another_scene("{}"));
}

}  // namespace
}  // namespace myotact::remote

#include "remote/served_scene.h"

#include <gtest/gtest.h>

#include "device/simulated_device.h"
#include "net/byte_cursor.h"
#include "net/frame_stream.h"
#include "remote/free_hand.h"
#include "scene/scene_file.h"
#include "support/loopback_server.h"

// A scene on the wall clock with hands at clients, in one process.

namespace myotact::remote {
namespace {

using testing::comes_true;

struct Host {
  explicit Host(const std::string& name, std::size_t hands = 1)
      : scene(with_hands(scene::load_scene(name), hands)),
        simulation(scene.specimen, scene.settings),
        served(scene, simulation, {{"127.0.0.1", 0}, {}, 1}, nullptr) {
    served.start();
  }
  net::ClientSettings client(net::Role role, bool with_hand) {
    net::ClientSettings settings;
    settings.server = {"127.0.0.1", served.server().port()};
    settings.hello.role = role;
    settings.hello.wants = {with_hand, true, true, false};
    return settings;
  }

  scene::Scene scene;
  simulation::Simulation simulation;
  ServedScene served;
};

/// A hand that wants to be 30 mm beside the anchor, once the gate has opened.
struct Puller {
  explicit Puller(Host& host)
      : device("simulated", Vec3::Zero()),
        hand(host.client(net::Role::Student, true), device, host.scene.tools[0], nullptr) {
    hand.start();
    const bool opened = comes_true([&] { return force_N() > 0.0 || ++looks > 1500; });
    EXPECT_TRUE(opened);
    device.set_hand_target({{0.03, 0.0, 0.0}, {}, 0, {}});
  }
  double force_N() {
    hand.loop().felt().update();
    return to_vec3(hand.loop().felt().front().tool.force_world_N).norm();
  }

  int looks = 0;
  device::SimulatedDevice device;
  FreeHand hand;
};

TEST(ServedScene, AHandFarFromItFeelsTheSpring) {
  Host host("spring");
  Puller puller(host);
  // 30 N/m against a hand of 300 N/m: x = 30 mm 300 / 330, F = 0.82 N.
  EXPECT_TRUE(comes_true([&] { return std::abs(puller.force_N() - 30.0 * 0.03 * 300.0 / 330.0) < 0.02; }))
      << puller.force_N();
}

TEST(ServedScene, AWatcherSeesTheHandAndThatItLeft) {
  Host host("spring", 2);
  net::Client watcher(host.client(net::Role::Viewer, false));
  watcher.start();
  messages::SceneFrame frame;
  {
    Puller puller(host);
    EXPECT_TRUE(comes_true([&] { return watcher.fetch_frame(frame) && frame.tools.size() == 1; }));
  }
  EXPECT_TRUE(comes_true([&] { return watcher.fetch_frame(frame) && frame.tools.empty(); }));
}

TEST(ServedScene, AStopFromAnyoneTakesTheForceAndOnlyTheOwnerArmsAgain) {
  Host host("spring");
  Puller puller(host);
  ASSERT_TRUE(comes_true([&] { return puller.force_N() > 0.5; }));
  net::Client watcher(host.client(net::Role::Viewer, false));
  watcher.start();
  watcher.ask_stop();
  EXPECT_TRUE(comes_true([&] { return puller.force_N() == 0.0; }));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(puller.force_N(), 0.0) << "nothing from outside brings it back";
  puller.device.set_hand_target({});  // the gate opens where little is wanted
  puller.hand.loop().stop_forces(false);
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  puller.device.set_hand_target({{0.03, 0.0, 0.0}, {}, 0, {}});
  EXPECT_TRUE(comes_true([&] { return puller.force_N() > 0.5; }));
}

TEST(ServedScene, WhoHasNoFilesGetsTheMeshes) {
  Host host("spring");
  net::FrameStream stream(net::connect_to(host.client(net::Role::Viewer, false).server, std::chrono::seconds(5)),
                          std::chrono::seconds(5));
  net::Hello hello;
  hello.wants.meshes = true;
  stream.write(net::encode(hello), 0);
  std::size_t triangles = 0;
  for (std::size_t bones = 0; bones < host.scene.specimen.bones.size();) {
    const auto frame = stream.read();
    ASSERT_TRUE(frame) << stream.why();
    if (frame->header.type != net::FrameType::Mesh) continue;
    net::ByteReader in(frame->payload);
    std::uint8_t kind = 0;
    std::uint16_t index = 0;
    std::int32_t body = 0;
    std::uint32_t vertices = 0, faces = 0;
    in.get(kind);
    in.get(index);
    in.get(body);
    in.get(vertices);
    in.get(faces);
    EXPECT_EQ(kind, 1);
    EXPECT_EQ(index, bones);
    EXPECT_EQ(body, host.scene.specimen.bones[bones].body);
    EXPECT_EQ(in.left(), 12 * vertices + 12 * faces);
    triangles += faces;
    ++bones;
  }
  EXPECT_EQ(triangles, host.scene.specimen.bones[0].surface.triangles.size() +
                           host.scene.specimen.bones[1].surface.triangles.size());
}

TEST(ServedScene, AnInstructorPausesAndABadWishIsAnswered) {
  Host host("particle");
  net::Client instructor(host.client(net::Role::Instructor, false));
  instructor.start();
  messages::SceneFrame frame;
  ASSERT_TRUE(comes_true([&] { return instructor.fetch_frame(frame); }));
  instructor.ask(R"({"do": "dance"})");
  instructor.ask(R"({"do": "pause", "on": true})");
  double before_s = -1.0;
  EXPECT_TRUE(comes_true([&] {
    host.served.obey();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    while (instructor.fetch_frame(frame)) {
    }
    return frame.time_s == std::exchange(before_s, frame.time_s);
  }));
}

/// A page's connection, without a page.
struct Member {
  Member(Host& host, net::Role role) : stream(net::connect_to(host.client(role, false).server, kWait), kWait) {
    net::Hello hello;
    hello.role = role;
    hello.wants.announcements = true;
    stream.write(net::encode(hello), 0);
  }
  /// Reads on until a Control or an Event holds the words.
  bool hears(Host& host, const std::string& words) {
    for (int i = 0; i < 500; ++i) {
      host.served.obey();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      stream.write(net::encode(net::Ping{1}), 0);
      for (auto frame = stream.read(); frame && frame->header.type != net::FrameType::Pong; frame = stream.read()) {
        const std::string text(frame->payload.begin(), frame->payload.end());
        if (text.find(words) != std::string::npos) return true;
      }
    }
    return false;
  }

  static constexpr std::chrono::milliseconds kWait{5000};
  net::FrameStream stream;
};

TEST(ServedScene, AClassHearsItsInstructorAndAStudentChangesNothing) {
  Host host("particle");
  Member student(host, net::Role::Student);
  EXPECT_TRUE(student.hears(host, R"("students":1)")) << "and is number 1";
  Member instructor(host, net::Role::Instructor);
  instructor.stream.write_text(R"({"do": "class_freeze", "on": true})", 0);
  EXPECT_TRUE(student.hears(host, R"("frozen":true)"));
  student.stream.write_text(R"({"do": "class_hand_up", "on": true})", 0);
  EXPECT_TRUE(instructor.hears(host, R"("hands_up":[1])"));
  student.stream.write_text(R"({"do": "reset"})", 0);
  EXPECT_TRUE(student.hears(host, "only an instructor may change the scene"));
  student.stream.write_text(R"({"do": "class_freeze", "on": false})", 0);
  EXPECT_TRUE(student.hears(host, "only an instructor leads the class"));
}

/// A surface, a line and a body that no scene has: the hand is not heeded, and everybody else goes on.
TEST(ServedScene, AHandOfNonsenseMovesNothing) {
  Host host("spring");
  net::Client watcher(host.client(net::Role::Viewer, false));
  watcher.start();
  realtime::LatestValue<messages::ToolState> states;
  realtime::LatestValue<messages::LocalModel> models;
  net::Client hand(host.client(net::Role::Student, true), {&states, &models});
  hand.start();
  messages::SceneFrame frame;
  for (std::uint64_t i = 1; i < 100; ++i) {
    messages::ToolState state;
    state.sequence = i;
    state.contact.surface = i % 3 == 0 ? 1 << 30 : -1;
    state.grabbed_line = i % 3 == 1 ? 1 << 30 : -1;
    state.grabbed_body = i % 3 == 2 ? 1 << 30 : -1;
    states.publish(state);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    watcher.fetch_frame(frame);
    EXPECT_TRUE(frame.tools.empty());
  }
  const double before_s = frame.time_s;
  EXPECT_TRUE(comes_true([&] { return watcher.fetch_frame(frame) && frame.time_s > before_s + 0.2; }));
}

}  // namespace
}  // namespace myotact::remote

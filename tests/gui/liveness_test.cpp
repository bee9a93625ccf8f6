#include <chrono>
#include <cstdio>
#include <optional>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gui/gui_program.h"
#include "gui/held_thread.h"

// Pictures never wait for the simulation, and the hand never for the window: each thread is stopped in turn, as by a
// debugger, and the others go on. What a picture takes is printed, never judged: machines are slow.

namespace myotact {
namespace {

using nlohmann::json;
using testing::GuiProgram;
using testing::HeldThread;

class LivenessTest : public testing::GuiTest {
 protected:
  void SetUp() override {
    testing::GuiTest::SetUp();
    if (IsSkipped()) return;
    if (const std::string why = testing::debugger_refused(); !why.empty()) {
      GTEST_SKIP() << "no thread may be stopped here (" << why << "); allow ptrace of child processes";
    }
  }
};

int pictures(const GuiProgram& gui) {
  return gui.state()["picture"];
}

double simulated_s(const GuiProgram& gui) {
  const json state = gui.state();
  return state["newest_s"];
}

/// How long the pictures took on average that were drawn while `meanwhile` went on.
template <typename Meanwhile>
int draw_during(const GuiProgram& gui, const char* what, const Meanwhile& meanwhile) {
  const int before = pictures(gui);
  const auto since = std::chrono::steady_clock::now();
  meanwhile();
  const int drawn = pictures(gui) - before;
  const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
  std::printf("%s: %d pictures in %.1f s, %.0f ms each\n", what, drawn, wall_s, 1e3 * wall_s / std::max(drawn, 1));
  return drawn;
}

TEST_F(LivenessTest, PicturesGoOnWhateverTheSimulationDoes) {
  GuiProgram gui("pictures", "elbow");
  constexpr int kPictures = 10;  // in seconds, on a machine however slow
  ASSERT_TRUE(gui.wait_until([](const json& state) { return state["newest_s"] > 1.0; }));
  EXPECT_GE(draw_during(gui, "simulation runs", [] { testing::pause_s(3.0); }), kPictures);

  const pid_t simulation = testing::thread_named(gui.program().id(), "simulation");
  ASSERT_GT(simulation, 0);
  const int slowed = draw_during(gui, "simulation at 10 Hz", [&] {
    for (int i = 0; i < 30; ++i) {
      const HeldThread held(simulation);
      testing::pause_s(0.1);
    }
  });
  EXPECT_GE(slowed, kPictures);

  std::optional<HeldThread> held(simulation);
  testing::pause_s(0.5);  // the last frame is on the screen
  const double stopped_s = simulated_s(gui);
  const int hung = draw_during(gui, "simulation hangs in a step", [] { testing::pause_s(5.0); });
  EXPECT_GE(hung, kPictures);
  EXPECT_EQ(simulated_s(gui), stopped_s);  // it did hang
  EXPECT_TRUE(gui.wait_until([&](const json&) { return gui.shows("news.silence"); }));
  gui.screenshot("hung");
  gui.click("tasks.see");  // the window still obeys
  EXPECT_TRUE(gui.wait_until([&](const json&) { return gui.shows("see.labels"); }));
  held.reset();
  EXPECT_TRUE(gui.wait_until([&](const json& state) { return state["newest_s"] > stopped_s + 0.2; }));
  EXPECT_TRUE(gui.wait_until([&](const json&) { return !gui.shows("news.silence"); }));

  gui.key("space");
  ASSERT_TRUE(gui.wait_until([](const json& state) { return state["scene"]["paused"] == true; }));
  EXPECT_GE(draw_during(gui, "simulation paused", [] { testing::pause_s(3.0); }), kPictures);
  EXPECT_FALSE(gui.shows("news.silence"));  // a pause is no hang
}

TEST_F(LivenessTest, AnotherSceneOpensThoughAStepHangs) {
  GuiProgram gui("hung_scene", "elbow --set tissue.default=line");
  ASSERT_TRUE(gui.wait_until([](const json& state) { return state["newest_s"] > 0.5; }));
  const pid_t simulation = testing::thread_named(gui.program().id(), "simulation");
  ASSERT_GT(simulation, 0);
  std::optional<HeldThread> held(simulation);
  gui.click("tasks.demonstrate");
  gui.click("demonstrate.scene");
  gui.click("particle");
  EXPECT_TRUE(gui.wait_until([](const json& state) { return state["scene_name"] == "particle"; }));
  EXPECT_TRUE(gui.wait_until([](const json& state) { return state["frame"]["time_s"] > 0.2; }));
  held.reset();
  EXPECT_TRUE(gui.program().running()) << gui.log();
}

TEST_F(LivenessTest, TheHandGoesOnWhateverTheWindowDoes) {
  GuiProgram gui("ticks", "elbow");
  ASSERT_TRUE(gui.wait_until([](const json& state) { return state["newest_s"] > 1.0; }));
  const pid_t program = gui.program().id();
  const pid_t haptics = testing::thread_named(program, "haptics");
  ASSERT_GT(haptics, 0);
  constexpr long kTicks = 500;  // a quarter of those of two seconds
  const auto ticks_during = [&](const char* what, const auto& meanwhile) {
    const long before = testing::sleeps_of(program, haptics);
    meanwhile();
    const long ticks = testing::sleeps_of(program, haptics) - before;
    std::printf("%s: %ld ticks\n", what, ticks);
    return ticks;
  };
  const int drawn = pictures(gui);
  const long stopped = ticks_during("window hangs for 2 s", [&] {
    const HeldThread held(program);  // the main thread, which draws
    testing::pause_s(2.0);
    EXPECT_LE(pictures(gui), drawn + 60);  // it did hang
  });
  EXPECT_GE(stopped, kTicks);
  EXPECT_GE(ticks_during("window hidden for 2 s", [&] { gui.hide(), testing::pause_s(2.0), gui.show(); }), kTicks);
  EXPECT_GE(ticks_during("window dragged for 2 s",
                         [&] {
                           for (int i = 0; i < 10; ++i)
                             gui.drag_window(20 * (i % 2), 10 * (i % 2)), testing::pause_s(0.2);
                         }),
            kTicks);
  const double before_s = simulated_s(gui);
  EXPECT_TRUE(gui.wait_until([&](const json& state) { return state["newest_s"] > before_s + 0.2; }));
  EXPECT_TRUE(gui.program().running()) << gui.log();
}

}  // namespace
}  // namespace myotact

// The two scenes of the older research system: every force that is sent follows from the recorded path of the tool by
// the published formulas, evaluated here on their own.

#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.h"
#include "scene/force_replay.h"
#include "scene/lockstep_session.h"
#include "scene/remote_hand.h"
#include "support/complaint.h"

namespace myotact::scene {
namespace {

using ::testing::HasSubstr;

constexpr double kTolerance_N = 1e-9;
constexpr std::size_t kRampEnds = 1150;  // ticks: the gate lets forces in over 1 s
constexpr std::size_t kTicksAStep = 10;

struct Tick {
  Vec3 tool_m, force_N;
};

/// The columns of a tool, as a person finds them in samples.csv.
std::vector<Tick> ticks_of(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line.find("t_s,tool_x_m,tool_y_m,tool_z_m,proxy_x_m,proxy_y_m,proxy_z_m,force_x_N,force_y_N,force_z_N"),
            0u);
  std::vector<Tick> ticks;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::vector<double> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    ticks.push_back({{row[1], row[2], row[3]}, {row[7], row[8], row[9]}});
  }
  return ticks;
}

struct TetherRun {
  explicit TetherRun(const char* name, const Overrides& overrides = {}, RecordingWriter* recorder = nullptr)
      : scene(load_scene(name, overrides)),
        simulation(scene.specimen, scene.settings),
        samples(scene.specimen, hands_of(scene), 1),
        session(scene, simulation, samples, recorder) {}

  std::vector<Tick> ticks(double seconds) {
    while (simulation.time_s() < seconds) session.step();
    return ticks_of(samples.csv());
  }

  Scene scene;
  simulation::Simulation simulation;
  SampleTable samples;
  LockstepSession session;
};

double largest_force_N(const std::vector<Tick>& ticks) {
  double largest_N = 0.0;
  for (const Tick& tick : ticks) largest_N = std::max(largest_N, tick.force_N.norm());
  return largest_N;
}

TEST(SpringScene, TheForceIsMinusKX) {
  for (const double k_N_m : {30.0, 20.0}) {
    TetherRun run("spring", {{"original.spring.stiffness_N_m", std::to_string(k_N_m)}});
    const std::vector<Tick> ticks = run.ticks(5.0);
    for (std::size_t i = kRampEnds; i < ticks.size(); ++i) {
      ASSERT_LE((ticks[i].force_N + k_N_m * ticks[i].tool_m).norm(), kTolerance_N) << i << " ms";
    }
    EXPECT_GT(largest_force_N(ticks), 0.03 * k_N_m);
  }
}

struct Constants {
  double m_kg = 0.2, k1_N_m = 50.0, k2_N_m = 50.0;
  bool circling = false;
  double unit_m = 0.02;
};

Vec3 cube_m(const Constants& c, double time_s) {
  const double angle = 1000.0 * time_s / 180.0 * std::numbers::pi / 50.0;
  return c.circling ? Vec3(2.0 * c.unit_m * std::cos(angle), 2.0 * c.unit_m * std::sin(angle), 0.0) : Vec3(0, 0, 0);
}

/// The largest difference between the sent forces and those of the published formulas along the same path. Solved for
/// the place instead of the velocity: (m + h^2 (k1 + k2)) x' = m (x + h v) + h^2 (k1 x1 + k2 x2).
double largest_difference_N(const std::vector<Tick>& ticks, const Constants& c) {
  constexpr double h_s = 0.01;
  Vec3 x_m = cube_m(c, 0.0), v_m_s = Vec3::Zero();
  double largest_N = 0.0;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    const double since_s = 1e-3 * static_cast<double>(i % kTicksAStep);
    const Vec3 force_N = c.k2_N_m * (x_m + since_s * v_m_s - ticks[i].tool_m);
    if (i >= kRampEnds) largest_N = std::max(largest_N, (ticks[i].force_N - force_N).norm());
    if (i % kTicksAStep != kTicksAStep - 1) continue;
    const Vec3 x1_m = cube_m(c, 1e-3 * static_cast<double>(i + 1 - kTicksAStep));
    const Vec3 next_m = (c.m_kg * (x_m + h_s * v_m_s) + h_s * h_s * (c.k1_N_m * x1_m + c.k2_N_m * ticks[i].tool_m)) /
                        (c.m_kg + h_s * h_s * (c.k1_N_m + c.k2_N_m));
    v_m_s = (next_m - x_m) / h_s;
    x_m = next_m;
  }
  return largest_N;
}

TEST(ParticleScene, TheForceFollowsFromTheToolsPath) {
  TetherRun run("particle");
  const std::vector<Tick> ticks = run.ticks(5.0);
  EXPECT_GT(largest_force_N(ticks), 1.0);
  EXPECT_LE(largest_difference_N(ticks, {}), kTolerance_N);
}

TEST(ParticleScene, TheCubeCirclesAsPublished) {
  const char* still = R"([{"t_s": 0, "do": "move", "to_m": [0.03, 0, 0], "duration_s": 18.2}])";
  TetherRun run("particle", {{"original.particle.cube", "circling"},
                             {"original.particle.mass_kg", "0.1"},
                             {"original.particle.hand_stiffness_N_m", "30"},
                             {"original.particle.cube_stiffness_N_m", "40"},
                             {"original.particle.unit_m", "0.015"},
                             {"script", still}});
  const std::vector<Tick> ticks = run.ticks(18.0);
  EXPECT_LE(largest_difference_N(ticks, {0.1, 40.0, 30.0, true, 0.015}), kTolerance_N);
  messages::SceneFrame frame;
  run.simulation.write_frame(frame);
  const auto body = static_cast<std::size_t>(anatomy::find_body(run.scene.specimen, "cube"));
  EXPECT_NEAR(frame.body_poses[body][3], 0.03, 1e-9);  // round once
  EXPECT_NEAR(frame.body_poses[body][7], 0.0, 1e-9);
  ASSERT_EQ(frame.springs_world_m.size(), 2u);
  EXPECT_NEAR(frame.springs_world_m[0][0][0], 0.03, 1e-9);
}

/// The same hand, the published trap: a particle that swings more and more until it is gone, and the force with it.
TEST(ParticleScene, ExplicitStepsThrowTheParticleAwayAndSaySo) {
  TetherRun run("particle", {{"original.particle.integration", "explicit"}});
  const std::vector<Tick> ticks = run.ticks(8.0);
  EXPECT_TRUE(run.simulation.particle_lost());
  EXPECT_THAT(run.session.conductor().notice(), HasSubstr("explicit integration gains energy"));
  EXPECT_EQ(ticks.back().force_N.norm(), 0.0);
  run.session.conductor().apply({messages::Reset{}});
  EXPECT_EQ(run.session.conductor().notice(), "");
}

/// For a client that has no haptic loop: from the very place that it sent.
TEST(SpringScene, AHandElsewhereIsAnsweredWithMinusKX) {
  messages::LocalModel model;
  model.tether.stiffness_N_m = 30.0;
  messages::ToolState hand;
  hand.sequence = 1;  // somebody has it
  hand.tool_position_world_m = {0.01, -0.02, 0.03};
  const Vec3 force_N = to_vec3(force_on_hand_N(model, hand));
  EXPECT_NEAR((force_N + 30.0 * to_vec3(hand.tool_position_world_m)).norm(), 0.0, 1e-15);
}

TEST(TetherScenes, PlayAgainBitForBit) {
  for (const char* name : {"spring", "particle"}) {
    const auto path =
        std::filesystem::temp_directory_path() / (std::string("myotact_") + name + std::to_string(::getpid()));
    {
      RecordingWriter writer(path, "{}");
      TetherRun run(name, {}, &writer);
      run.ticks(3.0);
      writer.close();
    }
    const Recording recording = read_recording(path);
    std::filesystem::remove(path);
    const Scene scene = load_scene(name);
    simulation::Simulation simulation(scene.specimen, scene.settings);
    Conductor start(scene, simulation);
    ForceReplay hands(scene, recording, {});
    hands.feel(simulation);
    for (const StepRecord& step : recording.steps) {
      apply(step, simulation);
      simulation.step(step.tools);
      ASSERT_EQ(simulation.state_hash(), step.state_hash) << name;
      hands.feel(simulation);
    }
    EXPECT_EQ(hands.comparison().largest_difference_N, 0.0);
    EXPECT_GT(hands.comparison().largest_force_N, 0.5);
    EXPECT_EQ(hands.comparison().compared, recording.steps.size());
  }
}

std::string problem_with(const char* name, const Overrides& overrides) {
  return myotact::testing::complaint(ExitStatus::BadData, [&] {
    const Scene scene = load_scene(name, overrides);
    const simulation::Simulation simulation(scene.specimen, scene.settings);
  });
}

TEST(TetherScenes, ErrorsNamePlaceRangeAndRemedy) {
  EXPECT_THAT(problem_with("spring", {{"original.spring.stifness_N_m", "3"}}), HasSubstr("stiffness_N_m"));
  EXPECT_THAT(problem_with("spring", {{"original.spring.stiffness_N_m", "-3"}}),
              HasSubstr("/original/spring/stiffness_N_m"));
  EXPECT_THAT(problem_with("particle", {{"original.particle.mass_kg", "0"}}), HasSubstr("0.001"));
  EXPECT_THAT(problem_with("particle", {{"original.particle.cube", "\"square\""}}), HasSubstr("circling"));
  EXPECT_THAT(problem_with("particle", {{"original.spring.stiffness_N_m", "3"}}), HasSubstr("either"));
  EXPECT_THAT(problem_with("particle", {{"specimen", "spring"}}), HasSubstr("no body \"cube\""));
  EXPECT_THAT(problem_with("spring", {{"specimen", "plate"}}), HasSubstr("muscles or joints"));
}

}  // namespace
}  // namespace myotact::scene

// A block of simulated muscle, pressed and stroked by a script: what its rendered force is said to be, by both truths,
// and whether faults that are planted into it are found.

#include "measure/fidelity/scene_fidelity.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "measure/fidelity/scene_fidelity_report.h"
#include "support/synthetic_specimen.h"

namespace myotact::measure {
namespace {

/// A press of 2.5 mm from above, a stroke along the block, and off again; the block is held at both ends.
scene::Scene block_scene() {
  testing::BarShape shape;
  shape.width_m = 0.06;
  shape.cells = {6, 3, 3};
  scene::Scene scene;
  scene.name = "block";
  scene.title = "a block of muscle";
  scene.specimen = testing::single_muscle(shape);
  scene.settings.workers = 1;
  scene.joints.resize(scene.specimen.joints.size());
  for (scene::JointSetting& joint : scene.joints) joint.locked = true;
  scene.activations.assign(scene.specimen.muscles.size(), 0.0);
  scene.tools.resize(1);
  scene::TouchMuscle touch;
  touch.muscle = 0;
  touch.at = 0.45;
  touch.from = Vec3::UnitZ();
  touch.depth_m = 2.5e-3;
  scene::SlideOnMuscle slide;
  slide.to = 0.6;
  slide.depth_m = 2.5e-3;
  // Not faster: a hand over 1 m/s would shut the force gate.
  scene.script = {{0.0, 1.2, touch}, {1.2, 0.8, slide}, {2.0, 0.4, scene::ReleaseHand{}}};
  return scene;
}

SceneFidelity measured(Truth truth, const PlantedFaults& faults = {}) {
  FidelityRequest request;
  request.truth = truth;
  request.planted = faults;
  return measure_scene_fidelity(block_scene(), request, {});
}

TEST(SceneFidelity, TheForceFollowsTheScenesOwnSteps) {
  const SceneFidelity found = measured(Truth::Steps);
  std::printf("%s", scene_fidelity_text(found).c_str());
  EXPECT_FALSE(found.step_part);
  EXPECT_EQ(found.gate_ticks, 0u);
  EXPECT_GT(found.compared.front().found.ticks, 800u);
  EXPECT_NEAR(found.compared.front().found.gain, 1.0, 0.03);
  EXPECT_LT(found.compared.front().found.error_rms_share, 0.08);
  ASSERT_TRUE(found.friction);
  EXPECT_NEAR(found.friction->asked, 0.3, 1e-9);
  ASSERT_EQ(found.presses.size(), 1u);
  EXPECT_NEAR(found.presses[0].felt_N_m / found.presses[0].true_N_m, 1.0, 0.15);
}

// Tissue that a step of 1 ms does not damp swings on after the touch; the mean of a press that stays is the same by
// either truth, and what the hand feels.
TEST(SceneFidelity, APressThatStaysIsTheSameByBothTruths) {
  scene::Scene scene = block_scene();
  std::get<scene::SlideOnMuscle>(scene.script[1].what).to = 0.45;
  scene.script.pop_back();
  FidelityRequest request;
  request.truth = Truth::Ticks;
  const SceneFidelity found = measure_scene_fidelity(scene, request, {});
  ASSERT_TRUE(found.step_part);
  ASSERT_EQ(found.force.true_N.size(), 2000u);
  Vec3 felt_N = Vec3::Zero(), true_N = Vec3::Zero();
  for (std::size_t i = 1400; i < 2000; ++i) {
    felt_N += found.force.commanded_N[i] / 600.0;
    true_N += found.force.true_N[i] / 600.0;
  }
  std::printf("mean of a press: felt %.4f N, true %.4f N\n", felt_N.z(), true_N.z());
  EXPECT_GT(true_N.z(), 0.3);
  EXPECT_NEAR(felt_N.z() / true_N.z(), 1.0, 0.05);  // the goal of felt stiffness
}

// Beside the force without them, and beside the simulated force, from which the felt one differs by itself.
TEST(SceneFidelity, PlantedFaultsAreFoundInTheForceOfTheRun) {
  constexpr double kDegree_rad = std::numbers::pi / 180.0;
  const SceneFidelity run = measured(Truth::Steps, parse_planted_faults("scale=0.9"));
  ASSERT_TRUE(run.planted);
  EXPECT_TRUE(run.planted->all_found());
  for (const char* text :
       {"delay_ms=5", "scale=0.9", "rotate_deg=5", "noise_mN=20", "delay_ms=5,scale=0.9,rotate_deg=5,noise_mN=20"}) {
    const PlantedReport report = report_planted(run.force, parse_planted_faults(text));
    EXPECT_TRUE(report.all_found()) << text;
    EXPECT_NEAR(report.on_truth.delay_s, report.planted.delay_s, 5e-4) << text;
    EXPECT_NEAR(report.on_truth.scale, report.planted.scale, 0.01) << text;
    EXPECT_NEAR(report.on_truth.rotate_rad, report.planted.rotate_rad, 0.5 * kDegree_rad) << text;
    EXPECT_NEAR(report.on_truth.noise_N, report.planted.noise_N, 2e-3) << text;
  }
}

TEST(SceneFidelity, WhatIsNotPlantedIsNotFound) {
  PlantedReport report;
  report.planted.delay_s = 5e-3;
  report.alone = report.planted;
  EXPECT_TRUE(report.all_found());
  report.alone.delay_s = 5.6e-3;
  EXPECT_FALSE(report.all_found());
  report.alone = report.planted;
  report.alone.rotate_rad = 0.02;
  EXPECT_FALSE(report.all_found());
}

TEST(SceneFidelity, ReportsHoldTheSeriesAndEveryFigure) {
  SceneFidelity fidelity = measured(Truth::Steps);
  const std::string csv = scene_fidelity_csv(fidelity);
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), fidelity.force.true_N.size() + 1);
  const nlohmann::json json = nlohmann::json::parse(scene_fidelity_json(fidelity));
  EXPECT_EQ(json["figures"].size(), grade(fidelity).size());
  EXPECT_EQ(json["truth"], "steps");
  EXPECT_GT(json["stiffness_ranges"].size(), 4u);
  fidelity.compared.front().found.error_rms_share = 0.5;
  EXPECT_EQ(worst_grade(grade(fidelity)), Grade::Poor);
}

TEST(SceneFidelity, AScriptThatTouchesNothingSaysSo) {
  scene::Scene scene = block_scene();
  scene.script.resize(1);
  scene.script[0] = {0.0, 0.2, scene::MoveHand{Vec3(0.0, 0.0, 0.5)}};
  const SceneFidelity fidelity = measure_scene_fidelity(scene, {}, {});
  EXPECT_TRUE(std::isnan(fidelity.compared.front().found.gain));
  EXPECT_EQ(worst_grade(grade(fidelity)), Grade::Unknown);
  EXPECT_FALSE(fidelity.notes.empty());
  EXPECT_EQ(nlohmann::json::parse(scene_fidelity_json(fidelity))["compared"]["force"]["gain"], nullptr);
}

TEST(AnswerTime, IsThatOfTheDeviceAlone) {
  device::DeviceProfile profile;
  profile.delay_ticks = 2;
  const AnswerTime answer = answer_time(profile);
  EXPECT_EQ(answer.loop_ticks, 0);
  EXPECT_EQ(answer.device_ticks, 2);
  EXPECT_NEAR(answer.total_s, 2e-3, 1e-12);
}

}  // namespace
}  // namespace myotact::measure

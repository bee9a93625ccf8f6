// A muscle alone, as it comes from one surface without bones: held at both ends by one body, it can be touched and
// contracts.

#include <algorithm>

#include <gtest/gtest.h>

#include "scene/lockstep_session.h"
#include "support/synthetic_specimen.h"

namespace myotact::scene {
namespace {

Scene lone_muscle() {
  Scene scene;
  scene.name = "lone muscle";
  scene.specimen = testing::single_muscle({.cells = {4, 2, 2}});
  anatomy::Specimen& specimen = scene.specimen;
  specimen.bones.clear();
  specimen.joints.clear();
  specimen.groups.clear();
  specimen.bodies.resize(1);
  for (int& body : specimen.muscles[0].attachments) body = body < 0 ? -1 : 0;
  for (anatomy::LinePoint& point : specimen.lines[0].points) point.body = 0;
  scene.activations.assign(1, 0.0);
  scene.tools.resize(1);
  return scene;
}

TEST(LoneMuscle, IsASpecimenWithoutDefect) {
  EXPECT_EQ(anatomy::find_defect(lone_muscle().specimen), "");
}

TEST(LoneMuscle, CanBeTouchedAndContracts) {
  Scene scene = lone_muscle();
  scene.script.push_back({0.0, 0.6, TouchMuscle{0, 0.5, Vec3::UnitZ(), 0.005}});
  scene.script.push_back({0.6, 0.2, Activate{0, 0.5}});
  simulation::Simulation simulation(scene.specimen, scene.settings);
  SampleTable samples(scene.specimen, hands_of(scene), 1);
  LockstepSession session(scene, simulation, samples, nullptr);
  double largest_N = 0.0;
  for (int step = 0; step < 60; ++step) {
    session.step();
    largest_N = std::max(largest_N, to_vec3(session.tool().force_world_N).norm());
  }
  EXPECT_GT(largest_N, 0.2);  // more than the device's friction
  const double relaxed_N = simulation.muscle_force_N(0);
  for (int step = 0; step < 60; ++step) session.step();
  EXPECT_GT(simulation.muscle_force_N(0), relaxed_N + 1.0);
  EXPECT_EQ(simulation.failed_steps(), 0);
}

}  // namespace
}  // namespace myotact::scene

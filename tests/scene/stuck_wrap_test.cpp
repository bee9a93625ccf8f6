// A limb that is turned so far that a line's end comes to lie in the surface the line goes round.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/conductor.h"
#include "simulation/skeleton/skeleton.h"
#include "support/synthetic_specimen.h"

namespace myotact::scene {
namespace {

constexpr double kTurned_rad = 0.8;

/// A sphere on the upper bone where the flexor's insertion comes to be at kTurned_rad; the muscles are lines.
Scene scene_with_a_trap() {
  Scene scene;
  scene.specimen = testing::antagonist_hinge();
  anatomy::MuscleLine& line = scene.specimen.lines[0];
  simulation::Skeleton turned(scene.specimen);
  turned.set_pose(std::vector<double>{kTurned_rad});
  anatomy::LineWrap wrap;
  wrap.body = 0;
  wrap.after = static_cast<int>(line.points.size()) - 2;
  wrap.shape = geometry::WrapShape::Sphere;
  wrap.centre_m = turned.body_pose(1) * line.points.back().position_m;
  wrap.radii_m = Vec3::Constant(0.004);
  wrap.side = -Vec3::UnitZ();  // at the file pose the line passes below it, clear
  line.wraps = {wrap};
  scene.settings.tissue.assign(2, simulation::TissueModel::Line);
  scene.joints.resize(1);
  scene.activations.assign(2, 0.0);
  scene.tools.resize(1);
  return scene;
}

TEST(StuckWrap, IsNoticedWhereTheLineCannotClearItAndOnlyThere) {
  Scene scene = scene_with_a_trap();
  simulation::Simulation simulation(scene.specimen, scene.settings);
  EXPECT_EQ(Conductor(scene, simulation).notice(), "");
  EXPECT_EQ(simulation.stuck_line(), -1);
  scene.joints[0].angle_rad = kTurned_rad;
  EXPECT_THAT(Conductor(scene, simulation).notice(), ::testing::HasSubstr("the line of flexor cannot clear its wrap"));
  EXPECT_EQ(simulation.stuck_line(), 0);
}

}  // namespace
}  // namespace myotact::scene

// The scenes in which no muscle is: forces known beforehand, through script, loop, gate and simulated device.

#include <string>

#include <gtest/gtest.h>

#include "scene/lockstep_session.h"

namespace myotact::scene {
namespace {

struct ScriptRun {
  explicit ScriptRun(const char* name, const Overrides& overrides = {})
      : scene(load_scene(name, overrides)),
        simulation(scene.specimen, scene.settings),
        samples(scene.specimen, hands_of(scene), 1),
        session(scene, simulation, samples, nullptr) {}

  /// The hand's force as it is at that time.
  Vec3 force_at(double time_s) {
    while (simulation.time_s() < time_s) session.step();
    return to_vec3(session.tool().force_world_N);
  }

  Scene scene;
  simulation::Simulation simulation;
  SampleTable samples;
  LockstepSession session;
};

TEST(PlainScene, the_hand_starts_above_what_has_no_muscles) {
  for (const char* name : {"plane", "plate"}) {
    const Scene scene = load_scene(name);
    const Vec3 start_m = start_of_hand(scene, 0);
    ASSERT_TRUE(start_m.allFinite());
    for (const anatomy::Bone& bone : scene.specimen.bones)
      for (const Vec3& x : bone.surface.positions_m) EXPECT_GT(start_m.z(), x.z() + 0.04);
  }
}

/// The hand wants 4.3 mm deeper: 300 N/m in series with 1000 N/m make 1 N of it, within the device's own friction (0.1
/// N); sideways no more than the tool's friction.
TEST(PlainScene, the_plane_pushes_back_along_its_normal) {
  ScriptRun run("plane");
  EXPECT_EQ(run.force_at(0.5).norm(), 0.0);
  for (const double time_s : {2.0, 3.0, 4.5}) {
    const Vec3 force_N = run.force_at(time_s);
    EXPECT_NEAR(force_N.z(), 1.0, 0.15) << time_s;
    EXPECT_LE(force_N.head<2>().norm(), 0.11 * force_N.z()) << time_s;
  }
  EXPECT_EQ(run.force_at(6.2).norm(), 0.0);
}

/// The published force methods, which go by contacts that our simulation reports: the same press, no friction.
TEST(PlainScene, the_plane_is_felt_by_every_force_method) {
  for (const char* method : {"penetration", "plane"}) {
    const std::string tool = R"({"device": "simulated", "radius_m": 0.005, "stiffness_N_m": 1000, "method": ")";
    ScriptRun run("plane", {{"tools", "[" + tool + method + "\"}]"}});
    EXPECT_EQ(run.force_at(0.5).norm(), 0.0);
    for (const double time_s : {2.0, 3.0, 4.5}) {
      const Vec3 force_N = run.force_at(time_s);
      EXPECT_NEAR(force_N.z(), 1.0, 0.15) << method << " at " << time_s;
      EXPECT_LE(force_N.head<2>().norm(), 1e-6) << method << " at " << time_s;
      EXPECT_EQ(run.session.tool().contact.surface, 0);
    }
    EXPECT_EQ(run.force_at(6.2).norm(), 0.0);
  }
}

TEST(PlainScene, a_plate_that_hangs_on_the_published_spring_weighs_its_weight) {
  ScriptRun run("plate", {{"tools", R"([{"device": "simulated", "radius_m": 0.005, "stiffness_N_m": 300,
                                         "method": "pulling"}])"}});
  const double weight_N = run.scene.specimen.bodies[1].mass_kg * run.scene.settings.gravity_m_s2.norm();
  EXPECT_NEAR(run.force_at(5.0).z(), -weight_N, 0.02 * weight_N);
  EXPECT_GT(run.simulation.joint(0).angle_rad, 0.025);
}

TEST(PlainScene, a_plate_that_hangs_in_in_the_hand_weighs_its_weight) {
  ScriptRun run("plate");
  const double weight_N = run.scene.specimen.bodies[1].mass_kg * run.scene.settings.gravity_m_s2.norm();
  EXPECT_LT(run.force_at(2.2).norm(), 0.01);  // on the ground
  EXPECT_NEAR(run.force_at(5.0).z(), -weight_N, 0.005 * weight_N);
  EXPECT_GT(run.simulation.joint(0).angle_rad, 0.025);
  EXPECT_LT(run.force_at(7.0).norm(), 0.05);  // on the ground again
}

}  // namespace
}  // namespace myotact::scene

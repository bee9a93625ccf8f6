// What a hand leaves behind: a muscle that was pressed and then contracts at once comes to the rest that it would have
// come to untouched, and the joint with it.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "scene/lockstep_session.h"
#include "scene/samples.h"
#include "scene/scene_file.h"

namespace myotact::scene {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;

struct Rest {
  double stiffness_Nm_rad = 0.0;
  double farthest_rad = 0.0;   // from the start, all the time
  double trembling_rad = 0.0;  // of the joint in the last half second
  double trembling_m = 0.0;    // way of any skin's vertex in one step, likewise
};

/// The elbow: `touch` as a script's, released, then all of its co-contraction in a hundredth of a second.
Rest rest_after(const std::string& touch) {
  const std::string script = "[" + touch + R"({"t_s": 2.5, "do": "co_contract", "common": 1.0, "duration_s": 0.01}])";
  const Scene scene = load_scene("elbow", {{"script", script}});
  simulation::Simulation simulation(scene.specimen, scene.settings);
  SampleTable samples(scene.specimen, hands_of(scene), 1'000'000);
  LockstepSession session(scene, simulation, samples, nullptr);
  const int joint = scene.co_contraction->joint;
  const double start_rad = simulation.joint(joint).angle_rad;
  Rest rest;
  while (simulation.time_s() < 6.0) {
    std::vector<std::vector<Vec3>> before;
    for (int m = 0; m < simulation.muscle_count(); ++m) {
      before.emplace_back(simulation.skin_world_m(m).begin(), simulation.skin_world_m(m).end());
    }
    const double angle_rad = simulation.joint(joint).angle_rad;
    session.step();
    const double now_rad = simulation.joint(joint).angle_rad;
    rest.farthest_rad = std::max(rest.farthest_rad, std::abs(now_rad - start_rad));
    if (simulation.time_s() < 5.5) continue;
    rest.trembling_rad = std::max(rest.trembling_rad, std::abs(now_rad - angle_rad));
    for (int m = 0; m < simulation.muscle_count(); ++m) {
      const auto skin = simulation.skin_world_m(m);
      for (std::size_t v = 0; v < skin.size(); ++v) {
        rest.trembling_m = std::max(rest.trembling_m, (skin[v] - before[static_cast<std::size_t>(m)][v]).norm());
      }
    }
  }
  rest.stiffness_Nm_rad = simulation.joint(joint).stiffness_Nm_rad;
  std::printf("K %.4f N m/rad, farthest %.2f degrees; still trembles by %.5f degrees and %.4f mm a step\n",
              rest.stiffness_Nm_rad, rest.farthest_rad / kDegree_rad, rest.trembling_rad / kDegree_rad,
              rest.trembling_m * 1e3);
  return rest;
}

/// A press of 4 mm on biceps brachii, let go half a second before the muscles contract.
std::string press(double at, const std::string& from) {
  return R"({"t_s": 0.2, "do": "touch", "muscle": "biceps_brachii", "at": )" + std::to_string(at) + R"(, "from": )" +
         from + R"(, "depth_m": 0.004, "duration_s": 0.4}, {"t_s": 1.8, "do": "release", "duration_s": 0.2}, )";
}

TEST(AfterTouch, ContractingMusclesFindTheirRest) {
  const Rest untouched = rest_after("");
  for (const double at : {0.35, 0.65}) {
    for (const char* from : {"[0, -1, 0]", "[1, 0.5, 0]"}) {
      SCOPED_TRACE(std::string("pressed at ") + std::to_string(at) + " from " + from);
      const Rest touched = rest_after(press(at, from));
      EXPECT_NEAR(touched.stiffness_Nm_rad, untouched.stiffness_Nm_rad, 0.005 * untouched.stiffness_Nm_rad);
      EXPECT_LT(touched.trembling_rad, 0.001 * kDegree_rad);
      EXPECT_LT(touched.trembling_m, 0.01e-3);
      EXPECT_LT(touched.farthest_rad, untouched.farthest_rad + 0.5 * kDegree_rad);
    }
  }
}

}  // namespace
}  // namespace myotact::scene

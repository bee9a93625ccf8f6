#include "simulation/random_scripts.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "simulation/simulation.h"
#include "support/source_folder.h"

namespace myotact::simulation {
namespace {

const std::string kSpecimen = source_folder() + "/meshes/canine_elbow";
/// Nothing that a hand does throws tissue faster than this.
constexpr double kFastest_m_s = 30.0;

/// A hand and a will that change their mind now and then.
class RandomScript {
 public:
  RandomScript(const anatomy::Specimen& specimen, int elbow, unsigned seed)
      : specimen_(specimen), elbow_(elbow), random_(seed) {}

  void act(Simulation& simulation) {
    if (chance(0.08)) simulation.set_excitation(any_muscle(), chance(0.5) ? (chance(0.5) ? 1.0 : 0.0) : uniform(0, 1));
    if (chance(0.03)) simulation.set_joint_torque(elbow_, uniform(-2.0, 2.0));
    if (chance(0.02)) simulation.set_gravity(Vec3(uniform(-10, 10), uniform(-10, 10), uniform(-10, 10)));
    if (chance(0.06))
      tool_ = chance(0.3)   ? messages::ToolState{}
              : chance(0.4) ? line_drag(simulation)
              : chance(0.5) ? push(simulation)
                            : bone_drag(simulation);
  }
  void let_go(Simulation& simulation) {
    for (int m = 0; m < static_cast<int>(specimen_.muscles.size()); ++m) simulation.set_excitation(m, 0.0);
    simulation.set_joint_torque(elbow_, 0.0);
    simulation.set_gravity(Vec3::Zero());
    tool_ = {};
  }
  const messages::ToolState& tool() const { return tool_; }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  bool chance(double share) { return uniform(0, 1) < share; }
  int any_muscle() { return static_cast<int>(uniform(0, static_cast<double>(specimen_.muscles.size()) - 1e-9)); }
  std::array<double, 3> near(const Vec3& place, double reach_m) {
    return {place.x() + uniform(-reach_m, reach_m), place.y() + uniform(-reach_m, reach_m),
            place.z() + uniform(-reach_m, reach_m)};
  }

  /// A point of a muscle's line is yanked by up to 4 cm.
  messages::ToolState line_drag(const Simulation& simulation) {
    messages::ToolState tool;
    tool.grabbed_line = any_muscle();
    tool.grab_fraction = uniform(0.2, 0.8);
    tool.line_stiffness_N_m = uniform(50, 400);
    const std::vector<Vec3> line = simulation.line_world_m(tool.grabbed_line);
    tool.tool_position_world_m = near(line[line.size() / 2], 0.04);
    return tool;
  }
  /// A point of a muscle's skin is pushed or pulled by up to 1 cm.
  messages::ToolState push(const Simulation& simulation) {
    messages::ToolState tool;
    const int muscle = any_muscle();
    const auto& triangles = specimen_.muscles[static_cast<std::size_t>(muscle)].skin.triangles;
    tool.contact.surface = muscle;
    tool.contact.triangle = static_cast<int>(uniform(0, static_cast<double>(triangles.size()) - 1e-9));
    tool.contact.barycentric = {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};
    tool.contact.normal_world = {0.0, 0.0, 1.0};
    const int vertex = triangles[static_cast<std::size_t>(tool.contact.triangle)][0];
    tool.contact.target_world_m = near(simulation.skin_world_m(muscle)[static_cast<std::size_t>(vertex)], 0.01);
    tool.contact.stiffness_N_m = uniform(100, 1000);
    return tool;
  }

  /// A point of a bone's surface is yanked by up to 4 cm.
  messages::ToolState bone_drag(const Simulation& simulation) {
    messages::ToolState tool;
    const auto bone = static_cast<std::size_t>(uniform(0, static_cast<double>(specimen_.bones.size()) - 1e-9));
    const auto& places_m = specimen_.bones[bone].surface.positions_m;
    const Vec3& rest_m = places_m[static_cast<std::size_t>(uniform(0, static_cast<double>(places_m.size()) - 1e-9))];
    tool.grabbed_body = specimen_.bones[bone].body;
    tool.body_point_rest_m = to_array(rest_m);
    tool.body_target_world_m = near(simulation.body_pose(tool.grabbed_body) * rest_m, 0.04);
    tool.body_stiffness_N_m = uniform(100, 1000);
    return tool;
  }

  const anatomy::Specimen& specimen_;
  int elbow_;
  std::mt19937 random_;
  messages::ToolState tool_;
};

double smallest_ratio(const Simulation& simulation, std::size_t muscles) {
  double smallest = 1e300;
  for (std::size_t m = 0; m < muscles; ++m) {
    smallest = std::min(smallest, simulation.smallest_volume_ratio(static_cast<int>(m)));
  }
  return smallest;
}

/// Largest speed of a skin vertex over one step; NaN when a position is.
double fastest_m_s(const Simulation& simulation, std::vector<std::vector<Vec3>>& skins, double dt_s) {
  double fastest = 0.0;
  for (std::size_t m = 0; m < skins.size(); ++m) {
    const std::span<const Vec3> skin = simulation.skin_world_m(static_cast<int>(m));
    for (std::size_t v = 0; v < skin.size() && v < skins[m].size(); ++v) {
      const double speed = (skin[v] - skins[m][v]).norm() / dt_s;
      if (std::isnan(speed)) return speed;
      fastest = std::max(fastest, speed);
    }
    skins[m].assign(skin.begin(), skin.end());
  }
  return fastest;
}

}  // namespace

void run_random_scripts(unsigned scripts, int steps) {
  const anatomy::Specimen specimen = anatomy::load_specimen(kSpecimen);
  const int elbow = anatomy::find_joint(specimen, "elbow");
  const SimulationSettings settings;
  Simulation simulation(specimen, settings);
  const std::vector<double> angles(specimen.joints.size(), 0.0), rest(specimen.muscles.size(), 0.0);
  double lowest = 1.0, fastest = 0.0;
  for (unsigned seed = 1; seed <= scripts; ++seed) {
    SCOPED_TRACE("script " + std::to_string(seed));
    simulation.restart();  // as a scene begins anew: what the script before left behind is no start for a settle
    ASSERT_TRUE(simulation.settle(angles, rest));
    RandomScript script(specimen, elbow, seed);
    std::vector<std::vector<Vec3>> skins(specimen.muscles.size());
    for (int step = 0; step < steps; ++step) {
      script.act(simulation);
      simulation.step(std::span(&script.tool(), 1));
      const double speed = fastest_m_s(simulation, skins, settings.dt_s);
      ASSERT_TRUE(speed < kFastest_m_s) << "step " << step << ": " << speed << " m/s";
      ASSERT_TRUE(std::isfinite(simulation.joint(elbow).angle_rad)) << "step " << step;
      lowest = std::min(lowest, smallest_ratio(simulation, specimen.muscles.size()));
      fastest = std::max(fastest, speed);
    }
    script.let_go(simulation);
    for (int step = 0; step < 50; ++step) simulation.step(std::span(&script.tool(), 1));
    EXPECT_GT(smallest_ratio(simulation, specimen.muscles.size()), 0.0) << "an inversion stayed";
    EXPECT_LT(fastest_m_s(simulation, skins, 50 * settings.dt_s), 0.5);
  }
  std::printf("smallest J %.3f, fastest %.2f m/s, failed steps %d\n", lowest, fastest, simulation.failed_steps());
}

}  // namespace myotact::simulation

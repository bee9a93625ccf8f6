#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "anatomy/specimen.h"
#include "simulation/simulation.h"
#include "support/source_folder.h"

// Thigh muscles of the canine hindlimb, 20 degrees flexed, in contact with bones and with each other: they lie up to 4
// mm within one another at the file pose, and each of them touches three others.

namespace myotact::simulation {
namespace {

constexpr double kFlexed_rad = 20.0 * 3.14159265358979323846 / 180.0;
/// As `stiffness` perturbs it: K changes little over a degree, and faces that flip leave little of the torque's change.
constexpr double kTurn_rad = 0.5 * 3.14159265358979323846 / 180.0;
const std::vector<std::string> kFlexors = {"biceps_femoris", "semitendinosus", "gracilis"};
const std::vector<std::string> kExtensors = {"rectus_femoris", "vastus_lateralis", "vastus_medialis",
                                             "vastus_intermedius"};

/// Flexors and extensors of the stifle of finite elements, all others only shapes.
struct Thigh {
  Thigh() {
    SimulationSettings settings;
    for (const anatomy::Muscle& muscle : specimen.muscles) {
      flexes.push_back(std::count(kFlexors.begin(), kFlexors.end(), muscle.key) > 0);
      extends.push_back(std::count(kExtensors.begin(), kExtensors.end(), muscle.key) > 0);
      settings.tissue.push_back(flexes.back() || extends.back() ? TissueModel::Fem : TissueModel::Rigid);
    }
    simulation = std::make_unique<Simulation>(specimen, settings);
    stifle = anatomy::find_joint(specimen, "stifle");
    angles_rad.assign(specimen.joints.size(), 0.0);
    angles_rad[static_cast<std::size_t>(stifle)] = kFlexed_rad;
  }
  /// Net torque about the stifle in equilibrium; NaN when there is none.
  double settled_Nm(double level, double angle_rad) {
    std::vector<double> activations;
    // The flexors, which are stronger here, balance the extensors at 0.78 of their activation (found by bisection).
    for (std::size_t m = 0; m < flexes.size(); ++m) activations.push_back(level * (flexes[m] ? 0.78 : extends[m]));
    angles_rad[static_cast<std::size_t>(stifle)] = angle_rad;
    if (!simulation->settle(angles_rad, activations)) return std::nan("");
    return simulation->joint(stifle).net_torque_Nm;
  }

  anatomy::Specimen specimen = anatomy::load_specimen(source_folder() + "/meshes/canine_hindlimb");
  std::vector<bool> flexes, extends;
  std::unique_ptr<Simulation> simulation;
  int stifle = -1;
  std::vector<double> angles_rad;
};

}  // namespace

class ThighContact : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(CoContraction, ThighContact, ::testing::Values(0.0, 1.0));

TEST_P(ThighContact, ComesToRestWithTheStiffnessThatItsTorqueHas) {
  Thigh thigh;
  ASSERT_FALSE(std::isnan(thigh.settled_Nm(GetParam(), kFlexed_rad)));
  const JointReadout readout = thigh.simulation->joint(thigh.stifle);
  for (std::size_t m = 0; m < thigh.flexes.size(); ++m) {
    if (!thigh.flexes[m] && !thigh.extends[m]) continue;
    const int muscle = static_cast<int>(m);
    EXPECT_GT(thigh.simulation->contact_force_N(muscle), 0.1) << thigh.specimen.muscles[m].key;
    EXPECT_LT(thigh.simulation->contact_depth_m(muscle), 2e-3) << thigh.specimen.muscles[m].key;
  }
  const double below_Nm = thigh.settled_Nm(GetParam(), kFlexed_rad - kTurn_rad);
  const double above_Nm = thigh.settled_Nm(GetParam(), kFlexed_rad + kTurn_rad);
  const double perturbed = -(above_Nm - below_Nm) / (2.0 * kTurn_rad) + readout.passive_Nm_rad;
  EXPECT_NEAR(readout.stiffness_Nm_rad, perturbed, 0.03 * perturbed);
}

// Nothing moves where nothing changes: what settled is at rest in motion, too.
TEST(ThighContact, StaysWhereItSettled) {
  Thigh thigh;
  const double net_Nm = thigh.settled_Nm(1.0, kFlexed_rad);
  ASSERT_FALSE(std::isnan(net_Nm));
  thigh.simulation->set_joint_torque(thigh.stifle, -net_Nm);
  for (std::size_t j = 0; j < thigh.specimen.joints.size(); ++j) {
    thigh.simulation->set_joint_locked(static_cast<int>(j), static_cast<int>(j) != thigh.stifle);
  }
  for (int step = 0; step < 50; ++step) thigh.simulation->step({});
  EXPECT_EQ(thigh.simulation->failed_steps(), 0);
  // Half a second; a step is solved to 2 % of the forces, which is what this joint's stiffness then leaves open.
  EXPECT_NEAR(thigh.simulation->joint(thigh.stifle).angle_rad, kFlexed_rad, 0.2 * 3.14159265358979323846 / 180.0);
}

}  // namespace myotact::simulation

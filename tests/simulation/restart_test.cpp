// A limb that was used and put back is a fresh one, to the bit: at rest and in the steps that follow.

#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/simulation.h"
#include "support/synthetic_specimen.h"

namespace myotact::simulation {
namespace {

class Restart : public ::testing::TestWithParam<std::pair<TissueModel, Contact>> {
 protected:
  Restart() : specimen_(testing::coarse_antagonist_hinge()) {
    settings_.tissue = {GetParam().first, GetParam().first};
    settings_.contact = GetParam().second;
  }

  anatomy::Specimen specimen_;
  SimulationSettings settings_;
};

TEST_P(Restart, LeavesNothingOfWhatWentBefore) {
  Simulation fresh(specimen_, settings_), used(specimen_, settings_);
  const double far = 0.9, near = 0.1;
  const std::vector<double> strong = {1.0, 0.2}, weak = {0.1, 0.3};
  ASSERT_TRUE(used.settle({&far, 1}, strong));
  for (int step = 0; step < 5; ++step) used.step({});  // no whole number of rounds of what is done every third step
  const std::uint64_t before = used.state_hash();
  used.restart();
  EXPECT_NE(used.state_hash(), before);
  ASSERT_TRUE(fresh.settle({&near, 1}, weak));
  ASSERT_TRUE(used.settle({&near, 1}, weak));
  for (int step = 0; step < 8; ++step) {
    EXPECT_EQ(used.state_hash(), fresh.state_hash()) << "step " << step;
    EXPECT_EQ(used.joint(0).stiffness_Nm_rad, fresh.joint(0).stiffness_Nm_rad) << "step " << step;
    EXPECT_EQ(used.joint(0).net_torque_Nm, fresh.joint(0).net_torque_Nm) << "step " << step;
    for (Simulation* simulation : {&fresh, &used}) {
      simulation->set_excitation(0, 0.6);
      simulation->step({});
    }
  }
}

/// A limb that starts anew at the angle it stood at: its followers are there, too, and not in the file pose.
TEST(RestartOfFollowers, AreWhereTheBonesAre) {
  const anatomy::Specimen specimen = testing::coarse_antagonist_hinge();
  SimulationSettings settings;
  settings.tissue.assign(specimen.muscles.size(), TissueModel::Rigid);
  Simulation simulation(specimen, settings);
  const double angle_rad = 0.7;
  ASSERT_TRUE(simulation.settle({&angle_rad, 1}, {}));
  const auto nodes = simulation.nodes_world_m(0);
  const std::vector<double> first(nodes.begin(), nodes.end());
  simulation.restart();
  ASSERT_TRUE(simulation.settle({&angle_rad, 1}, {}));
  const auto again = simulation.nodes_world_m(0);
  EXPECT_EQ(first, std::vector<double>(again.begin(), again.end()));
}

INSTANTIATE_TEST_SUITE_P(Models, Restart,
                         ::testing::Values(std::pair(TissueModel::Fem, Contact::All),
                                           std::pair(TissueModel::Fem, Contact::None),
                                           std::pair(TissueModel::MassSpring, Contact::All),
                                           std::pair(TissueModel::Line, Contact::All)));

}  // namespace
}  // namespace myotact::simulation

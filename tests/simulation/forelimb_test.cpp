#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "simulation/line/line_model.h"
#include "simulation/simulation.h"
#include "support/source_folder.h"

// The canine forelimb of this repository, whole: what the muscles do there is what their lines say.

namespace myotact::simulation {
namespace {

constexpr double kDegree_rad = 3.14159265358979323846 / 180.0;
/// How far tissue and line may differ at the file pose (one muscle, one mechanics).
constexpr double kAgreement = 0.05;

struct Forelimb {
  explicit Forelimb(TissueModel model = TissueModel::Fem, Contact contact = Contact::All)
      : simulation(specimen, {.tissue = std::vector<TissueModel>(specimen.muscles.size(), model), .contact = contact}) {
  }

  anatomy::Specimen specimen = anatomy::load_specimen(source_folder() + "/meshes/canine_elbow");
  int elbow = anatomy::find_joint(specimen, "elbow");
  Simulation simulation;

  bool settle(double elbow_rad, double activation) {
    std::vector<double> angles(specimen.joints.size(), 0.0);
    angles[static_cast<std::size_t>(elbow)] = elbow_rad;
    const std::vector<double> activations(specimen.muscles.size(), activation);
    return simulation.settle(angles, activations);
  }
  std::vector<double> tensions() const {
    std::vector<double> all;
    for (int m = 0; m < static_cast<int>(specimen.muscles.size()); ++m) all.push_back(simulation.muscle_force_N(m));
    return all;
  }
};

LineGeometry geometry_of(const anatomy::Specimen& specimen, int muscle) {
  Skeleton skeleton(specimen);
  LineGeometry geometry;
  for (const anatomy::MuscleLine& line : specimen.lines) {
    if (line.muscle == muscle) measure_line(line, skeleton, geometry);
  }
  return geometry;
}

}  // namespace

class ForelimbOf : public ::testing::TestWithParam<TissueModel> {};
INSTANTIATE_TEST_SUITE_P(Models, ForelimbOf, ::testing::Values(TissueModel::Fem, TissueModel::MassSpring));

// Without contact, which no line has: bones and neighbours change moment arms, that of the brachialis by a tenth.
TEST_P(ForelimbOf, IsometricForceAndItsSlopeAreTheLinesAtHalfActivation) {
  Forelimb limb(GetParam(), Contact::None);
  const double turn = 0.5 * kDegree_rad;
  ASSERT_TRUE(limb.settle(turn, 0.5));
  const std::vector<double> flexed = limb.tensions();
  ASSERT_TRUE(limb.settle(-turn, 0.5));
  const std::vector<double> extended = limb.tensions();
  ASSERT_TRUE(limb.settle(0.0, 0.5));
  const std::vector<double> tension = limb.tensions();
  for (std::size_t m = 0; m < tension.size(); ++m) {
    const LineForce line = line_force(limb.specimen.muscles[m], 0.0, 0.0, 0.5);
    EXPECT_NEAR(tension[m] / line.force_N, 1.0, kAgreement) << limb.specimen.muscles[m].key;
    const double slope = geometry_of(limb.specimen, static_cast<int>(m)).slope_m_rad[limb.elbow];
    const double stiffness = (flexed[m] - extended[m]) / (2.0 * turn * slope);
    EXPECT_NEAR(stiffness / line.stiffness_N_m, 1.0, kAgreement) << limb.specimen.muscles[m].key;
  }
}

TEST(Forelimb, StiffnessIsTheSlopeOfTheTorqueAndRisesWithCoContraction) {
  Forelimb limb;
  double last = 0.0;
  for (double activation : {0.0, 0.5, 1.0}) {
    const double turn = 0.25 * kDegree_rad;
    ASSERT_TRUE(limb.settle(turn, activation));
    const double flexed = limb.simulation.joint(limb.elbow).net_torque_Nm;
    ASSERT_TRUE(limb.settle(-turn, activation));
    const double extended = limb.simulation.joint(limb.elbow).net_torque_Nm;
    ASSERT_TRUE(limb.settle(0.0, activation));
    const JointReadout readout = limb.simulation.joint(limb.elbow);
    const double perturbed = readout.passive_Nm_rad - (flexed - extended) / (2.0 * turn);
    EXPECT_NEAR(readout.stiffness_Nm_rad, perturbed, 0.05 * perturbed);
    EXPECT_GT(readout.stiffness_Nm_rad, last);
    last = readout.stiffness_Nm_rad;
  }
}

TEST_P(ForelimbOf, StandsJumpsOfActivationAndAYankedSkin) {
  Forelimb limb(GetParam());
  ASSERT_TRUE(limb.settle(0.0, 0.0));
  messages::ToolState tool;
  tool.contact = {2, 10, {0.2, 0.3, 0.5}, {}, {}, 500.0};
  for (int i = 0; i < 60; ++i) {
    for (int m = 0; m < static_cast<int>(limb.specimen.muscles.size()); ++m) {
      limb.simulation.set_excitation(m, i / 15 % 2 == 0 ? 1.0 : 0.0);
    }
    const Vec3 skin = limb.simulation.skin_world_m(2)[30];
    tool.contact.target_world_m = to_array(i % 20 < 10 ? Vec3(skin + Vec3(0.0, 0.05, 0.0)) : skin);
    limb.simulation.step({&tool, 1});
    const JointReadout readout = limb.simulation.joint(limb.elbow);
    ASSERT_TRUE(std::isfinite(readout.angle_rad) && std::isfinite(readout.stiffness_Nm_rad)) << "step " << i;
    for (const Vec3& p : limb.simulation.skin_world_m(2)) ASSERT_LT((p - skin).norm(), 0.5) << "step " << i;
  }
  EXPECT_LE(limb.simulation.failed_steps(), 3);
}

TEST(Forelimb, WorkersDoNotChangeABit) {
  const anatomy::Specimen specimen = anatomy::load_specimen(source_folder() + "/meshes/canine_elbow");
  std::vector<std::uint64_t> hashes;
  for (int workers : {1, 2, 8}) {
    SimulationSettings settings;
    settings.workers = workers;
    Simulation simulation(specimen, settings);
    simulation.set_excitation(0, 0.7);
    simulation.set_excitation(3, 0.4);
    for (int i = 0; i < 5; ++i) simulation.step({});
    hashes.push_back(simulation.state_hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

}  // namespace myotact::simulation

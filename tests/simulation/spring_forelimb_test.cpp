#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "simulation/limb/limb.h"
#include "simulation/limb/settle.h"
#include "simulation/muscle/spring_net.h"
#include "simulation/simulation.h"
#include "support/source_folder.h"

// The canine forelimb of this repository made of springs, against the same made of finite elements.

namespace myotact::simulation {
namespace {

const anatomy::Specimen& specimen() {
  static const anatomy::Specimen loaded = anatomy::load_specimen(source_folder() + "/meshes/canine_elbow");
  return loaded;
}

std::vector<TissueModel> all(TissueModel model) {
  return std::vector<TissueModel>(specimen().muscles.size(), model);
}

/// Force columns of round presses of 6 mm radius, spread over the skin: three columns (x, y, z) a press.
Eigen::MatrixXd presses(const anatomy::Muscle& muscle, const MuscleTissue& tissue) {
  constexpr double kRadius_m = 0.006;
  constexpr std::size_t kPresses = 24;
  const SkinEmbedding skin = embed_skin(muscle.skin, tissue.mesh);
  const std::vector<Vec3>& vertices = muscle.skin.positions_m;
  const std::size_t every = std::max<std::size_t>(1, vertices.size() / kPresses);
  const std::size_t count = (vertices.size() + every - 1) / every;
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(3 * tissue.free_nodes, static_cast<Eigen::Index>(3 * count));
  for (std::size_t press = 0; press < count; ++press) {
    const auto first = static_cast<Eigen::Index>(3 * press);
    int pressed = 0;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      if ((vertices[v] - vertices[press * every]).norm() > kRadius_m) continue;
      ++pressed;
      const NodeWeights& weights = skin.vertices[v];
      for (std::size_t k = 0; k < static_cast<std::size_t>(weights.count); ++k) {
        const int f = tissue.free_index[static_cast<std::size_t>(weights.nodes[k])];
        if (f >= 0) columns.block<3, 3>(3 * f, first).diagonal().array() += weights.weights[k];
      }
    }
    columns.middleCols<3>(first) /= pressed;
  }
  return columns;
}

/// Mean over presses and directions of how far the relaxed muscle gives way [m/N].
double compliance_m_N(TissueModel model, std::size_t index) {
  const std::vector<TissueModel> models = all(model);
  Limb limb(specimen(), models, Tendon::Elastic, Contact::None);  // bones would bear part of a press
  LimbMuscle& muscle = limb.muscles[index];
  EXPECT_TRUE(settle_muscle(limb.skeleton, Vec3::Zero(), 1e-6, muscle));
  compute_system(limb.skeleton, {}, muscle, Accuracy::Refined);
  const Eigen::MatrixXd columns = presses(specimen().muscles[index], muscle.tissue);
  Eigen::MatrixXd moved;
  EXPECT_NE(factor_system(muscle, columns, moved, Accuracy::Refined), Pivots::Unusable);
  return columns.cwiseProduct(moved).sum() / static_cast<double>(columns.cols());
}

}  // namespace

// kSpringScale is chosen on the long head of the triceps; the other muscles tell what it is worth elsewhere.
TEST(SpringForelimb, APressGivesWayAsInFiniteElements) {
  for (std::size_t m = 0; m < specimen().muscles.size(); ++m) {
    const bool chosen_on = specimen().muscles[m].key == "triceps_brachii_long";
    const double ratio = compliance_m_N(TissueModel::MassSpring, m) / compliance_m_N(TissueModel::Fem, m);
    EXPECT_NEAR(ratio, 1.0, chosen_on ? 0.03 : 0.3) << specimen().muscles[m].key;
  }
}

// The springs are too soft lengthwise, by less than 1 N m/rad; with all muscles active that is a small part.
TEST(SpringForelimb, StiffnessOfTheActiveElbowIsNearTheFiniteElements) {
  const int elbow = anatomy::find_joint(specimen(), "elbow");
  Simulation fem(specimen(), {}), net(specimen(), {.tissue = all(TissueModel::MassSpring)});
  const std::vector<double> angles(specimen().joints.size(), 0.0);
  for (const double activation : {0.5, 1.0}) {
    const std::vector<double> activations(specimen().muscles.size(), activation);
    ASSERT_TRUE(fem.settle(angles, activations));
    ASSERT_TRUE(net.settle(angles, activations));
    const double expected = fem.joint(elbow).stiffness_Nm_rad;
    EXPECT_NEAR(net.joint(elbow).stiffness_Nm_rad, expected, 0.1 * expected) << "activation " << activation;
  }
}

TEST(SpringForelimb, RunsFromRelaxedToFullActivationTheSameOnOneAndTwoWorkers) {
  constexpr double kLargestVolumeError = 0.05;
  std::vector<std::uint64_t> hashes;
  for (const int workers : {1, 2}) {
    Simulation simulation(specimen(), {.workers = workers, .tissue = all(TissueModel::MassSpring)});
    const std::vector<double> angles(specimen().joints.size(), 0.0);
    ASSERT_TRUE(simulation.settle(angles, {}));  // the file pose is not quite at rest
    for (int step = 0; step < 100; ++step) {
      for (int m = 0; m < static_cast<int>(specimen().muscles.size()); ++m) {
        simulation.set_excitation(m, step / 100.0);
        EXPECT_NEAR(simulation.volume_ratio(m), 1.0, kLargestVolumeError);
        for (const Vec3& p : simulation.skin_world_m(m)) ASSERT_TRUE(p.allFinite()) << "step " << step;
      }
      simulation.step({});
    }
    EXPECT_EQ(simulation.failed_steps(), 0);
    hashes.push_back(simulation.state_hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace myotact::simulation

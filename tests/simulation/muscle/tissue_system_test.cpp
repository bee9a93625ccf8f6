#include "simulation/muscle/tissue_system.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/error.h"
#include "simulation/curves/fibre_curves.h"
#include "simulation/muscle/build_tissue.h"
#include "support/synthetic_specimen.h"

namespace myotact::simulation {
namespace {

/// A short bar, coarse enough for finite differences over every unknown.
testing::BarShape short_bar(int tendon_cells) {
  testing::BarShape shape;
  shape.cells = {3, 1, 1};
  shape.tendon_cells = tendon_cells;
  return shape;
}

/// One muscle on the hinge in a state of large deformation, with history.
struct Bench {
  explicit Bench(const anatomy::Specimen& given, TissueModel model = TissueModel::Fem)
      : specimen(given),
        skeleton(specimen),
        tissue(build_muscle_tissue(specimen, 0, model)),
        state(make_state(tissue)),
        system(make_system(tissue, skeleton)) {
    load.rule = second_order(0.01);
    load.gravity_m_s2 = {0.0, 0.0, -9.81};
    state.activation = 0.6;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> noise(-5e-4, 5e-4);
    for (double& x : state.last.position_m) x += 0.1 * noise(random);
    for (double& x : state.now.position_m) x += noise(random);
    for (double& stretch : state.last.stretch) stretch += 20.0 * noise(random);
    turn(0.2);
  }
  void turn(double q) {
    angle = q;
    skeleton.set_pose({&angle, 1});
    place_clamped(tissue, skeleton, state);
  }
  /// Residual over free nodes, then the joint's.
  Eigen::VectorXd residual() {
    compute_forces(tissue, skeleton, load, state, system);
    Eigen::VectorXd all(system.residual_N.size() + 1);
    all << system.residual_N, system.joint_residual_Nm;
    return all;
  }
  Eigen::MatrixXd tangent() {
    compute_system(tissue, skeleton, load, state, system);
    const Eigen::Index n = system.residual_N.size();
    Eigen::MatrixXd whole(n + 1, n + 1);
    const Eigen::MatrixXd lower(system.matrix.lower());
    whole.topLeftCorner(n, n) = lower.selfadjointView<Eigen::Lower>();
    whole.topLeftCorner(n, n) += system.mean.factor_Nm * system.mean.gradient * system.mean.gradient.transpose();
    whole.topRightCorner(n, 1) = system.coupling_N_rad;
    whole.bottomLeftCorner(1, n) = system.coupling_N_rad.transpose();
    whole(n, n) = system.joint_stiffness_Nm_rad(0, 0);
    return whole;
  }
  double* unknown(Eigen::Index k) {
    for (std::size_t node = 0; node < tissue.body.size(); ++node) {
      if (tissue.free_index[node] == k / 3) return &state.now.position_m[static_cast<Eigen::Index>(3 * node) + k % 3];
    }
    return nullptr;
  }
  void move(Eigen::Index k, double by) {
    if (double* x = k < system.residual_N.size() ? unknown(k) : nullptr)
      *x += by;
    else
      turn(angle + by);
  }

  anatomy::Specimen specimen;
  Skeleton skeleton;
  MuscleTissue tissue;
  TissueState state;
  TissueSystem system;
  TissueLoad load;
  double angle = 0.0;
};

}  // namespace

class TissueSystemOf : public ::testing::TestWithParam<TissueModel> {};
INSTANTIATE_TEST_SUITE_P(Models, TissueSystemOf, ::testing::Values(TissueModel::Fem, TissueModel::MassSpring));

/// The tendon goes over a cylinder beside the hinge.
anatomy::Specimen wrapped_bar() {
  anatomy::Specimen specimen = testing::single_muscle(short_bar(1));
  anatomy::LineWrap wrap;
  wrap.body = 0;
  wrap.axes << 0, 0, 1, 1, 0, 0, 0, 1, 0;  // about y
  wrap.centre_m = Vec3(0.008, 0.0, 0.0);
  wrap.radii_m.setConstant(0.0335);  // its top lies 3.5 mm above the straight line
  wrap.side = Vec3::UnitZ();
  specimen.lines[0].wraps = {wrap};
  specimen.lines[0].wraps[0].after = 1;
  return specimen;
}

TEST_P(TissueSystemOf, TangentIsTheSlopeOfTheResidualWithJointAndTendon) {
  const std::array<anatomy::Specimen, 3> specimens = {testing::single_muscle(short_bar(0)),
                                                      testing::single_muscle(short_bar(1)), wrapped_bar()};
  for (const anatomy::Specimen& specimen : specimens) {
    Bench bench(specimen, GetParam());
    ASSERT_EQ(bench.tissue.strands.size(), &specimen == &specimens[0] ? 0u : 1u);
    const Eigen::MatrixXd tangent = bench.tangent();
    const double largest = tangent.cwiseAbs().maxCoeff(), h = 1e-7;
    for (Eigen::Index k = 0; k < tangent.cols(); ++k) {
      bench.move(k, h);
      const Eigen::VectorXd up = bench.residual();
      bench.move(k, -2.0 * h);
      const Eigen::VectorXd down = bench.residual();
      bench.move(k, h);
      EXPECT_LT(((up - down) / (2.0 * h) - tangent.col(k)).norm(), 1e-6 * largest) << "unknown " << k;
    }
  }
}

// Under an affine map every stress is uniform, so nodes inside a distorted mesh are in balance.
TEST(TissueSystem, PatchTestHolds) {
  testing::BarShape shape;
  shape.cells = {3, 3, 3};
  anatomy::Specimen specimen = testing::single_muscle(shape);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-1e-3, 1e-3);
  std::vector<Vec3>& nodes = specimen.muscles[0].tets.nodes_m;
  const double low = -0.0099, high = 0.0099;  // of the cross-section; the bar is 20 mm wide
  std::vector<std::size_t> inside;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const bool at_side =
        nodes[i].y() < low || nodes[i].y() > high || nodes[i].z() < 0.03 + low || nodes[i].z() > 0.03 + high;
    if (at_side || specimen.muscles[0].attachments[i] >= 0) continue;
    nodes[i] += Vec3(noise(random), noise(random), noise(random));
    inside.push_back(i);
  }
  ASSERT_GE(inside.size(), 8u);
  Bench bench(specimen);
  Mat3 map;
  map << 1.1, 0.1, 0.0, -0.2, 0.95, 0.1, 0.05, 0.0, 0.9;
  for (std::size_t i = 0; i < bench.tissue.mesh.nodes_m.size(); ++i) {
    bench.state.now.position_m.segment<3>(static_cast<Eigen::Index>(3 * i)) = map * bench.tissue.mesh.nodes_m[i];
  }
  bench.load = {};
  bench.residual();
  for (std::size_t i : inside) {
    const Vec3 force = node_vector(bench.system.internal_N, static_cast<int>(i));
    EXPECT_LT(force.norm(), 1e-10 * bench.system.force_scale_N);
  }
}

TEST(MuscleTissue, MassAndBlendAddUp) {
  const anatomy::Specimen specimen = testing::single_muscle(short_bar(0));
  const MuscleTissue tissue = build_muscle_tissue(specimen, 0);
  double mass = 0.0;
  for (double m : tissue.mass_kg) {
    EXPECT_GT(m, 0.0);
    mass += m;
  }
  EXPECT_NEAR(mass, 1060.0 * 0.12 * 0.02 * 0.02, 1e-12);
  for (Eigen::Index i = 0; i < tissue.blend.rows(); ++i) EXPECT_NEAR(tissue.blend.row(i).sum(), 1.0, 1e-9);
  EXPECT_NEAR(tissue.fibre_map.gain, 0.8, 1e-12);  // the bar's length over lo
}

TEST(MuscleTissue, SectionsThatAreNotGivenFollowFromTheVolume) {
  anatomy::Specimen specimen = testing::single_muscle(short_bar(0));
  specimen.muscles[0].sections_m2.clear();
  const MuscleTissue tissue = build_muscle_tissue(specimen, 0);
  EXPECT_NEAR(tissue.elements[0].section_m2, 4e-4, 1e-12);
  EXPECT_NEAR(tissue.fibre_map.gain, 0.8, 1e-12);
}

TEST(MuscleTissue, MidsideNodesAreClampedBetweenClampedCorners) {
  const MuscleTissue tissue = build_muscle_tissue(testing::single_muscle(short_bar(0)), 0);
  int clamped = 0;
  for (std::size_t i = 0; i < tissue.body.size(); ++i) {
    const double x = tissue.mesh.nodes_m[i].x();
    const bool at_end = x < -0.09 + 1e-9 || x > 0.03 - 1e-9;
    EXPECT_EQ(tissue.body[i] >= 0, at_end);
    clamped += at_end;
  }
  EXPECT_EQ(clamped, 2 * 9);  // corners, edges' middles and the face's diagonal
}

TEST(MuscleTissue, RefusesAMuscleThatCannotBeSimulated) {
  const auto message = [](const anatomy::Specimen& specimen) -> std::string {
    try {
      build_muscle_tissue(specimen, 0);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  anatomy::Specimen loose = testing::single_muscle(short_bar(0));
  loose.muscles[0].attachments.assign(loose.muscles[0].attachments.size(), -1);
  EXPECT_NE(message(loose).find("flexor"), std::string::npos);
  anatomy::Specimen stiff = testing::single_muscle(short_bar(0));
  stiff.muscles[0].attachments.assign(stiff.muscles[0].attachments.size(), 0);
  EXPECT_NE(message(stiff).find("every node"), std::string::npos);
  anatomy::Specimen flat = testing::single_muscle(short_bar(0));
  for (Vec3& node : flat.muscles[0].tets.nodes_m) node.z() = 0.0;
  EXPECT_NE(message(flat).find("volume"), std::string::npos);
  anatomy::Specimen lineless = testing::single_muscle(short_bar(0));
  lineless.lines.clear();
  EXPECT_NE(message(lineless).find("line"), std::string::npos);
}

// The strand takes over the force of the fibres node by node: with the belly at rest and active, the border nodes are
// balanced by the fibres' own nodal forces scaled to the strand's tension.
TEST(TendonStrand, WeightsAreThoseOfAUniformTraction) {
  const MuscleTissue tissue = build_muscle_tissue(testing::single_muscle(short_bar(1)), 0);
  ASSERT_EQ(tissue.strands.size(), 1u);
  const TendonStrand& strand = tissue.strands[0];
  Vec3 middle = Vec3::Zero();
  double sum = 0.0;
  for (std::size_t k = 0; k < strand.nodes.size(); ++k) {
    sum += strand.weights[k];
    middle += strand.weights[k] * tissue.mesh.nodes_m[static_cast<std::size_t>(strand.nodes[k])];
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_LT((middle - Vec3(-0.01, 0.0, 0.03)).norm(), 1e-9);  // two thirds along, in the middle of the section
  EXPECT_NEAR(strand.rest_length_m, 0.04, 1e-9);
}

}  // namespace myotact::simulation

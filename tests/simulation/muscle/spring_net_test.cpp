#include "simulation/muscle/spring_net.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/dense_matrix.h"
#include "simulation/muscle/build_tissue.h"
#include "simulation/muscle/tissue_system.h"
#include "simulation/simulation.h"
#include "support/synthetic_specimen.h"

namespace myotact::simulation {
namespace {

testing::BarShape short_bar() {
  testing::BarShape shape;
  shape.cells = {3, 1, 1};
  return shape;
}

/// A bar of springs without fibres, at rest.
struct Net {
  Net() {
    specimen.muscles[0].peak_force_N = 0.0;
    tissue = build_muscle_tissue(specimen, 0, TissueModel::MassSpring);
    state = make_state(tissue);
    system = make_system(tissue, skeleton);
  }
  void disturb(double amplitude_m) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> noise(-amplitude_m, amplitude_m);
    for (double& x : state.now.position_m) x += noise(random);
  }
  const Eigen::VectorXd& forces() {
    compute_forces(tissue, skeleton, {}, state, system);
    return system.internal_N;
  }
  Vec3 place(std::size_t tet, std::size_t corner) const {
    return node_vector(state.now.position_m, tissue.mesh.corners[tet][corner]);
  }
  /// The energy as spring_net.h writes it, tet by tet.
  double energy_J() const {
    double sum = 0.0;
    for (std::size_t t = 0; t < tissue.mesh.corners.size(); ++t) {
      const double rest_m3 = geometry::corner_volume_m3(tissue.mesh, t);
      const Vec3 origin = place(t, 0);
      const double now_m3 = (place(t, 1) - origin).dot((place(t, 2) - origin).cross(place(t, 3) - origin)) / 6.0;
      sum += 0.5 * kVolumeSpring_Pa * rest_m3 * std::pow(now_m3 / rest_m3 - 1.0, 2);
      for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = a + 1; b < 4; ++b) {
          const auto& corners = tissue.mesh.corners[t];
          const double rest_m = (tissue.mesh.nodes_m[static_cast<std::size_t>(corners[a])] -
                                 tissue.mesh.nodes_m[static_cast<std::size_t>(corners[b])])
                                    .norm();
          const double stiffness = kSpringScale * 2.5 * kMuscleMatrix.matrix.shear_Pa * rest_m3 / (rest_m * rest_m);
          sum += 0.5 * stiffness * std::pow((place(t, a) - place(t, b)).norm() - rest_m, 2);
        }
      }
    }
    return sum;
  }

  anatomy::Specimen specimen = testing::single_muscle(short_bar());
  Skeleton skeleton{specimen};
  MuscleTissue tissue;
  TissueState state;
  TissueSystem system;
};

}  // namespace

TEST(SpringNet, StandsOnTheCornersAlone) {
  const Net net;
  EXPECT_FALSE(net.tissue.mesh.quadratic());
  EXPECT_EQ(net.tissue.body.size(), 16u);
  EXPECT_EQ(net.state.now.stretch.size(), net.tissue.elements.size());
  double mass = 0.0;
  for (double m : net.tissue.mass_kg) mass += m;
  EXPECT_NEAR(mass, 1060.0 * 0.12 * 0.02 * 0.02, 1e-12);
}

TEST(SpringNet, NothingPullsAtRest) {
  Net net;
  EXPECT_LT(net.forces().norm(), 1e-12);  // springs of some 10 N/m, lengths rounded to 1e-17 m
}

TEST(SpringNet, ForcesAreTheSlopeOfTheEnergy) {
  Net net;
  net.disturb(3e-3);
  const Eigen::VectorXd forces = net.forces();
  const double h = 1e-7, largest = forces.cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; k < forces.size(); ++k) {
    double& x = net.state.now.position_m[k];
    x += h;
    const double up = net.energy_J();
    x -= 2.0 * h;
    const double down = net.energy_J();
    x += h;
    EXPECT_NEAR((up - down) / (2.0 * h), forces[k], 1e-6 * largest) << "unknown " << k;
  }
}

TEST(SpringNet, DefiniteTangentIsSoWhereTheExactOneIsNot) {
  Net net;
  net.state.now.position_m *= 0.6;  // every edge is pressed
  const auto smallest_pivot = [&](bool definite) {
    TissueLoad load;
    load.definite = definite;
    compute_system(net.tissue, net.skeleton, load, net.state, net.system);
    const Eigen::MatrixXd lower(net.system.matrix.lower());
    const Eigen::VectorXd values = symmetric_eigen(lower).values;
    return values[0] / values.cwiseAbs().maxCoeff();
  };
  EXPECT_LT(smallest_pivot(false), -1e-3);
  EXPECT_GT(smallest_pivot(true), -1e-12);
}

TEST(SpringNet, VolumeStaysWhenTheMuscleIsPulledAndActive) {
  testing::BarShape shape;
  shape.cells = {6, 2, 2};
  Simulation simulation(testing::single_muscle(shape), {.tissue = {TissueModel::MassSpring}});
  const double kLargestChange = 0.03;
  for (const double q : {-0.3, 0.0, 0.3}) {
    for (const double a : {0.0, 1.0}) {
      ASSERT_TRUE(simulation.settle({&q, 1}, {&a, 1}));
      EXPECT_NEAR(simulation.volume_ratio(0), 1.0, kLargestChange) << "q " << q << ", activation " << a;
    }
  }
}

TEST(SpringNet, ItsJointIsMarkedAsAPreviewAndNoOther) {
  const anatomy::Specimen specimen = testing::antagonist_hinge();
  messages::SceneFrame frame;
  for (const bool springs : {true, false}) {
    SimulationSettings settings;
    settings.tissue = {TissueModel::Rigid, springs ? TissueModel::MassSpring : TissueModel::Fem};
    const Simulation simulation(specimen, settings);
    EXPECT_EQ(simulation.joint(0).preview, springs);
    simulation.write_frame(frame);
    EXPECT_EQ(frame.joints[0].preview, springs);
  }
}

}  // namespace myotact::simulation

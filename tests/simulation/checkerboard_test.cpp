// Nearly incompressible elements may answer with pressures that alternate from tet to tet and mean nothing.

#include <cmath>

#include <gtest/gtest.h>

#include "geometry/box_mesh.h"
#include "simulation/solid/static_solve.h"

namespace myotact::simulation {
namespace {

/// A cube of nu 0.495 between two rough plates that come together by 3 % of its height, n cells an edge.
struct PressedCube {
  PressedCube(int n, ElementKind kind) : solid(input_of(n, kind), "cube") {
    SolidLoads loads;
    for (int node = 0; node < solid.nodes(); ++node) {
      const double z = solid.rest_m()[3 * node + 2];
      if (z > 1e-9 && z < 1.0 - 1e-9) continue;
      for (int i = 0; i < 3; ++i) loads.held.push_back({node, i, z > 0.5 && i == 2 ? -0.03 : 0.0});
    }
    StaticOptions options;
    options.tolerance = 1e-6;
    result = solve_static(solid, loads, solid.rest_m(), options);
  }
  static SolidInput input_of(int n, ElementKind kind) {
    SolidInput input;
    input.mesh = geometry::make_box_mesh(Vec3::Ones(), {n, n, n}, geometry::BoxCells::Alike);
    input.kind = kind;
    const double shear_Pa = 10e3, bulk_over_shear = 100.0;
    input.materials = {{{StableNeoHookean{shear_Pa, (bulk_over_shear - 2.0 / 3.0) * shear_Pa}}, 1060.0, 2 * shear_Pa}};
    return input;
  }
  Vec3 centre(std::size_t tet) const {
    Vec3 sum = Vec3::Zero();
    for (int node : solid.mesh().corners[tet]) sum += 0.25 * solid.mesh().nodes_m[static_cast<std::size_t>(node)];
    return sum;
  }
  /// How much the change of volume jumps from tet to tet, over its size: root mean squares, away from the plates.
  double jump_share() const {
    const auto& tets = solid.mesh().corners;
    std::vector<double> change;
    for (std::size_t t = 0; t < tets.size(); ++t) change.push_back(solid.state_of(t, result.position_m, 0.0).J - 1.0);
    std::vector<double> sum(static_cast<std::size_t>(solid.nodes())), count(sum.size());
    for (std::size_t t = 0; t < tets.size(); ++t) {
      for (int node : tets[t]) {
        sum[static_cast<std::size_t>(node)] += change[t];
        count[static_cast<std::size_t>(node)] += 1.0;
      }
    }
    double jumps = 0.0, sizes = 0.0;
    for (std::size_t t = 0; t < tets.size(); ++t) {
      const double z = centre(t).z();
      if (z < 0.25 || z > 0.75) continue;
      double near = 0.0;
      for (int node : tets[t]) {
        near += 0.25 * sum[static_cast<std::size_t>(node)] / count[static_cast<std::size_t>(node)];
      }
      jumps += (change[t] - near) * (change[t] - near);
      sizes += change[t] * change[t];
    }
    return std::sqrt(jumps / sizes);
  }

  Solid solid;
  StaticResult result;
};

double jump_share(int n, ElementKind kind) {
  const PressedCube cube(n, kind);
  EXPECT_TRUE(cube.result.converged);
  return cube.jump_share();
}

}  // namespace

// A smooth pressure jumps less the smaller the tets are; a checkerboard stays, as it does on plain linear tets.
TEST(Checkerboard, TheDefaultElementHasNone) {
  const double coarse = jump_share(2, ElementKind::Quadratic), fine = jump_share(6, ElementKind::Quadratic);
  EXPECT_LT(coarse, 0.45);  // 0.40 measured
  EXPECT_LT(fine, 0.65 * coarse);
  EXPECT_GT(jump_share(6, ElementKind::Linear), 0.9 * jump_share(2, ElementKind::Linear));
}

}  // namespace myotact::simulation

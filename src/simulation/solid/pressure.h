#pragma once

#include <array>

#include "simulation/solid/solid.h"

namespace myotact::simulation {

/// A triangle of the surface under pressure (positive pushes against its outward normal), in its present position.
struct PressureFace {
  std::array<int, 6> nodes{};  // corners, counter-clockwise from outside, then the nodes between 01, 12, 20
  bool quadratic = false;      // else only the corners count
  double pressure_Pa = 0.0;    // at full load
};

/// Subtracts the force of the pressure, scaled by `load`, from the forces; with `tangent` adds the symmetric part of
/// its slope (all of it, for a closed surface or one whose rim is held). Positions: 3 numbers a node. A quadratic face
/// needs its nodes' pairs in the pattern, which faces of quadratic tets have.
void add_pressure(const PressureFace& face, double load, const Eigen::VectorXd& position_m, bool tangent,
                  Solid::Evaluation& out);

}  // namespace myotact::simulation

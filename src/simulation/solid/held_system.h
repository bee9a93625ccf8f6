#pragma once

#include <span>
#include <vector>

#include "simulation/solid/solid.h"

namespace myotact::simulation {

/// A component of a node that is held or moved.
struct HeldDof {
  int node = 0;                 // of the solid's mesh
  int component = 0;            // 0 x, 1 y, 2 z
  double displacement_m = 0.0;  // from rest, at full load
};

/// The linear system of a solid some of whose components are held: their rows and columns become those of the unit
/// matrix, scaled, so that the pattern stays.
class HeldSystem {
 public:
  /// Nodes and components are not checked. The solid need not outlive this.
  HeldSystem(const Solid& solid, std::span<const HeldDof> held);

  /// `dof`: 3 node + component.
  bool is_held(Eigen::Index dof) const { return held_[static_cast<std::size_t>(dof)] != 0; }
  /// Values at held components become zero; 3 numbers a node.
  void drop_held(Eigen::VectorXd& values) const;
  /// Takes the held rows and columns out of a matrix with the solid's pattern; held diagonal entries keep their value,
  /// or become 1 where that is not positive.
  void hold(BlockMatrix& matrix) const;

 private:
  std::vector<char> held_;
  std::vector<int> zeros_;  // places in the matrix's values
  std::vector<int> diagonals_;
};

}  // namespace myotact::simulation

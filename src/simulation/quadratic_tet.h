#pragma once

#include <array>

#include "core/vector.h"
#include "simulation/material.h"

// One quadratic tetrahedron: 10 nodes, straight-sided at rest, 4 integration points. Vectors of an element are
// component-major and padded with zeros to whole vector registers: entry [i * 12 + a] is component i of node a < 10.
// Pure functions, no allocation.

namespace myotact::simulation {

inline constexpr int kTetNodes = 10;
inline constexpr int kTetPoints = 4;
inline constexpr int kTetStride = 12;            // from one component to the next
inline constexpr int kTetDofs = 3 * kTetStride;  // entries of a vector, padding included

using TetVector = std::array<double, kTetDofs>;
/// Row-major stiffness. Only the blocks (component i, component j) with i <= j are filled, each with all 10 x 10 pairs;
/// its padding columns are zero, its padding rows are not touched.
using TetMatrix = std::array<double, kTetDofs * kTetDofs>;

/// What does not change: gradients of the shape functions in the rest position and the volume of a point.
struct TetRest {
  std::array<TetVector, kTetPoints> gradients_1_m{};  // [point][A * 12 + a] = dN_a / dX_A
  double point_volume_m3 = 0.0;                       // the same at the 4 points
};

/// From the rest position of the 4 corners (volume > 0).
TetRest make_tet_rest(const std::array<Vec3, 4>& corners_m);

/// State at the integration points of a deformed element.
struct TetPoints {
  std::array<std::array<double, 9>, kTetPoints> F{};         // row-major deformation gradient
  std::array<std::array<double, 9>, kTetPoints> cofactor{};  // dJ/dF
  std::array<double, kTetPoints> J{};
  std::array<double, kTetPoints> F_squared{};  // F : F
  std::array<double, kTetPoints> stretch{};    // of the fibre, >= kShortestStretch
  std::array<Vec3, kTetPoints> fibre{};        // its direction now, unit
  double mean_J = 1.0;
};

void deform(const TetRest& rest, const Vec3& fibre, const TetVector& position_m, TetPoints& points);

/// Nominal stress of the fibre (force over rest section) and its slope against the stretch.
struct FibreStress {
  std::array<double, kTetPoints> stress_Pa{};
  std::array<double, kTetPoints> slope_Pa{};
};

/// One element's data for its forces and stiffness. `fibre` is the unit direction at rest.
struct ElementInputs {
  const TetRest& rest;
  const TissueMaterial& material;
  const TetPoints& points;
  const Vec3& fibre;
  const FibreStress& stress;
};

/// Forces that hold the deformed element at its nodes (slope of its energy) [N].
TetVector elastic_forces(const ElementInputs& inputs);

/// Slope of the forces against the positions [N/m], symmetric. `definite` drops or bounds every term that could make
/// it indefinite: a slower but safe Newton matrix.
void elastic_stiffness(const ElementInputs& inputs, bool definite, TetMatrix& stiffness_N_m);

/// stiffness * vector for the half-filled matrix.
TetVector multiply(const TetMatrix& stiffness, const TetVector& vector);

}  // namespace myotact::simulation

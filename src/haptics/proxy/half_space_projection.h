#pragma once

#include <array>
#include <span>

#include "core/vector.h"

namespace myotact::haptics {

/// The points x with normal.(x) >= offset_m. `normal` is unit.
struct HalfSpace {
  Vec3 normal = Vec3::UnitZ();
  double offset_m = 0.0;
};

/// Closest point of an intersection of half-spaces, and what holds it there.
struct Projection {
  Vec3 point_m = Vec3::Zero();
  bool feasible = true;  // false: the half-spaces have no common point (or it was not found); `point_m` is unset
  int active_count = 0;
  std::array<int, 3> active{};         // half-spaces that hold the point
  std::array<double, 3> reaction_m{};  // > 0: point - goal = sum reaction_m normal
};

/// Closest point to `goal_m` in the intersection, exact to 10 nm. At most 3 half-spaces hold a point of space, so the
/// search goes from one holding set to the next, each farther from the goal (an LP-type problem: Sharir and Welzl
/// 1992). Real-time safe.
Projection project_to_half_spaces(const Vec3& goal_m, std::span<const HalfSpace> half_spaces) noexcept;

}  // namespace myotact::haptics

#include "haptics/proxy/half_space_projection.h"

#include <Eigen/LU>

namespace myotact::haptics {

namespace {

constexpr double kTolerance_m = 1e-8;  // far below any encoder count; far above rounding at metres
/// Determinant of the Gram matrix of unit normals below which they count as dependent: an angle of 1e-6 rad between
/// two.
constexpr double kDependent = 1e-12;
/// A set holds at most 3 and each change goes farther from the goal; 3 to 8 changes are usual, 40 never seen.
constexpr int kMaxChanges = 40;

struct Held {
  std::array<int, 4> index{};
  int count = 0;
};

/// Reactions that put the goal on the planes of `held`. False when their normals are dependent.
bool solve_planes(const Vec3& goal_m, std::span<const HalfSpace> all, const Held& held,
                  std::array<double, 3>& reaction_m) {
  const auto normal = [&](int i) -> const Vec3& {
    return all[static_cast<std::size_t>(held.index[static_cast<std::size_t>(i)])].normal;
  };
  const auto lack = [&](int i) {
    return all[static_cast<std::size_t>(held.index[static_cast<std::size_t>(i)])].offset_m - normal(i).dot(goal_m);
  };
  if (held.count == 1) {
    reaction_m[0] = lack(0);
    return true;
  }
  if (held.count == 2) {
    const double c = normal(0).dot(normal(1));
    const double determinant = 1.0 - c * c;
    if (determinant < kDependent) return false;
    reaction_m[0] = (lack(0) - c * lack(1)) / determinant;
    reaction_m[1] = (lack(1) - c * lack(0)) / determinant;
    return true;
  }
  Mat3 gram;
  Vec3 lacks;
  for (int i = 0; i < 3; ++i) {
    lacks[i] = lack(i);
    for (int j = 0; j < 3; ++j) gram(i, j) = normal(i).dot(normal(j));
  }
  if (gram.determinant() < kDependent) return false;
  const Vec3 solved = gram.inverse() * lacks;
  for (int i = 0; i < 3; ++i) reaction_m[static_cast<std::size_t>(i)] = solved[i];
  return true;
}

/// Whether `held`, all of it pushing, puts the goal inside every half-space of `among`.
bool try_set(const Vec3& goal_m, std::span<const HalfSpace> all, const Held& held, const Held& among,
             Projection& result) {
  std::array<double, 3> reaction_m{};
  if (!solve_planes(goal_m, all, held, reaction_m)) return false;
  Vec3 point_m = goal_m;
  for (int i = 0; i < held.count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (!(reaction_m[at] > 0.0)) return false;
    point_m += reaction_m[at] * all[static_cast<std::size_t>(held.index[at])].normal;
  }
  for (int i = 0; i < among.count; ++i) {
    const HalfSpace& half = all[static_cast<std::size_t>(among.index[static_cast<std::size_t>(i)])];
    if (half.normal.dot(point_m) < half.offset_m - kTolerance_m) return false;
  }
  result.point_m = point_m;
  result.active_count = held.count;
  for (std::size_t i = 0; i < 3; ++i) result.active[i] = held.index[i];
  result.reaction_m = reaction_m;
  return true;
}

/// The closest point to the goal in at most 4 half-spaces: tries every set of up to 3 that contains the last one, which
/// is the one just found violated.
bool solve_small(const Vec3& goal_m, std::span<const HalfSpace> all, const Held& among, Projection& result) {
  const int last = among.index[static_cast<std::size_t>(among.count - 1)];
  const unsigned others = static_cast<unsigned>(among.count - 1);
  for (unsigned mask = 0; mask < (1u << others); ++mask) {
    Held held;
    bool small = true;
    for (unsigned i = 0; i < others; ++i) {
      if ((mask >> i & 1u) == 0) continue;
      small = held.count < 2;
      if (!small) break;
      held.index[static_cast<std::size_t>(held.count++)] = among.index[i];
    }
    if (!small) continue;
    held.index[static_cast<std::size_t>(held.count++)] = last;
    if (try_set(goal_m, all, held, among, result)) return true;
  }
  return false;
}

int most_violated(const Vec3& point_m, std::span<const HalfSpace> all) {
  double worst_m = kTolerance_m;
  int found = -1;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double lack_m = all[i].offset_m - all[i].normal.dot(point_m);
    if (lack_m > worst_m) {
      worst_m = lack_m;
      found = static_cast<int>(i);
    }
  }
  return found;
}

}  // namespace

Projection project_to_half_spaces(const Vec3& goal_m, std::span<const HalfSpace> half_spaces) noexcept {
  Projection result;
  result.point_m = goal_m;
  for (int change = 0; change < kMaxChanges; ++change) {
    const int violated = most_violated(result.point_m, half_spaces);
    if (violated < 0) return result;
    Held among;
    for (int i = 0; i < result.active_count; ++i) {
      among.index[static_cast<std::size_t>(among.count++)] = result.active[static_cast<std::size_t>(i)];
    }
    among.index[static_cast<std::size_t>(among.count++)] = violated;
    if (!solve_small(goal_m, half_spaces, among, result)) break;
  }
  result.feasible = false;
  return result;
}

}  // namespace myotact::haptics

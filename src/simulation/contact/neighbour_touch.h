#pragma once

#include <array>

#include "core/vector.h"

namespace myotact::simulation {

/// One node of a muscle against a place on a neighbour, as one of the two muscles sees it. The gap from the node to the
/// place, g = sum over both muscles' nodes of weight x, is linear in them for a step. Two kinds:
/// - the node over a flat quarter of a face. Face, place and normal stay for a step; the energy is the area times the
///   law's over the overlap s = normal . g - rest_depth, shared by the two.
/// - a tie of fascia, for good: the place lies in the neighbour's tet, where the node was at the file pose, and the
///   energy is area tension / 2 g^2.
struct NeighbourTouch {
  int count = 0;                                    // own nodes: 1 (it touches), or 3 or 4 (it is touched)
  std::array<int, 4> nodes{};                       // own
  std::array<double, 4> weights{};                  // -1, or the place on the face or in the tet
  bool tie = false;                                 // the second kind
  Vec3 normal_W = Vec3::Zero();                     // out of the touched muscle; unused by a tie
  double area_m2 = 0.0;                             // half of what the touching node carries
  double tension_Pa_m = 0.0;                        // of the fascia that holds the two; 0: they may come apart
  double rest_depth_m = 0.0;                        // overlap at the file pose, which counts as touching
  double others_overlap_m = 0.0;                    // the neighbour's nodes' part of s, less the rest depth
  Vec3 others_m = Vec3::Zero();                     // W: of a tie, the neighbour's nodes' part of g
  int neighbour = -1, counterpart = -1;             // muscle, and the same touch in its list
  std::array<int, 4> rider_bodies{-1, -1, -1, -1};  // that clamp nodes of the place: joints move it
  std::array<Vec3, 4> riders_rest_m{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  // L
  std::array<double, 4> rider_weights{};  // barycentric, of the place
  bool touched = false;                   // sees it from the touched side, which hands the riders' forces to the joints
  double slope_N_m = 0.0;                 // of the last tangent: along the normal, or of a tie in all directions
};

/// d2(energy)/d(gap)2 [N/m], by its slope along the normal or, of a tie, in all directions.
inline Mat3 touch_slope(const NeighbourTouch& touch, double slope_N_m) {
  if (touch.tie) return slope_N_m * Mat3::Identity();
  return slope_N_m * touch.normal_W * touch.normal_W.transpose();
}

}  // namespace myotact::simulation

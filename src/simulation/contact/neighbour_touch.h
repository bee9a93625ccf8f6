#pragma once

#include <array>

#include "core/vector.h"

namespace myotact::simulation {

/// One node of a muscle against a flat quarter of a neighbour's face, as one of the two muscles sees it. Which face,
/// the place on it and the normal stay for a step; the overlap
///
///   s = others_m + sum_k weights_k normal . x_k
///
/// then is linear in the nodes of both muscles. Energy: area times the law's over s, shared by the two.
struct NeighbourTouch {
  int count = 0;                                // own nodes: 1 (it touches) or 3 (it is touched)
  std::array<int, 3> nodes{};                   // own
  std::array<double, 3> weights{};              // -1, or the place on the face
  Vec3 normal_W = Vec3::Zero();                 // out of the touched muscle
  double area_m2 = 0.0;                         // half of what the touching node carries
  double rest_depth_m = 0.0;                    // overlap at the file pose, which counts as touching
  double others_m = 0.0;                        // the neighbour's nodes' part of s, less the rest depth
  int neighbour = -1, counterpart = -1;         // muscle, and the same touch in its list
  std::array<int, 3> rider_bodies{-1, -1, -1};  // that clamp nodes of the face: joints move it
  std::array<Vec3, 3> riders_rest_m{};          // L
  std::array<double, 3> rider_weights{};        // barycentric, on the face
  bool touched = false;    // sees it from the touched side, which hands the riders' forces to the joints
  double slope_N_m = 0.0;  // of the last tangent
};

}  // namespace myotact::simulation

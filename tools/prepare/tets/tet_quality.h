#pragma once

#include <array>

#include "geometry/tet_mesh.h"

namespace myotact::prepare {

/// How good the tets are. Angles between faces are in degrees, because people read them.
struct TetQuality {
  int tets = 0;
  double smallest_dihedral_deg = 0.0;
  Vec3 flattest_m = Vec3::Zero();  // centre of the tet that has it
  double first_percentile_dihedral_deg = 0.0;
  double mean_ratio = 0.0;       // mean over the tets; 1: regular (Liu and Joe 1994), 0: flat
  double shortest_edge_m = 0.0;  // it and the smallest height limit the time step
  double smallest_height_m = 0.0;
  double volume_m3 = 0.0;
};

TetQuality measure_tets(const geometry::TetMesh& mesh);

using TetCorners = std::array<Vec3, 4>;

/// The six angles between the faces of a tet [degrees].
std::array<double, 6> dihedrals_deg(const TetCorners& x);
/// 12 (3 V)^(2/3) over the sum of the squared edges (Liu and Joe 1994).
double mean_ratio_of(const TetCorners& x);
TetCorners corners_of(const geometry::TetMesh& mesh, std::size_t tet);

}  // namespace myotact::prepare

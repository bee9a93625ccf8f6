#include "prepare/tets/tet_quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

namespace myotact::prepare {

namespace {

/// Each edge, then the two other corners.
constexpr std::array<std::array<std::size_t, 4>, 6> kEdges = {
    {{0, 1, 2, 3}, {1, 2, 0, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 3, 0, 2}, {2, 3, 0, 1}}};

double volume_m3(const TetCorners& x) {
  return (x[1] - x[0]).dot((x[2] - x[0]).cross(x[3] - x[0])) / 6.0;
}

double smallest_height_m(const TetCorners& x) {
  double largest_m2 = 0.0;  // face
  for (std::size_t skip = 0; skip < 4; ++skip) {
    const Vec3 &a = x[(skip + 1) % 4], &b = x[(skip + 2) % 4], &c = x[(skip + 3) % 4];
    largest_m2 = std::max(largest_m2, 0.5 * (b - a).cross(c - a).norm());
  }
  return 3.0 * volume_m3(x) / largest_m2;
}

}  // namespace

double mean_ratio_of(const TetCorners& x) {
  double squares_m2 = 0.0;
  for (const auto& [a, b, c, d] : kEdges) squares_m2 += (x[b] - x[a]).squaredNorm();
  return 12.0 * std::pow(3.0 * std::max(volume_m3(x), 0.0), 2.0 / 3.0) / squares_m2;
}

std::array<double, 6> dihedrals_deg(const TetCorners& x) {
  std::array<double, 6> angles_deg{};
  for (std::size_t e = 0; e < kEdges.size(); ++e) {
    const auto& [a, b, c, d] = kEdges[e];
    const Vec3 edge = (x[b] - x[a]).normalized();
    const Vec3 u = x[c] - x[a], v = x[d] - x[a];
    const Vec3 p = u - edge.dot(u) * edge, q = v - edge.dot(v) * edge;
    angles_deg[e] = std::atan2(p.cross(q).norm(), p.dot(q)) * 180.0 / std::numbers::pi;
  }
  return angles_deg;
}

TetCorners corners_of(const geometry::TetMesh& mesh, std::size_t tet) {
  TetCorners x;
  for (std::size_t k = 0; k < 4; ++k) x[k] = mesh.nodes_m[static_cast<std::size_t>(mesh.corners[tet][k])];
  return x;
}

TetQuality measure_tets(const geometry::TetMesh& mesh) {
  TetQuality quality;
  quality.tets = static_cast<int>(mesh.corners.size());
  quality.volume_m3 = geometry::total_volume_m3(mesh);
  quality.shortest_edge_m = quality.smallest_height_m = std::numeric_limits<double>::infinity();
  std::vector<double> angles_deg;
  for (std::size_t t = 0; t < mesh.corners.size(); ++t) {
    const TetCorners x = corners_of(mesh, t);
    const auto angles = dihedrals_deg(x);
    if (const double smallest_deg = *std::min_element(angles.begin(), angles.end());
        angles_deg.empty() || smallest_deg < quality.smallest_dihedral_deg) {
      quality.smallest_dihedral_deg = smallest_deg;
      quality.flattest_m = 0.25 * (x[0] + x[1] + x[2] + x[3]);
    }
    angles_deg.insert(angles_deg.end(), angles.begin(), angles.end());
    quality.mean_ratio += mean_ratio_of(x) / static_cast<double>(mesh.corners.size());
    quality.smallest_height_m = std::min(quality.smallest_height_m, smallest_height_m(x));
    for (const auto& [a, b, c, d] : kEdges) {
      quality.shortest_edge_m = std::min(quality.shortest_edge_m, (x[b] - x[a]).norm());
    }
  }
  if (angles_deg.empty()) return quality;
  std::sort(angles_deg.begin(), angles_deg.end());
  quality.first_percentile_dihedral_deg = angles_deg[angles_deg.size() / 100];
  return quality;
}

}  // namespace myotact::prepare

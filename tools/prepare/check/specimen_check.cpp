#include "prepare/check/specimen_check.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include <fmt/format.h>

#include "geometry/tet_topology.h"
#include "prepare/field/signed_distance.h"
#include "prepare/part/overlap_measure.h"
#include "prepare/remesh/crossing_triangles.h"
#include "prepare/remesh/surface_distance.h"
#include "prepare/tets/tet_quality.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

/// What preparation promises.
constexpr double kSmallestDihedral_deg = 5.0;
constexpr double kFirstPercentile_deg = 10.0;
constexpr double kMeanRatio = 0.7;
constexpr double kVolumeDifference = 0.02;  // of cage and skin: each within 1 % of the parted surface
/// Remaining overlaps deeper than this are named [m].
constexpr double kDeepestListed_m = 1e-3;
/// Overlaps deeper than this, or than what is listed by this, are violations: contact would push there [m].
constexpr double kDepth_m = 2e-4;

std::string place_text(const Vec3& p) {
  return fmt::format("({:.4f}, {:.4f}, {:.4f}) m", p.x(), p.y(), p.z());
}

void check_crossings(const std::string& file, const TriangleMesh& surface, std::vector<std::string>& violations) {
  const auto crossings = crossing_triangles(surface);
  if (crossings.empty()) return;
  const auto& corner = surface.triangles[static_cast<std::size_t>(crossings.front().first)][0];
  violations.push_back(fmt::format("{}: triangle {}: {} pairs of triangles cross, the first at {}; must be 0", file,
                                   crossings.front().first, crossings.size(),
                                   place_text(surface.positions_m[static_cast<std::size_t>(corner)])));
}

TriangleMesh boundary_of(const geometry::TetMesh& tets) {
  TriangleMesh surface;
  surface.positions_m = tets.nodes_m;
  for (const auto& triangle : geometry::boundary_triangles(tets)) surface.triangles.push_back(triangle.corners);
  return surface;
}

/// Edge length of regular tets of that volume.
double usual_edge_m(const TetQuality& quality) {
  return std::cbrt(6.0 * std::sqrt(2.0) * quality.volume_m3 / quality.tets);
}

void check_muscle(const anatomy::Muscle& muscle, std::vector<std::string>& violations) {
  const std::string file = "muscles/" + muscle.key + ".vtk";
  const TetQuality quality = measure_tets(muscle.tets);
  const auto at_least = [&](const char* what, double value, double limit, const char* unit) {
    if (value < limit)
      violations.push_back(
          fmt::format("{}: {} is {:.2f}{}; must be at least {}{}", file, what, value, unit, limit, unit));
  };
  at_least("smallest dihedral angle", quality.smallest_dihedral_deg, kSmallestDihedral_deg, " degrees");
  at_least("first percentile of the dihedral angles", quality.first_percentile_dihedral_deg, kFirstPercentile_deg,
           " degrees");
  at_least("mean ratio", quality.mean_ratio, kMeanRatio, "");
  const TriangleMesh boundary = boundary_of(muscle.tets);
  check_crossings(file, boundary, violations);
  check_crossings("skins/" + muscle.key + ".ply", muscle.skin, violations);
  const double skin_m3 = geometry::enclosed_volume_m3(muscle.skin);
  if (std::abs(quality.volume_m3 / skin_m3 - 1.0) > kVolumeDifference) {
    violations.push_back(fmt::format("{}: holds {:.2f} cm3, its skin {:.2f}; must differ by at most {:.0f} %", file,
                                     1e6 * quality.volume_m3, 1e6 * skin_m3, 1e2 * kVolumeDifference));
  }
  const std::set<int> bodies(muscle.attachments.begin(), muscle.attachments.end());
  if (bodies.size() < 2) violations.push_back(file + ": no node is free; nothing could move");
  const double edge_m = usual_edge_m(quality);
  const SurfaceDistance apart = one_way_distance(muscle.skin, boundary);
  if (apart.largest_m > edge_m) {
    violations.push_back(
        fmt::format("skins/{}.ply: lies {:.1f} mm from the tets' surface at {}; must be at most {:.1f}", muscle.key,
                    1e3 * apart.largest_m, place_text(apart.place_m), 1e3 * edge_m));
  }
}

struct Body {
  std::string key;
  std::unique_ptr<SignedDistance> skin;
};

bool is_closed(const TriangleMesh& surface) {
  return !surface.triangles.empty() && geometry::bad_edge_count(surface) == 0;
}

double listed_depth_m(const anatomy::Specimen& specimen, const std::string& a, const std::string& b) {
  double depth_m = 0.0;
  for (const anatomy::Overlap& o : specimen.overlaps) {
    if ((o.a == a && o.b == b) || (o.a == b && o.b == a)) depth_m = std::max(depth_m, o.depth_m);
  }
  return depth_m;
}

/// Muscles against each other and against bones.
void check_overlaps(const anatomy::Specimen& specimen, std::vector<std::string>& violations) {
  std::vector<Body> bodies;
  for (const anatomy::Muscle& m : specimen.muscles) {
    if (is_closed(m.skin)) bodies.push_back({m.key, std::make_unique<SignedDistance>(m.skin)});
  }
  const std::size_t muscles = bodies.size();
  for (const anatomy::Bone& b : specimen.bones) {
    if (is_closed(b.surface)) bodies.push_back({b.key, std::make_unique<SignedDistance>(b.surface)});
  }
  for (std::size_t a = 0; a < muscles; ++a) {
    for (std::size_t b = a + 1; b < bodies.size(); ++b) {
      const double depth_m = measure_overlap(*bodies[a].skin, *bodies[b].skin).depth_m;
      const double listed_m = listed_depth_m(specimen, bodies[a].key, bodies[b].key);
      if (depth_m <= listed_m + kDepth_m) continue;
      violations.push_back(fmt::format(
          "specimen.json: overlaps: {} and {} reach {:.2f} mm into each other; listed are {:.2f} mm, must be at most "
          "{:.1f} mm more",
          bodies[a].key, bodies[b].key, 1e3 * depth_m, 1e3 * listed_m, 1e3 * kDepth_m));
    }
  }
}

}  // namespace

std::vector<std::string> find_violations(const anatomy::Specimen& specimen) {
  std::vector<std::string> violations;
  for (const anatomy::Muscle& muscle : specimen.muscles) {
    if (anatomy::find_defects(muscle, specimen.bodies.size()).empty()) check_muscle(muscle, violations);
  }
  check_overlaps(specimen, violations);
  for (const anatomy::Overlap& overlap : specimen.overlaps) {
    if (overlap.depth_m <= kDeepestListed_m) continue;
    violations.push_back(
        fmt::format("specimen.json: overlaps: {} and {} reach {:.2f} mm into each other; must be at most {:.2f} mm",
                    overlap.a, overlap.b, 1e3 * overlap.depth_m, 1e3 * kDeepestListed_m));
  }
  return violations;
}

}  // namespace myotact::prepare

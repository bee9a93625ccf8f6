#include "prepare/remesh/fine_surface.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "prepare/field/level_set.h"
#include "prepare/field/signed_distance.h"
#include "prepare/remesh/decimate.h"

namespace myotact::prepare {

namespace {

/// Surfaces of fewer triangles are left alone.
constexpr std::size_t kFewTriangles = 6000;
/// Surfaces of more are resampled on a lattice.
constexpr std::size_t kManyTriangles = 400'000;
/// Triangles of a resampled surface, roughly; thin bodies get more.
constexpr double kResampledTriangles = 60000.0;
constexpr double kFineTolerance_m = 1.5e-4;
/// Small bodies get parts of their diagonal instead.
constexpr double kFineTolerance = 1.5e-3;
constexpr double kSkinTolerance = 2.5e-3;
constexpr double kFineEdge_m = 2.5e-3;
/// How far a skin may lie from the fine surface: less than a tenth of the tool's radius of 3 mm is not felt.
constexpr double kSkinTolerance_m = 2.5e-4;
/// Longest edge of skins, roughly: triangles smaller than the tool only cost time.
constexpr double kSkinEdge_m = 5.5e-3;

double diagonal_m(const geometry::TriangleMesh& surface) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : surface.positions_m) box.extend(p);
  return box.diagonal().norm();
}

geometry::TriangleMesh resample(const geometry::TriangleMesh& surface) {
  const SignedDistance distance(surface);
  const double area_m2 = geometry::surface_area_m2(surface);
  const double spacing_m = std::min(spacing_for_triangles_m(area_m2, kResampledTriangles),
                                    spacing_for_thickness_m(area_m2, distance.volume_m3()));
  return extract_level_set([&](const Vec3& p) { return distance(p); }, distance.box(), spacing_m);
}

}  // namespace

geometry::TriangleMesh fine_surface(const geometry::TriangleMesh& surface) {
  if (surface.triangles.size() <= kFewTriangles) return surface;
  const DecimateSettings settings{kFineEdge_m, std::min(kFineTolerance_m, kFineTolerance * diagonal_m(surface))};
  return decimate(surface.triangles.size() <= kManyTriangles ? surface : resample(surface), settings);
}

geometry::TriangleMesh skin_surface(const geometry::TriangleMesh& fine) {
  return decimate(fine, {kSkinEdge_m, std::min(kSkinTolerance_m, kSkinTolerance * diagonal_m(fine))});
}

}  // namespace myotact::prepare

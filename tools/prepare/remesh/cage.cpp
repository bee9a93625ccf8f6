#include "prepare/remesh/cage.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/error.h"
#include "prepare/remesh/half_edges.h"
#include "prepare/remesh/surface_remesh.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

/// Each attempt shortens the edge by this; ten of them reach a third of the length, where even sheets come out clean.
constexpr double kShorter = 0.9;
constexpr int kAttempts = 10;
/// Newton steps on the offset: the volume is nearly linear in it, four leave less than 1e-6.
constexpr int kOffsetSteps = 4;
/// The enclosed volume may differ by this at most (muscle force is volume over length).
constexpr double kVolumeTolerance = 0.01;

/// Moves all vertices along their normals until the surface encloses `volume_m3`.
void restore_volume(TriangleMesh& mesh, double volume_m3) {
  for (int step = 0; step < kOffsetSteps; ++step) {
    const double offset_m = (volume_m3 - geometry::enclosed_volume_m3(mesh)) / geometry::surface_area_m2(mesh);
    const std::vector<Vec3> normals = geometry::vertex_normals(mesh);
    for (std::size_t v = 0; v < normals.size(); ++v) mesh.positions_m[v] += offset_m * normals[v];
  }
}

}  // namespace

double edge_for_tets_m(double volume_m3, double tets) {
  return std::cbrt(6.0 * std::numbers::sqrt2 * volume_m3 / tets);
}

EvenSurface even_surface(const std::string& name, const TriangleMesh& surface, double edge_m) {
  const double volume_m3 = geometry::enclosed_volume_m3(surface);
  EvenSurface result;
  result.edge_m = edge_m;
  for (int attempt = 1; attempt <= kAttempts; ++attempt, result.edge_m *= kShorter) {
    result.mesh = remesh_evenly(surface, result.edge_m);
    if (geometry::bad_edge_count(result.mesh) != 0 || result.mesh.triangles.size() < 8) continue;
    relax_along_surface(result.mesh, 1);
    restore_volume(result.mesh, volume_m3);
    result.attempts = attempt;
    result.volume_error = geometry::enclosed_volume_m3(result.mesh) / volume_m3 - 1.0;
    if (std::abs(result.volume_error) < kVolumeTolerance && crossing_triangles(result.mesh).empty()) return result;
  }
  throw bad_data(
      name, "surface",
      fmt::format("could not be remeshed without crossings in {} attempts; look for parts thinner than {:.1f} "
                  "mm and thicken or cut them",
                  kAttempts, 1e3 * result.edge_m));
}

}  // namespace myotact::prepare

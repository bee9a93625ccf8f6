#include "prepare/remesh/surface_remesh.h"

#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include "prepare/cgal_mesh.h"

namespace myotact::prepare {

namespace {

using Face = CgalMesh::Face_index;

/// Passes of split, collapse, flip and smooth. Edge lengths change by less than 2 % from the fifth pass on.
constexpr unsigned kPasses = 5;
/// Smoothing and projection after each pass, to even the angles before tetrahedra are made.
constexpr unsigned kRelaxations = 3;

}  // namespace

std::vector<std::pair<int, int>> crossing_triangles(const geometry::TriangleMesh& mesh, unsigned most) {
  const CgalMesh surface = to_cgal(mesh);
  std::vector<std::pair<Face, Face>> found;
  CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(found),
                                                    CGAL::parameters::maximum_number(most));
  std::vector<std::pair<int, int>> pairs;
  for (const auto& [a, b] : found) pairs.emplace_back(static_cast<int>(a.idx()), static_cast<int>(b.idx()));
  return pairs;
}

geometry::TriangleMesh remesh_evenly(const geometry::TriangleMesh& mesh, double edge_m) {
  CgalMesh surface = to_cgal(mesh);
  CGAL::Polygon_mesh_processing::isotropic_remeshing(
      surface.faces(), edge_m, surface,
      CGAL::parameters::number_of_iterations(kPasses).number_of_relaxation_steps(kRelaxations));
  return from_cgal(surface);
}

}  // namespace myotact::prepare

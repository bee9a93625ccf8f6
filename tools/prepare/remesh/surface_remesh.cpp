#include "prepare/remesh/surface_remesh.h"

#include <array>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

namespace myotact::prepare {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = CgalMesh::Vertex_index;
using Face = CgalMesh::Face_index;

/// Passes of split, collapse, flip and smooth. Edge lengths change by less than 2 % from the fifth pass on.
constexpr unsigned kPasses = 5;
/// Smoothing and projection after each pass, to even the angles before tetrahedra are made.
constexpr unsigned kRelaxations = 3;

CgalMesh to_cgal(const geometry::TriangleMesh& mesh) {
  CgalMesh result;
  for (const Vec3& p : mesh.positions_m) result.add_vertex({p.x(), p.y(), p.z()});
  for (const auto& [a, b, c] : mesh.triangles) {
    result.add_face(Vertex(static_cast<unsigned>(a)), Vertex(static_cast<unsigned>(b)),
                    Vertex(static_cast<unsigned>(c)));
  }
  return result;
}

geometry::TriangleMesh from_cgal(CgalMesh& mesh) {
  mesh.collect_garbage();
  geometry::TriangleMesh result;
  for (const Vertex v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    result.positions_m.emplace_back(p.x(), p.y(), p.z());
  }
  for (const Face f : mesh.faces()) {
    std::array<int, 3> corners{};
    std::size_t k = 0;
    for (const Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) corners.at(k++) = static_cast<int>(v.idx());
    result.triangles.push_back(corners);
  }
  return result;
}

}  // namespace

std::vector<std::pair<int, int>> crossing_triangles(const geometry::TriangleMesh& mesh) {
  const CgalMesh surface = to_cgal(mesh);
  std::vector<std::pair<Face, Face>> found;
  CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(found));
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

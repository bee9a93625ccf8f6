#pragma once

#include <array>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "geometry/triangle_mesh.h"

// For the files of myotact_prepare_cgal only.

namespace myotact::prepare {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;

inline CgalMesh to_cgal(const geometry::TriangleMesh& mesh) {
  CgalMesh result;
  const auto count = static_cast<CgalMesh::size_type>(mesh.triangles.size());
  result.reserve(static_cast<CgalMesh::size_type>(mesh.positions_m.size()), count + count / 2, count);
  for (const Vec3& p : mesh.positions_m) result.add_vertex({p.x(), p.y(), p.z()});
  for (const auto& [a, b, c] : mesh.triangles) {
    result.add_face(CgalMesh::Vertex_index(static_cast<unsigned>(a)), CgalMesh::Vertex_index(static_cast<unsigned>(b)),
                    CgalMesh::Vertex_index(static_cast<unsigned>(c)));
  }
  return result;
}

inline geometry::TriangleMesh from_cgal(CgalMesh& mesh) {
  mesh.collect_garbage();
  geometry::TriangleMesh result;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    result.positions_m.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : mesh.faces()) {
    std::array<int, 3> corners{};
    std::size_t k = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) corners.at(k++) = static_cast<int>(v.idx());
    result.triangles.push_back(corners);
  }
  return result;
}

}  // namespace myotact::prepare

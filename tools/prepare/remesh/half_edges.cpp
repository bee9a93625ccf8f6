#include "prepare/remesh/half_edges.h"

#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"

namespace myotact::prepare {

namespace {

/// Metres in double: the default float traits lose needles of a nanometre and anything far from the origin.
struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

/// Part of the way to the neighbours' middle in one pass; more would let neighbours overtake each other.
constexpr double kRelaxation = 0.5;

OpenMesh::VertexHandle handle(int vertex) {
  return OpenMesh::VertexHandle(vertex);
}

/// Leaves `failed_triangle` at -1 when all went in.
HalfEdgeMesh to_half_edges(const geometry::TriangleMesh& mesh, int& failed_triangle) {
  HalfEdgeMesh result;
  failed_triangle = -1;
  omerr().disable();  // the triangle it complains about is named below
  for (const Vec3& p : mesh.positions_m) result.add_vertex({p.x(), p.y(), p.z()});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (!result.add_face(handle(a), handle(b), handle(c)).is_valid() && failed_triangle < 0) {
      failed_triangle = static_cast<int>(t);
    }
  }
  return result;
}

}  // namespace

void check_half_edges(const std::string& name, const geometry::TriangleMesh& mesh) {
  int bad = -1;
  const HalfEdgeMesh half_edges = to_half_edges(mesh, bad);
  int vertex = bad < 0 ? -1 : mesh.triangles[static_cast<std::size_t>(bad)][0];
  for (const auto v : half_edges.vertices()) {
    if (vertex < 0 && !half_edges.is_manifold(v)) vertex = v.idx();
  }
  if (vertex < 0) return;
  const Vec3& p = mesh.positions_m[static_cast<std::size_t>(vertex)];
  throw bad_data(
      name, fmt::format("vertex {}", vertex),
      fmt::format("at ({}, {}, {}) m joins more than one fan of triangles; separate the parts that touch there",
                  to_text(p.x()), to_text(p.y()), to_text(p.z())));
}

void relax_along_surface(geometry::TriangleMesh& mesh, int passes) {
  int bad = -1;
  const HalfEdgeMesh half_edges = to_half_edges(mesh, bad);
  for (int pass = 0; pass < passes; ++pass) {
    const std::vector<Vec3> normals = geometry::vertex_normals(mesh);
    const std::vector<Vec3> before = mesh.positions_m;
    for (const auto v : half_edges.vertices()) {
      const auto index = static_cast<std::size_t>(v.idx());
      Vec3 middle = Vec3::Zero();
      int count = 0;
      for (auto neighbour = half_edges.cvv_iter(v); neighbour.is_valid(); ++neighbour, ++count) {
        middle += before[static_cast<std::size_t>(neighbour->idx())];
      }
      if (count == 0) continue;
      const Vec3 step = middle / count - before[index];
      mesh.positions_m[index] += kRelaxation * (step - normals[index].dot(step) * normals[index]);
    }
  }
}

}  // namespace myotact::prepare

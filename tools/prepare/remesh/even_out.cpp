#include "prepare/remesh/even_out.h"

#include <algorithm>

namespace myotact::prepare {

namespace {

/// Longer edges are halved (Botsch and Kobbelt 2004).
constexpr double kLongest = 4.0 / 3.0;
/// Part of the way to the neighbours' middle in one move.
constexpr double kRelaxation = 0.6;

double worst_shape_around(const GuardedMesh& guarded, OpenMesh::EdgeHandle e, bool flipped) {
  const HalfEdgeMesh& mesh = guarded.mesh();
  const auto h0 = mesh.halfedge_handle(e, 0), h1 = mesh.halfedge_handle(e, 1);
  const Vec3 a = guarded.position_m(mesh.from_vertex_handle(h0)), b = guarded.position_m(mesh.to_vertex_handle(h0));
  const Vec3 left = guarded.position_m(mesh.to_vertex_handle(mesh.next_halfedge_handle(h0)));
  const Vec3 right = guarded.position_m(mesh.to_vertex_handle(mesh.next_halfedge_handle(h1)));
  return flipped ? std::min(shape_of({a, right, left}), shape_of({b, left, right}))
                 : std::min(shape_of({a, b, left}), shape_of({b, a, right}));
}

void flip_where_better(GuardedMesh& guarded) {
  for (int e = 0; e < static_cast<int>(guarded.mesh().n_edges()); ++e) {
    const OpenMesh::EdgeHandle edge(e);
    if (guarded.mesh().status(edge).deleted() || !guarded.mesh().is_flip_ok(edge)) continue;
    const double now = worst_shape_around(guarded, edge, false), then = worst_shape_around(guarded, edge, true);
    if (then > now) guarded.try_flip(edge, 1.0);
  }
}

void split_long_edges(GuardedMesh& guarded, double edge_m) {
  const int edges = static_cast<int>(guarded.mesh().n_edges());
  for (int e = 0; e < edges; ++e) {
    const OpenMesh::EdgeHandle edge(e);
    if (guarded.mesh().status(edge).deleted() || guarded.length_m(edge) <= kLongest * edge_m) continue;
    const auto h = guarded.mesh().halfedge_handle(edge, 0);
    const Vec3 middle_m = 0.5 * (guarded.position_m(guarded.mesh().from_vertex_handle(h)) +
                                 guarded.position_m(guarded.mesh().to_vertex_handle(h)));
    guarded.try_split(edge, middle_m, 0.0);
  }
}

void move_along_surface(GuardedMesh& guarded) {
  const HalfEdgeMesh& mesh = guarded.mesh();
  for (int index = 0; index < static_cast<int>(mesh.n_vertices()); ++index) {
    const OpenMesh::VertexHandle v(index);
    if (mesh.status(v).deleted()) continue;
    Vec3 middle_m = Vec3::Zero();
    int count = 0;
    for (auto n = mesh.cvv_iter(v); n.is_valid(); ++n, ++count) middle_m += guarded.position_m(*n);
    if (count == 0) continue;
    const Vec3 here_m = guarded.position_m(v);
    const Vec3 aim_m = here_m + kRelaxation * (middle_m / count - here_m);
    const auto place = guarded.reference_tree().nearest(aim_m, guarded.reference_positions_m());
    guarded.try_move(v, place.point.position_m, 1.0);
  }
}

}  // namespace

void even_out(GuardedMesh& guarded, double edge_m, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    split_long_edges(guarded, edge_m);
    flip_where_better(guarded);
    move_along_surface(guarded);
  }
}

}  // namespace myotact::prepare

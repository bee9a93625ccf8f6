#pragma once

#include <array>
#include <optional>
#include <vector>

#include "geometry/triangle_mesh.h"
#include "geometry/triangle_tree.h"
#include "prepare/remesh/face_grid.h"
#include "prepare/remesh/half_edge_mesh.h"

namespace myotact::prepare {

/// A closed triangle mesh that is changed step by step and stays what it was: closed, of one genus, free of crossings,
/// and near the surface it began as. Every change is looked at before it is made; one that would let triangles meet,
/// fold back on a neighbour or stray beyond the tolerance, in either direction, is refused. Both surfaces are compared
/// at samples: the reference's vertices, middles of edges and centres of triangles against the mesh, those of the
/// mesh's new triangles against the reference.
class GuardedMesh {
 public:
  using Vertex = OpenMesh::VertexHandle;
  using Edge = OpenMesh::EdgeHandle;
  using HalfEdge = OpenMesh::HalfedgeHandle;

  /// The mesh begins as `start` (closed, manifold, no crossings), which must lie within the tolerance of `reference`.
  /// `edge_m` is the length that edges will have in the end, roughly: it sizes the search grid.
  GuardedMesh(const geometry::TriangleMesh& start, const geometry::TriangleMesh& reference, double tolerance_m,
              double edge_m);

  const HalfEdgeMesh& mesh() const { return mesh_; }
  Vec3 position_m(Vertex v) const { return to_vec3(mesh_.point(v)); }
  double length_m(Edge e) const { return mesh_.calc_edge_length(e); }
  std::array<int, 3> vertices_of(int face) const;
  Corners corners_of(const std::array<int, 3>& vertices) const;
  const geometry::TriangleTree& reference_tree() const { return tree_; }
  const std::vector<Vec3>& reference_positions_m() const { return reference_.positions_m; }

  /// Each makes the change and returns true, or leaves all as it was. The worst shape (see shape_of) among the
  /// triangles made is at least `least_shape`, or at least that of the triangles they replace.
  bool try_collapse(HalfEdge from_to, const Vec3& place_m, double least_shape);
  bool try_flip(Edge e, double least_shape);
  bool try_split(Edge e, const Vec3& place_m, double least_shape);
  bool try_move(Vertex v, const Vec3& place_m, double least_shape);

  geometry::TriangleMesh take();

 private:
  struct NewFace {
    std::array<int, 3> vertices;
    Corners corners;
  };
  using Faces = std::vector<int>;
  using Samples = std::vector<std::pair<int, int>>;  // sample, and the new face nearest to it

  Faces faces_around(Vertex v) const;
  /// What becomes of the samples when `made` take the place of `old`; nothing when that must not be.
  std::optional<Samples> accept(const Faces& old, const std::vector<NewFace>& made, double least_shape) const;
  /// Nothing when a sample of `old` would stray.
  std::optional<Samples> reassign(const Faces& old, const std::vector<NewFace>& made) const;
  bool fits(const Faces& old, const std::vector<NewFace>& made, double least_shape) const;
  bool shapes_hold(const Faces& old, const std::vector<NewFace>& made, double least_shape) const;
  bool stays_near(const NewFace& face) const;
  bool is_free(const NewFace& face, const Faces& old) const;
  void forget(const Faces& old);
  /// Puts the changed faces, now in the mesh, into the grid and hands them their samples.
  void learn(const Faces& made, const Samples& samples);

  geometry::TriangleMesh reference_;
  geometry::TriangleTree tree_;
  double tolerance_m_;
  HalfEdgeMesh mesh_;
  FaceGrid grid_;
  std::vector<Vec3> sample_places_m_;      // on the reference
  std::vector<std::vector<int>> samples_;  // by face: those nearest to it
};

/// 1 for an equilateral triangle, 0 for one without area: 4 sqrt(3) area over the sum of the squared sides.
double shape_of(const Corners& corners);

}  // namespace myotact::prepare

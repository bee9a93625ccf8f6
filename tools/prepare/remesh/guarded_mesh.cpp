#include "prepare/remesh/guarded_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/closest_point.h"
#include "prepare/remesh/surface_distance.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

/// Neighbours whose normals differ by more than 165 degrees lie on each other.
constexpr double kFolded = -0.966;
/// Search cells are this long against the edges that come out.
constexpr double kCellsPerEdge = 0.7;

/// References of fewer triangles are sampled within them, too; the vertices of others lie close enough.
constexpr std::size_t kFewTriangles = 6000;

std::vector<Vec3> sample(const TriangleMesh& mesh) {
  std::vector<Vec3> places_m = mesh.positions_m;
  if (mesh.triangles.size() > kFewTriangles) return places_m;
  const std::vector<Vec3> within_m = places_within_triangles_m(mesh);
  places_m.insert(places_m.end(), within_m.begin(), within_m.end());
  return places_m;
}

Vec3 normal_of(const Corners& c) {
  return (c[1] - c[0]).cross(c[2] - c[0]).normalized();
}

Eigen::AlignedBox3d box_of(const Corners& c) {
  Eigen::AlignedBox3d box(c[0]);
  box.extend(c[1]);
  box.extend(c[2]);
  return box;
}

/// Whether two triangles meet elsewhere than at their common corners.
bool cross(const std::array<int, 3>& ids_a, const Corners& a, const std::array<int, 3>& ids_b, const Corners& b) {
  int shared = 0;
  std::size_t corner_a = 0, corner_b = 0;  // the last common one
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (ids_a[i] != ids_b[j]) continue;
      ++shared;
      corner_a = i, corner_b = j;
    }
  }
  if (shared == 0) return triangles_meet(a, b);
  if (shared == 1) {
    return segment_meets(a[(corner_a + 1) % 3], a[(corner_a + 2) % 3], b) ||
           segment_meets(b[(corner_b + 1) % 3], b[(corner_b + 2) % 3], a);
  }
  return normal_of(a).dot(normal_of(b)) < kFolded;
}

}  // namespace

double shape_of(const Corners& c) {
  const double sides_m2 = (c[1] - c[0]).squaredNorm() + (c[2] - c[1]).squaredNorm() + (c[0] - c[2]).squaredNorm();
  return sides_m2 > 0.0 ? 2.0 * std::sqrt(3.0) * (c[1] - c[0]).cross(c[2] - c[0]).norm() / sides_m2 : 0.0;
}

GuardedMesh::GuardedMesh(const TriangleMesh& start, const TriangleMesh& reference, double tolerance_m, double edge_m)
    : reference_(reference), tree_(reference_), tolerance_m_(tolerance_m), grid_(kCellsPerEdge * edge_m) {
  for (const Vec3& p : start.positions_m) mesh_.add_vertex(to_openmesh(p));
  for (const auto& [a, b, c] : start.triangles) mesh_.add_face(Vertex(a), Vertex(b), Vertex(c));
  samples_.resize(mesh_.n_faces());
  for (const auto f : mesh_.faces()) grid_.insert(f.idx(), corners_of(vertices_of(f.idx())));
  const geometry::TriangleTree start_tree(start);
  sample_places_m_ = sample(reference_);
  for (std::size_t i = 0; i < sample_places_m_.size(); ++i) {
    const int face = start_tree.nearest(sample_places_m_[i], start.positions_m).triangle;
    samples_[static_cast<std::size_t>(face)].push_back(static_cast<int>(i));
  }
}

bool GuardedMesh::try_collapse(HalfEdge from_to, const Vec3& place_m, double least_shape) {
  if (!mesh_.is_collapse_ok(from_to)) return false;
  const Vertex gone = mesh_.from_vertex_handle(from_to), kept = mesh_.to_vertex_handle(from_to);
  Faces old = faces_around(gone);
  for (const int face : faces_around(kept)) {
    if (std::find(old.begin(), old.end(), face) == old.end()) old.push_back(face);
  }
  std::vector<NewFace> made;
  for (const int face : old) {
    NewFace next{vertices_of(face), {}};
    int ends = 0;
    for (int& v : next.vertices) {
      if (v != gone.idx() && v != kept.idx()) continue;
      ++ends;
      v = kept.idx();
    }
    if (ends == 2) continue;
    next.corners = corners_of(next.vertices);
    for (std::size_t k = 0; k < 3; ++k) {
      if (next.vertices[k] == kept.idx()) next.corners[k] = place_m;
    }
    made.push_back(next);
  }
  if (made.size() < 3) return false;
  const auto samples = accept(old, made, least_shape);
  if (!samples) return false;
  forget(old);
  mesh_.collapse(from_to);
  mesh_.set_point(kept, to_openmesh(place_m));
  Faces now;
  for (const int face : old) {
    if (!mesh_.status(OpenMesh::FaceHandle(face)).deleted()) now.push_back(face);
  }
  learn(now, *samples);
  return true;
}

bool GuardedMesh::try_flip(Edge e, double least_shape) {
  if (!mesh_.is_flip_ok(e)) return false;
  const HalfEdge h0 = mesh_.halfedge_handle(e, 0), h1 = mesh_.halfedge_handle(e, 1);
  const int a = mesh_.from_vertex_handle(h0).idx(), b = mesh_.to_vertex_handle(h0).idx();
  const int left = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h0)).idx();
  const int right = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h1)).idx();
  const Faces old{mesh_.face_handle(h0).idx(), mesh_.face_handle(h1).idx()};
  std::vector<NewFace> made;
  for (const std::array<int, 3>& vertices : {std::array<int, 3>{a, right, left}, std::array<int, 3>{b, left, right}}) {
    made.push_back({vertices, corners_of(vertices)});
  }
  const auto samples = accept(old, made, least_shape);
  if (!samples) return false;
  forget(old);
  mesh_.flip(e);
  // The samples go by position in `made`: let the order of the faces follow it.
  Faces now = old;
  const auto has = [&](int face, int vertex) {
    const auto vertices = vertices_of(face);
    return std::find(vertices.begin(), vertices.end(), vertex) != vertices.end();
  };
  if (!has(now[0], a)) std::swap(now[0], now[1]);
  learn(now, *samples);
  return true;
}

bool GuardedMesh::try_split(Edge e, const Vec3& place_m, double least_shape) {
  const HalfEdge h0 = mesh_.halfedge_handle(e, 0), h1 = mesh_.halfedge_handle(e, 1);
  const int a = mesh_.from_vertex_handle(h0).idx(), b = mesh_.to_vertex_handle(h0).idx();
  const int left = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h0)).idx();
  const int right = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h1)).idx();
  const Faces old{mesh_.face_handle(h0).idx(), mesh_.face_handle(h1).idx()};
  const int added = static_cast<int>(mesh_.n_vertices());
  std::vector<NewFace> made;
  for (const std::array<int, 3>& vertices :
       {std::array<int, 3>{a, added, left}, std::array<int, 3>{added, b, left}, std::array<int, 3>{b, added, right},
        std::array<int, 3>{added, a, right}}) {
    NewFace face{vertices, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      face.corners[k] = vertices[k] == added ? place_m : position_m(Vertex(vertices[k]));
    }
    made.push_back(face);
  }
  const auto samples = accept(old, made, least_shape);
  if (!samples) return false;
  forget(old);
  const Vertex v = mesh_.add_vertex(to_openmesh(place_m));
  mesh_.split_edge(e, v);
  samples_.resize(mesh_.n_faces());
  Faces now;
  for (const NewFace& face : made) {
    for (const int around : faces_around(v)) {
      const auto vertices = vertices_of(around);
      const bool same = std::all_of(face.vertices.begin(), face.vertices.end(), [&](int id) {
        return std::find(vertices.begin(), vertices.end(), id) != vertices.end();
      });
      if (same) now.push_back(around);
    }
  }
  learn(now, *samples);
  return true;
}

bool GuardedMesh::try_move(Vertex v, const Vec3& place_m, double least_shape) {
  const Faces old = faces_around(v);
  std::vector<NewFace> made;
  for (const int face : old) {
    NewFace next{vertices_of(face), {}};
    next.corners = corners_of(next.vertices);
    for (std::size_t k = 0; k < 3; ++k) {
      if (next.vertices[k] == v.idx()) next.corners[k] = place_m;
    }
    made.push_back(next);
  }
  const auto samples = accept(old, made, least_shape);
  if (!samples) return false;
  forget(old);
  mesh_.set_point(v, to_openmesh(place_m));
  learn(old, *samples);
  return true;
}

TriangleMesh GuardedMesh::take() {
  mesh_.garbage_collection();
  TriangleMesh result;
  for (const auto v : mesh_.vertices()) result.positions_m.push_back(position_m(v));
  for (const auto f : mesh_.faces()) result.triangles.push_back(vertices_of(f.idx()));
  return result;
}

Corners GuardedMesh::corners_of(const std::array<int, 3>& vertices) const {
  return {position_m(Vertex(vertices[0])), position_m(Vertex(vertices[1])), position_m(Vertex(vertices[2]))};
}

std::array<int, 3> GuardedMesh::vertices_of(int face) const {
  std::array<int, 3> vertices{};
  std::size_t k = 0;
  for (auto v = mesh_.cfv_iter(OpenMesh::FaceHandle(face)); v.is_valid() && k < 3; ++v) vertices[k++] = v->idx();
  return vertices;
}

GuardedMesh::Faces GuardedMesh::faces_around(Vertex v) const {
  Faces faces;
  for (auto f = mesh_.cvf_iter(v); f.is_valid(); ++f) faces.push_back(f->idx());
  return faces;
}

std::optional<GuardedMesh::Samples> GuardedMesh::reassign(const Faces& old, const std::vector<NewFace>& made) const {
  Samples assigned;
  for (const int face : old) {
    for (const int sample : samples_[static_cast<std::size_t>(face)]) {
      const Vec3& p = sample_places_m_[static_cast<std::size_t>(sample)];
      double best_m = std::numeric_limits<double>::infinity();
      int nearest = -1;
      for (std::size_t i = 0; i < made.size(); ++i) {
        const Corners& c = made[i].corners;
        const double away_m = (geometry::closest_point_on_triangle(p, c[0], c[1], c[2]).position_m - p).norm();
        if (away_m < best_m) best_m = away_m, nearest = static_cast<int>(i);
      }
      if (best_m > tolerance_m_) return std::nullopt;
      assigned.emplace_back(sample, nearest);
    }
  }
  return assigned;
}

bool GuardedMesh::shapes_hold(const Faces& old, const std::vector<NewFace>& made, double least_shape) const {
  double worst_made = 1.0;
  for (const NewFace& face : made) worst_made = std::min(worst_made, shape_of(face.corners));
  if (worst_made >= least_shape) return true;
  double worst_old = 1.0;
  for (const int face : old) worst_old = std::min(worst_old, shape_of(corners_of(vertices_of(face))));
  return worst_made > worst_old;
}

bool GuardedMesh::stays_near(const NewFace& face) const {
  const auto near = [&](const Vec3& p) {
    bool found = false;
    tree_.visit_within(p, tolerance_m_, [&](int t) {
      const auto& [a, b, c] = tree_.triangle(t);
      const auto at = [&](int v) -> const Vec3& { return reference_.positions_m[static_cast<std::size_t>(v)]; };
      found =
          found || (geometry::closest_point_on_triangle(p, at(a), at(b), at(c)).position_m - p).norm() <= tolerance_m_;
      return found ? 0.0 : tolerance_m_;  // nothing else can be nearer than 0
    });
    return found;
  };
  const Corners& c = face.corners;
  if (!near((c[0] + c[1] + c[2]) / 3.0)) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const int here = face.vertices[k], next = face.vertices[(k + 1) % 3];
    if (here < next && !near(0.5 * (c[k] + c[(k + 1) % 3]))) return false;  // the other triangle there leaves it out
    const bool is_new = here >= static_cast<int>(mesh_.n_vertices()) || position_m(Vertex(here)) != c[k];
    if (is_new && !near(c[k])) return false;
  }
  return true;
}

bool GuardedMesh::is_free(const NewFace& face, const Faces& old) const {
  return !grid_.any(box_of(face.corners), [&](int other, const Corners& corners) {
    return std::find(old.begin(), old.end(), other) == old.end() &&
           cross(face.vertices, face.corners, vertices_of(other), corners);
  });
}

bool GuardedMesh::fits(const Faces& old, const std::vector<NewFace>& made, double least_shape) const {
  if (!shapes_hold(old, made, least_shape)) return false;
  for (std::size_t i = 0; i < made.size(); ++i) {
    for (std::size_t j = i + 1; j < made.size(); ++j) {
      if (cross(made[i].vertices, made[i].corners, made[j].vertices, made[j].corners)) return false;
    }
  }
  return std::all_of(made.begin(), made.end(), [&](const NewFace& face) { return stays_near(face); }) &&
         std::all_of(made.begin(), made.end(), [&](const NewFace& face) { return is_free(face, old); });
}

std::optional<GuardedMesh::Samples> GuardedMesh::accept(const Faces& old, const std::vector<NewFace>& made,
                                                        double least_shape) const {
  return fits(old, made, least_shape) ? reassign(old, made) : std::nullopt;
}

void GuardedMesh::forget(const Faces& old) {
  for (const int face : old) {
    grid_.remove(face);
    samples_[static_cast<std::size_t>(face)].clear();
  }
}

void GuardedMesh::learn(const Faces& made, const Samples& samples) {
  for (const int face : made) grid_.insert(face, corners_of(vertices_of(face)));
  for (const auto& [sample, place] : samples) {
    samples_[static_cast<std::size_t>(made[static_cast<std::size_t>(place)])].push_back(sample);
  }
}

}  // namespace myotact::prepare

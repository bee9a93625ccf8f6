#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "prepare/repair/soup.h"
#include "prepare/surface/edge_table.h"
#include "prepare/surface/edge_wheel.h"

//  Each triangle t has a front (2t, where its normal points) and a back (2t + 1). Around an edge, what lies between one
//  triangle and the next is one room, so the two faces that look into it are joined:
//
//               A                     rooms: A|B outside, B|W and W|A inside. Groups of faces that are joined are the
//              /                      cells of space. The skin is what has the outer cell on one side only: A and B.
//      outside/  inside               W has an inner cell on both sides: a wall. A fin has the outer one on both.
//            *----------- W           An open edge joins nothing, as if a membrane closed its hole.
//      outside\  inside
//              \ B

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

int front_of(int triangle) {
  return 2 * triangle;
}
int back_of(int triangle) {
  return 2 * triangle + 1;
}

/// The face of a triangle that looks along rising angles around its edge, and the one that looks back.
int face_ahead(const SpokeTriangle& spoke) {
  return spoke.forward ? front_of(spoke.side / 3) : back_of(spoke.side / 3);
}
int face_behind(const SpokeTriangle& spoke) {
  return spoke.forward ? back_of(spoke.side / 3) : front_of(spoke.side / 3);
}

struct Cells {
  Groups faces;       // 2 m
  Groups components;  // m: triangles joined by edges
};

Cells find_cells(const TriangleMesh& mesh) {
  Cells cells{Groups(2 * mesh.triangles.size()), Groups(mesh.triangles.size())};
  EdgeTable(mesh).for_each_edge([&](int low, int high, std::span<const EdgeUse> uses) {
    if (uses.size() < 2) return;
    const std::vector<SpokeTriangle> wheel = wheel_around(mesh, low, high, uses);
    for (std::size_t i = 0; i < wheel.size(); ++i) {
      const SpokeTriangle& next = wheel[(i + 1) % wheel.size()];
      cells.faces.join(face_ahead(wheel[i]), face_behind(next));
      cells.components.join(wheel[i].side / 3, next.side / 3);
    }
  });
  return cells;
}

/// The triangles of each component.
std::map<int, std::vector<int>> members_of(Groups& components, std::size_t triangles) {
  std::map<int, std::vector<int>> members;
  for (int t = 0; t < static_cast<int>(triangles); ++t) members[components.group_of(t)].push_back(t);
  return members;
}

/// A face of the component that is seen from far along +x: at the vertex farthest there, along the edge that falls off
/// least, the triangle that looks most along x (Attene 2010, outer hull).
int outermost_face(const TriangleMesh& mesh, const std::vector<int>& triangles) {
  int farthest = mesh.triangles[at(triangles.front())][0];
  for (const int t : triangles) {
    for (const int v : mesh.triangles[at(t)]) {
      if (mesh.positions_m[at(v)].x() > mesh.positions_m[at(farthest)].x()) farthest = v;
    }
  }
  const auto has = [&](int t, int v) {
    const auto& corners = mesh.triangles[at(t)];
    return std::find(corners.begin(), corners.end(), v) != corners.end();
  };
  int other = -1;
  double least_fall = -2.0;
  for (const int t : triangles) {
    if (!has(t, farthest)) continue;
    for (const int v : mesh.triangles[at(t)]) {
      if (v == farthest) continue;
      const double fall = (mesh.positions_m[at(v)] - mesh.positions_m[at(farthest)]).normalized().x();
      if (fall > least_fall) other = v, least_fall = fall;
    }
  }
  int best = -1;
  double best_x = 0.0;
  for (const int t : triangles) {
    if (!has(t, farthest) || !has(t, other)) continue;
    const double x = area_vector(mesh, t).normalized().x();
    if (best < 0 || std::abs(x) > std::abs(best_x)) best = t, best_x = x;
  }
  return best_x >= 0.0 ? front_of(best) : back_of(best);
}

}  // namespace

void drop_fins_and_walls(RepairJob& job) {
  if (count_edges(job.mesh).crowded == 0) return;
  Cells cells = find_cells(job.mesh);
  std::vector<bool> keep(job.mesh.triangles.size(), true);
  int fins = 0, walls = 0;
  double fin_area = 0.0;
  Vec3 fin = Vec3::Zero(), wall = Vec3::Zero();
  for (const auto& [first, triangles] : members_of(cells.components, job.mesh.triangles.size())) {
    const int outside = cells.faces.group_of(outermost_face(job.mesh, triangles));
    for (const int t : triangles) {
      const bool front = cells.faces.group_of(front_of(t)) == outside;
      const bool back = cells.faces.group_of(back_of(t)) == outside;
      keep[at(t)] = front != back;
      if (front && back && fins++ == 0) fin = centroid(job.mesh, t);
      if (front && back) fin_area += 0.5 * area_vector(job.mesh, t).norm();
      if (!front && !back && walls++ == 0) wall = centroid(job.mesh, t);
      if (back && !front) std::swap(job.mesh.triangles[at(t)][1], job.mesh.triangles[at(t)][2]);
    }
  }
  if (fins + walls == 0) return;
  if (fin_area > job.settings.all_fins * geometry::surface_area_m2(job.mesh)) {
    throw refusal(
        job,
        fmt::format("has {} triangles that hang on edges of more than two and part no inside from the "
                    "outside, the first near {{}}; they have {:.1f} % of its area, and at most {:.1f} % is "
                    "dropped. Join or remove them and export it again",
                    fins, 100.0 * fin_area / geometry::surface_area_m2(job.mesh), 100.0 * job.settings.all_fins),
        fin);
  }
  keep_triangles(job, keep, Dropped::LeftOut);
  note(job, "triangles of fins dropped", fins, fin);
  note(job, "triangles of inner walls dropped", walls, wall);
}

}  // namespace myotact::prepare

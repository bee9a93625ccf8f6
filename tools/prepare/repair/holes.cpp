#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "prepare/remesh/crossing_triangles.h"
#include "prepare/repair/soup.h"
#include "prepare/repair/stages.h"
#include "prepare/repair/surface_surgery.h"
#include "prepare/surface/edge_table.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;
using Loop = std::vector<int>;  // vertices, in the direction in which a patch is wound

/// Patches of more than this part of the surface are no repair: it is a sheet.
constexpr double kSheet = 0.35;
/// More crossings than this are not counted when two patches are compared.
constexpr unsigned kCompared = 1000;

/// Open edges in the direction of the missing neighbour.
std::vector<std::vector<int>> open_steps(const TriangleMesh& mesh) {
  std::vector<std::vector<int>> steps(mesh.positions_m.size());
  const std::vector<int> opposite = opposite_sides(mesh);
  for (int side = 0; side < static_cast<int>(opposite.size()); ++side) {
    if (opposite[at(side)] == kOpen) steps[at(head_of(mesh, side))].push_back(tail_of(mesh, side));
  }
  return steps;
}

/// Walks along open edges; a vertex met again cuts off a loop, so that none touches itself.
class LoopWalk {
 public:
  explicit LoopWalk(const TriangleMesh& mesh) : steps_(open_steps(mesh)), place_(steps_.size(), -1) {}

  std::vector<Loop> all() {
    for (int start = 0; start < static_cast<int>(steps_.size()); ++start) {
      while (!steps_[at(start)].empty()) walk_from(start);
    }
    return std::move(loops_);
  }

 private:
  void walk_from(int start) {
    reach(start);
    while (!way_.empty() && !steps_[at(way_.back())].empty()) {
      std::vector<int>& steps = steps_[at(way_.back())];
      const int next = steps.back();
      steps.pop_back();
      if (place_[at(next)] >= 0) cut_off(next);
      if (!way_.empty() || !steps_[at(next)].empty()) reach(next);
    }
    for (const int v : way_) place_[at(v)] = -1;
    way_.clear();
  }

  void reach(int v) {
    place_[at(v)] = static_cast<int>(way_.size());
    way_.push_back(v);
  }

  void cut_off(int first) {
    const auto begin = way_.begin() + place_[at(first)];
    loops_.emplace_back(begin, way_.end());
    for (const int v : loops_.back()) place_[at(v)] = -1;
    way_.erase(begin, way_.end());
  }

  std::vector<std::vector<int>> steps_;
  std::vector<int> place_;  // of each vertex on the way, or -1
  Loop way_;
  std::vector<Loop> loops_;
};

Vec3 middle_of(const TriangleMesh& mesh, const Loop& loop) {
  Vec3 middle = Vec3::Zero();
  for (const int v : loop) middle += mesh.positions_m[at(v)] / static_cast<double>(loop.size());
  return middle;
}

/// Area of the loop's shadow where that is largest: no patch over it has less.
double least_area(const TriangleMesh& mesh, const Loop& loop) {
  const Vec3 middle = middle_of(mesh, loop);
  Vec3 twice = Vec3::Zero();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3& next = mesh.positions_m[at(loop[(i + 1) % loop.size()])];
    twice += (mesh.positions_m[at(loop[i])] - middle).cross(next - middle);
  }
  return 0.5 * twice.norm();
}

std::vector<std::array<int, 3>> patch_over(const TriangleMesh& mesh, const Loop& loop) {
  if (loop.size() == 3) return {{loop[0], loop[1], loop[2]}};
  std::vector<Vec3> points;
  for (const int v : loop) points.push_back(mesh.positions_m[at(v)]);
  std::vector<std::array<int, 3>> patch = span_loop(points);
  for (auto& triangle : patch) {
    std::sort(triangle.begin(), triangle.end());  // rising along the loop: wound like it
    for (int& v : triangle) v = loop[at(v)];
  }
  return patch;
}

double area_of(const TriangleMesh& mesh, const std::vector<std::array<int, 3>>& triangles) {
  return geometry::surface_area_m2({mesh.positions_m, triangles});
}

/// A patch from a new vertex in the middle of the loop.
void add_fan(RepairJob& job, const Loop& loop) {
  const int middle = static_cast<int>(job.mesh.positions_m.size());
  job.mesh.positions_m.push_back(middle_of(job.mesh, loop));
  job.vertex_source.push_back(-1);
  for (std::size_t i = 0; i < loop.size(); ++i)
    add_triangle(job, {loop[i], loop[(i + 1) % loop.size()], middle}, kFill);
}

/// Area of the patch, part of the surface's.
double span_hole(RepairJob& job, const Loop& loop) {
  const std::size_t before = job.mesh.triangles.size();
  const std::vector<std::array<int, 3>> patch = patch_over(job.mesh, loop);
  for (const auto& triangle : patch) add_triangle(job, triangle, kFill);
  if (patch.empty()) add_fan(job, loop);
  return area_of(job.mesh,
                 {job.mesh.triangles.begin() + static_cast<std::ptrdiff_t>(before), job.mesh.triangles.end()});
}

/// Where a patch runs along an edge that has two triangles already, its loop gets a fan instead.
void redo_crowded_patches(RepairJob& job, const TriangleMesh& open, const std::vector<Loop>& loops) {
  if (count_edges(job.mesh).crowded == 0) return;
  job.mesh = open;
  job.vertex_source.resize(open.positions_m.size());
  job.face_source.resize(open.triangles.size());
  for (const Loop& loop : loops) add_fan(job, loop);
}

void check_hole(const RepairJob& job, const Loop& loop, double part) {
  const Vec3 place = middle_of(job.mesh, loop);
  if (part > kSheet) {
    throw refusal(
        job,
        fmt::format("is open and encloses nothing: closing the edge of {} sides round {{}} would take {:.1f} % "
                    "of its area; at most {:.1f} %. Export a closed surface",
                    loop.size(), 100.0 * part, 100.0 * job.settings.largest_hole),
        place);
  }
  if (part > job.settings.largest_hole) {
    throw refusal(job,
                  fmt::format("is open: a hole with {} edges near {{}} takes {:.1f} % of its area; at most {:.1f} % is "
                              "closed. Close the hole and export it again",
                              loop.size(), 100.0 * part, 100.0 * job.settings.largest_hole),
                  place);
  }
}

/// Gives patches the density and the slope of the surface around them, unless that makes them cross something.
void blend_patches(RepairJob& job) {
  std::vector<bool> marked;
  for (const int source : job.face_source) marked.push_back(source == kFill);
  const std::optional<TriangleMesh> blended = blend_triangles(job.mesh, marked);
  if (!blended || !is_closed(*blended)) return;
  const std::size_t crossings = crossing_triangles(*blended, kCompared).size();
  if (crossings > 0 && crossings > crossing_triangles(job.mesh, kCompared).size()) return;
  adopt(job, *blended, kFill);
  job.crossing_free = crossings == 0;
}

}  // namespace

void close_holes(RepairJob& job) {
  const TriangleMesh open = job.mesh;
  const double area = geometry::surface_area_m2(open);
  const std::vector<Loop> loops = LoopWalk(open).all();
  if (loops.empty()) return;
  double all = 0.0;
  for (const Loop& loop : loops) check_hole(job, loop, least_area(open, loop) / area);
  for (const Loop& loop : loops) {
    const double part = span_hole(job, loop) / area;
    check_hole(job, loop, part);
    all += part;
    note(job, "holes closed", 1, middle_of(open, loop));
  }
  if (all > job.settings.all_holes) {
    throw refusal(job,
                  fmt::format("is open: its {} holes, the first near {{}}, take {:.1f} % of its area; at most {:.1f} % "
                              "is closed. Close the holes and export it again",
                              loops.size(), 100.0 * all, 100.0 * job.settings.all_holes),
                  middle_of(open, loops.front()));
  }
  redo_crowded_patches(job, open, loops);
  split_shared_vertices(job);
  if (!is_closed(job.mesh)) {
    throw refusal(job,
                  fmt::format("is open: its {} holes, the first near {{}}, could not be closed without edges of more "
                              "than two triangles. Close the holes and export it again",
                              loops.size()),
                  middle_of(open, loops.front()));
  }
  blend_patches(job);
}

}  // namespace myotact::prepare

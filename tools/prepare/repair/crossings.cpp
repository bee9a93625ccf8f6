#include <algorithm>
#include <array>
#include <cstring>
#include <set>
#include <string>

#include <fmt/format.h>

#include "geometry/triangle_tree.h"
#include "prepare/child_process.h"
#include "prepare/field/signed_distance.h"
#include "prepare/remesh/crossing_triangles.h"
#include "prepare/repair/stages.h"
#include "prepare/repair/surface_surgery.h"
#include "prepare/surface/edge_table.h"
#include "prepare/surface/surface_pieces.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;
using Pairs = std::vector<std::pair<int, int>>;

/// More pairs than this are not searched: nothing local helps then.
constexpr unsigned kMostPairs = 20000;
/// Local repair refills what it takes out, at a cost that grows with the cube: only where crossings are few.
constexpr std::size_t kMostTriangles = 300;
constexpr double kMostOfSurface = 0.25;
/// It takes well under a second where it comes to an end, thirty times that under a sanitizer on a slow machine.
constexpr int kUntangleLimit_cpu_s = 15;
/// Rounds of smoothing; each takes a ring of triangles more.
constexpr int kRounds = 5;
constexpr int kPasses = 4;

std::set<int> triangles_in(const Pairs& pairs) {
  std::set<int> triangles;
  for (const auto& [a, b] : pairs) triangles.insert({a, b});
  return triangles;
}

/// Vertices of the crossing triangles and `rings` rings around them.
std::vector<bool> vertices_near(const TriangleMesh& mesh, const std::set<int>& triangles, int rings) {
  std::vector<bool> near(mesh.positions_m.size(), false);
  for (const int t : triangles) {
    for (const int v : mesh.triangles[at(t)]) near[at(v)] = true;
  }
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<bool> wider = near;
    for (const auto& [a, b, c] : mesh.triangles) {
      if (near[at(a)] || near[at(b)] || near[at(c)]) wider[at(a)] = wider[at(b)] = wider[at(c)] = true;
    }
    near = std::move(wider);
  }
  return near;
}

/// Moves the marked vertices to the middle of their neighbours.
void smooth(TriangleMesh& mesh, const std::vector<bool>& marked) {
  std::vector<Vec3> sum(mesh.positions_m.size(), Vec3::Zero());
  std::vector<int> count(mesh.positions_m.size(), 0);
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      sum[at(triangle[k])] += mesh.positions_m[at(triangle[(k + 1) % 3])];
      ++count[at(triangle[k])];
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v) {
    if (marked[v] && count[v] > 0) mesh.positions_m[v] = sum[v] / count[v];
  }
}

std::optional<TriangleMesh> smoothed(const TriangleMesh& mesh) {
  TriangleMesh result = mesh;
  for (int round = 0; round < kRounds; ++round) {
    const Pairs pairs = crossing_triangles(result, kMostPairs);
    if (pairs.empty()) return result;
    const std::vector<bool> near = vertices_near(result, triangles_in(pairs), round);
    for (int pass = 0; pass < kPasses; ++pass) smooth(result, near);
  }
  if (!crossing_triangles(result, 1).empty()) return std::nullopt;
  return result;
}

/// Whether each corner of `from` lies near `to`. The denser measure comes at the end of the repair.
bool corners_near(const TriangleMesh& from, const TriangleMesh& to, double reach) {
  const geometry::TriangleTree tree(to);
  return std::all_of(from.positions_m.begin(), from.positions_m.end(),
                     [&](const Vec3& p) { return tree.nearest(p, to.positions_m, reach).triangle >= 0; });
}

bool serves(const RepairJob& job, const TriangleMesh& piece, const std::optional<TriangleMesh>& result) {
  if (!result || !is_closed(*result)) return false;
  if (!crossing_triangles(*result, 1).empty()) return false;
  const double reach = job.settings.tolerance;
  return corners_near(piece, *result, reach) && corners_near(*result, piece, reach);
}

std::string to_bytes(const TriangleMesh& mesh) {
  const std::size_t vertices = mesh.positions_m.size();
  std::string bytes(reinterpret_cast<const char*>(&vertices), sizeof vertices);
  bytes.append(reinterpret_cast<const char*>(mesh.positions_m.data()), vertices * sizeof(Vec3));
  bytes.append(reinterpret_cast<const char*>(mesh.triangles.data()),
               mesh.triangles.size() * sizeof(std::array<int, 3>));
  return bytes;
}

TriangleMesh from_bytes(const std::string& bytes) {
  std::size_t vertices = 0;
  std::memcpy(&vertices, bytes.data(), sizeof vertices);
  TriangleMesh mesh;
  mesh.positions_m.resize(vertices);
  const std::size_t begin = sizeof vertices + vertices * sizeof(Vec3);
  mesh.triangles.resize((bytes.size() - begin) / sizeof(std::array<int, 3>));
  std::memcpy(mesh.positions_m.data()->data(), bytes.data() + sizeof vertices, vertices * sizeof(Vec3));
  std::memcpy(mesh.triangles.data(), bytes.data() + begin, bytes.size() - begin);
  return mesh;
}

/// untangle() with a limit on time: on some surfaces it goes round in circles.
std::optional<TriangleMesh> untangle_in_time(const TriangleMesh& piece) {
  const ChildResult result = run_in_child(
      [&] {
        const std::optional<TriangleMesh> mesh = untangle(piece);
        return mesh && !mesh->triangles.empty() ? to_bytes(*mesh) : std::string();
      },
      kUntangleLimit_cpu_s);
  if (result.end != ChildResult::End::Done || result.bytes.empty()) return std::nullopt;
  return from_bytes(result.bytes);
}

/// A resampled piece is to be as near to the old one as repairs may take it; folds that are now inside do not count.
bool serves_resampled(const RepairJob& job, const TriangleMesh& piece, const std::optional<TriangleMesh>& result) {
  if (!result || result->triangles.empty()) return false;
  const double reach = job.settings.tolerance;
  if (!corners_near(*result, piece, reach)) return false;
  const SignedDistance distance(*result);
  return std::all_of(piece.positions_m.begin(), piece.positions_m.end(),
                     [&](const Vec3& p) { return distance(p) < reach; });
}

/// The piece without crossings.
TriangleMesh taken_apart(RepairJob& job, const TriangleMesh& piece, const Pairs& pairs) {
  const std::set<int> crossing = triangles_in(pairs);
  const double part = static_cast<double>(crossing.size()) / static_cast<double>(piece.triangles.size());
  if (crossing.size() <= kMostTriangles && part <= kMostOfSurface) {
    if (const auto result = untangle_in_time(piece); serves(job, piece, result)) return *result;
  }
  if (const auto result = smoothed(piece); serves(job, piece, result)) return *result;
  const Vec3 place = centroid(piece, pairs.front().first);
  const std::optional<TriangleMesh> result = resample(piece, job.settings.tolerance);
  if (!serves_resampled(job, piece, result)) {
    throw refusal(job,
                  fmt::format("crosses itself: {} of {} triangles cross others near {{}} and could not be taken apart "
                              "there; must be 0. Repair the surface there and export it again",
                              crossing.size(), piece.triangles.size()),
                  place);
  }
  note(job, "surface made anew where the winding number is a half", 1, place);
  job.united = true;
  return *result;
}

}  // namespace

void remove_crossings(RepairJob& job) {
  if (job.crossing_free) return;
  TriangleMesh whole;
  bool changed = false;
  const std::vector<TriangleMesh> pieces = pieces_of(job.mesh);
  for (const TriangleMesh& piece : pieces) {
    const Pairs pairs = crossing_triangles(piece, kMostPairs);
    if (pairs.empty()) {
      append(whole, piece);
      continue;
    }
    append(whole, taken_apart(job, piece, pairs));
    note(job, "crossings of triangles taken apart", static_cast<int>(pairs.size()),
         centroid(piece, pairs.front().first));
    changed = true;
  }
  if (changed) adopt(job, whole, kPatch);
  job.crossing_free = pieces.size() == 1;
}

}  // namespace myotact::prepare

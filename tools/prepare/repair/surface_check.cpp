#include "prepare/repair/surface_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "prepare/remesh/half_edges.h"
#include "prepare/remesh/surface_remesh.h"
#include "prepare/repair/surface_pieces.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

/// Largest and smallest diagonal of a bone or muscle of a dog [m]. Outside, the file is not in metres.
constexpr double kSmallest_m = 5e-3;
constexpr double kLargest_m = 1.5;
/// A loose piece smaller than this part of the area is a speck of the scan.
constexpr double kSpeck = 0.01;

std::string place_text(const Vec3& p) {
  return fmt::format("({}, {}, {}) m", to_text(p.x()), to_text(p.y()), to_text(p.z()));
}

void check_coordinates(const std::string& name, const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw bad_data(name, "", "has no triangles; export the surface again");
  Eigen::AlignedBox3d box;
  for (std::size_t v = 0; v < mesh.positions_m.size(); ++v) {
    if (!mesh.positions_m[v].allFinite()) {
      throw bad_data(name, fmt::format("vertex {}", v), "is not finite; export the surface again");
    }
    box.extend(mesh.positions_m[v]);
  }
  const double diagonal_m = box.diagonal().norm();
  if (diagonal_m < kSmallest_m || diagonal_m > kLargest_m) {
    throw bad_data(name, "size",
                   fmt::format("diagonal is {} m; must be {} .. {} m. Export the surface in metres",
                               to_text(diagonal_m), to_text(kSmallest_m), to_text(kLargest_m)));
  }
}

TriangleMesh weld(const TriangleMesh& raw, SurfaceRepair& repair) {
  std::map<std::array<double, 3>, int> index;
  std::vector<int> target;
  TriangleMesh result;
  for (const Vec3& p : raw.positions_m) {
    const auto [found, added] = index.try_emplace(to_array(p), static_cast<int>(result.positions_m.size()));
    if (added) result.positions_m.push_back(p);
    target.push_back(found->second);
  }
  repair.welded_vertices = static_cast<int>(raw.positions_m.size() - result.positions_m.size());
  std::set<std::array<int, 3>> seen;
  for (const auto& t : raw.triangles) {
    std::array<int, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) corners[k] = target[static_cast<std::size_t>(t[k])];
    std::array<int, 3> sorted = corners;
    std::sort(sorted.begin(), sorted.end());
    const bool flat = sorted[0] == sorted[1] || sorted[1] == sorted[2];
    if (flat || !seen.insert(sorted).second) {
      ++repair.dropped_triangles;
      continue;
    }
    result.triangles.push_back(corners);
  }
  return result;
}

using EdgeMap = std::map<std::array<int, 2>, std::vector<int>>;  // sorted vertex pair -> triangles

EdgeMap edges_of(const TriangleMesh& mesh) {
  EdgeMap edges;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<int, 2> edge{mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]};
      std::sort(edge.begin(), edge.end());
      edges[edge].push_back(static_cast<int>(t));
    }
  }
  return edges;
}

void check_closed(const std::string& name, const TriangleMesh& mesh, const EdgeMap& edges) {
  int open = 0, crowded = 0;
  const std::array<int, 2>* first_open = nullptr;
  const std::array<int, 2>* first_crowded = nullptr;
  for (const auto& [edge, triangles] : edges) {
    if (triangles.size() == 1 && open++ == 0) first_open = &edge;
    if (triangles.size() > 2 && crowded++ == 0) first_crowded = &edge;
  }
  const auto middle = [&](const std::array<int, 2>& edge) {
    return Vec3(0.5 * (mesh.positions_m[static_cast<std::size_t>(edge[0])] +
                       mesh.positions_m[static_cast<std::size_t>(edge[1])]));
  };
  if (open > 0) {
    throw bad_data(
        name, "surface",
        fmt::format("is open: {} edges have a triangle on one side only, the first near {}; must be 0. Close "
                    "the holes and export it again",
                    open, place_text(middle(*first_open))));
  }
  if (crowded > 0) {
    throw bad_data(
        name, "surface",
        fmt::format("{} edges have more than two triangles, the first near {}; must be 0. Remove inner walls "
                    "and export it again",
                    crowded, place_text(middle(*first_crowded))));
  }
}

/// Whether two triangles run along a shared edge in opposite directions, as neighbours of one winding do.
bool same_winding(const std::array<int, 3>& a, const std::array<int, 3>& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (a[i] == b[(j + 1) % 3] && a[(i + 1) % 3] == b[j]) return true;
    }
  }
  return false;
}

/// Winds every piece of a closed surface one way, from triangle to neighbour.
class Winder {
 public:
  Winder(const std::string& name, const EdgeMap& edges, TriangleMesh& mesh)
      : name_(name), edges_(edges), mesh_(mesh), seen_(mesh.triangles.size(), false) {}

  /// Number of triangles turned.
  int wind_all() {
    for (std::size_t seed = 0; seed < seen_.size(); ++seed) {
      if (seen_[seed]) continue;
      seen_[seed] = true;
      std::vector<int> piece{static_cast<int>(seed)};
      for (std::size_t next = 0; next < piece.size(); ++next) wind_neighbours(piece[next], piece);
    }
    return turned_;
  }

 private:
  /// Neighbours met for the first time join the piece.
  void wind_neighbours(int triangle, std::vector<int>& piece) {
    const std::array<int, 3> here = mesh_.triangles[static_cast<std::size_t>(triangle)];
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<int, 2> edge{here[k], here[(k + 1) % 3]};
      std::sort(edge.begin(), edge.end());
      const std::vector<int>& both = edges_.at(edge);
      const auto other = static_cast<std::size_t>(both[0] == triangle ? both[1] : both[0]);
      if (!same_winding(here, mesh_.triangles[other])) turn(other);
      if (seen_[other]) continue;
      seen_[other] = true;
      piece.push_back(static_cast<int>(other));
    }
  }

  void turn(std::size_t triangle) {
    if (seen_[triangle]) {
      throw bad_data(name_, "surface", "has only one side (like a Moebius strip), so it encloses nothing");
    }
    std::swap(mesh_.triangles[triangle][1], mesh_.triangles[triangle][2]);
    ++turned_;
  }

  const std::string& name_;
  const EdgeMap& edges_;
  TriangleMesh& mesh_;
  std::vector<bool> seen_;
  int turned_ = 0;
};

}  // namespace

TriangleMesh clean_surface(const std::string& name, const TriangleMesh& raw, SurfaceRepair* repair_out) {
  SurfaceRepair repair;
  check_coordinates(name, raw);
  TriangleMesh mesh = weld(raw, repair);
  const EdgeMap edges = edges_of(mesh);
  check_closed(name, mesh, edges);
  repair.turned_triangles = Winder(name, edges, mesh).wind_all();

  const double area_m2 = geometry::surface_area_m2(mesh);
  TriangleMesh result;
  for (TriangleMesh& piece : pieces_of(mesh)) {
    if (geometry::surface_area_m2(piece) < kSpeck * area_m2) {
      ++repair.dropped_pieces;
      continue;
    }
    if (geometry::enclosed_volume_m3(piece) < 0.0) {
      for (auto& triangle : piece.triangles) std::swap(triangle[1], triangle[2]);
      repair.turned_triangles += static_cast<int>(piece.triangles.size());
    }
    append(result, piece);
  }
  check_half_edges(name, result);
  if (repair_out) *repair_out = repair;
  return result;
}

void refuse_crossings(const std::string& name, const TriangleMesh& mesh) {
  const auto crossings = crossing_triangles(mesh);
  if (crossings.empty()) return;
  const auto& t = mesh.triangles[static_cast<std::size_t>(crossings.front().first)];
  const Vec3 place =
      (mesh.positions_m[static_cast<std::size_t>(t[0])] + mesh.positions_m[static_cast<std::size_t>(t[1])] +
       mesh.positions_m[static_cast<std::size_t>(t[2])]) /
      3.0;
  throw bad_data(name, "surface",
                 fmt::format("{} pairs of triangles cross each other, the first near {}; must be 0. Repair the surface "
                             "there and export it again",
                             crossings.size(), place_text(place)));
}

}  // namespace myotact::prepare

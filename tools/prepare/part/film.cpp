#include "prepare/part/film.h"

#include <algorithm>
#include <cmath>

#include "prepare/field/block_lattice.h"
#include "prepare/part/hollow_out.h"
#include "prepare/part/node_pieces.h"
#include "prepare/surface/surface_pieces.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

/// Nodes around the muscle's box that are outside for certain, and room for film that runs over bone.
constexpr int kMargin = 6;
/// The film's middle keeps this far from what is impassable, in spacings.
constexpr double kOffBone = 0.5;
/// What a node in bone is dearer by than any outside it [m].
constexpr double kInBone_m = 1e3;
/// Vertices of a level set lie on edges of its lattice: a piece's node is within this many spacings of each.
constexpr double kNearEnd = 1.8;
/// Distances to the film are followed so far, in spacings: far enough for whole blocks to be passed over.
constexpr int kFollowed = 6;

/// The nodes of the largest piece and of those that come near a loose end.
std::vector<bool> nodes_to_keep(const BlockLattice& lattice, const std::vector<bool>& left,
                                const std::vector<Vec3>& loose_ends) {
  std::vector<bool> kept(left.size(), false);
  bool largest = true;
  for (const auto& piece : pieces_of_nodes(lattice.counts(), left)) {
    const bool stays = largest || std::any_of(piece.begin(), piece.end(), [&](std::size_t node) {
                         const Vec3 p = lattice.place_of(node);
                         return std::any_of(loose_ends.begin(), loose_ends.end(), [&](const Vec3& end) {
                           return (p - end).norm() < kNearEnd * lattice.spacing_m();
                         });
                       });
    largest = false;
    if (!stays) continue;
    for (const std::size_t node : piece) kept[node] = true;
  }
  return kept;
}

}  // namespace

int genus(const TriangleMesh& surface) {
  std::vector<bool> used(surface.positions_m.size(), false);
  for (const auto& corners : surface.triangles) {
    for (const int v : corners) used[static_cast<std::size_t>(v)] = true;
  }
  const auto vertices = std::count(used.begin(), used.end(), true);
  const auto triangles = static_cast<std::ptrdiff_t>(surface.triangles.size());
  const std::ptrdiff_t euler = vertices - 3 * triangles / 2 + triangles;
  return static_cast<int>(static_cast<std::ptrdiff_t>(pieces_of(surface).size()) - euler / 2);
}

Film::Film(const PiercedBody& body, double spacing_m) : lattice_(body.box, spacing_m, kMargin) {
  std::vector<bool> left(lattice_.size(), false);
  std::vector<float> cost(lattice_.size(), 0.0F);
  lattice_.sample(body.left, [&](std::size_t node, double value_m) { left[node] = value_m < 0.0; });
  lattice_.sample(body.distance, [&](std::size_t node, double value_m) { cost[node] = static_cast<float>(value_m); });
  const auto near_bone = [&](const Vec3& p) { return body.impassable(p) + kOffBone * spacing_m; };
  lattice_.sample(near_bone, [&](std::size_t node, double value_m) {
    if (value_m > 0.0) cost[node] += static_cast<float>(kInBone_m + value_m);
  });
  const std::vector<bool> kept = nodes_to_keep(lattice_, left, body.loose_ends);
  const std::vector<bool> closed = hollow_out(lattice_.counts(), kept, cost);
  for (std::size_t node = 0; node < closed.size(); ++node) {
    if (closed[node] && !kept[node]) nodes_.push_back(node);
  }
  measure_distances();
}

void Film::measure_distances() {
  distances_m_.assign(lattice_.size(), static_cast<float>(kFollowed * lattice_.spacing_m()));
  for (const std::size_t node : nodes_) {
    const Vec3 centre_m = lattice_.place_of(node);
    box_.extend(centre_m);
    lattice_.for_each_within(node, kFollowed, [&](std::size_t other) {
      const auto away_m = static_cast<float>((lattice_.place_of(other) - centre_m).norm());
      distances_m_[other] = std::min(distances_m_[other], away_m);
    });
  }
}

TriangleMesh Film::surface(double radius_m) const {
  const Vec3 around_m = Vec3::Constant(kFollowed * lattice_.spacing_m());
  return extract_level_set([&](const Vec3& p) { return distance_m(p) - radius_m; },
                           {box_.min() - around_m, box_.max() + around_m}, lattice_.spacing_m());
}

}  // namespace myotact::prepare

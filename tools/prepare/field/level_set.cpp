#include "prepare/field/level_set.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;
using Index3 = std::array<int, 3>;

/// Cells along the edge of the smallest block that the field is looked at as a whole.
constexpr int kBlockCells = 4;
/// Cut points keep this part of an edge away from its ends, so that no triangle is flat.
constexpr double kClearOfNodes = 0.02;
/// Steps of false position on an edge; more move the vertices by less than a hundredth of it.
constexpr int kRootSteps = 4;

constexpr double kTrianglesPerCell = 8.0;
constexpr double kMostOfThickness = 0.22;

/// Six tets that fill a cube, all around its diagonal from corner 0 to corner 7 (corner = x + 2 y + 4 z). Neighbouring
/// cubes agree on the diagonals of their common face.
constexpr std::array<std::array<int, 4>, 6> kKuhnTets = {
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

/// Node of the lattice as one number: 20 bits a direction, which leaves three for an edge's direction.
std::uint64_t key_of(const Index3& node) {
  return (static_cast<std::uint64_t>(node[0]) << 40) | (static_cast<std::uint64_t>(node[1]) << 20) |
         static_cast<std::uint64_t>(node[2]);
}

struct LatticeNode {
  Vec3 position_m;
  double value_m = 0.0;
};

class Extractor {
 public:
  Extractor(const BodyField& field, const Vec3& origin_m, double spacing_m)
      : field_(field), origin_m_(origin_m), spacing_m_(spacing_m) {}

  /// Cuts the block of `cells` cells a side: passed over where the field cannot vanish, else halved.
  void visit(const Index3& first, int cells) {
    const double half_m = 0.5 * cells * spacing_m_;
    const Vec3 centre_m = place_of(first) + Vec3::Constant(half_m);
    if (std::abs(field_(centre_m)) > std::sqrt(3.0) * half_m) return;
    if (cells == kBlockCells) {
      cut_block(first);
      return;
    }
    const int half = cells / 2;
    for (int corner = 0; corner < 8; ++corner) visit(corner_of(first, corner, half), half);
  }

  TriangleMesh take() { return std::move(mesh_); }

 private:
  static Index3 corner_of(const Index3& first, int corner, int step) {
    return {first[0] + ((corner & 1) != 0 ? step : 0), first[1] + ((corner & 2) != 0 ? step : 0),
            first[2] + ((corner & 4) != 0 ? step : 0)};
  }

  Vec3 place_of(const Index3& node) const {
    return origin_m_ +
           spacing_m_ * Vec3(static_cast<double>(node[0]), static_cast<double>(node[1]), static_cast<double>(node[2]));
  }

  const LatticeNode& node_at(const Index3& index) {
    const auto [found, added] = nodes_.try_emplace(key_of(index));
    if (added) {
      found->second.position_m = place_of(index);
      found->second.value_m = field_(found->second.position_m);
      if (found->second.value_m == 0.0) found->second.value_m = kClearOfNodes * spacing_m_;  // nothing lies on a node
    }
    return found->second;
  }

  void cut_block(const Index3& first) {
    for (int x = 0; x < kBlockCells; ++x) {
      for (int y = 0; y < kBlockCells; ++y) {
        for (int z = 0; z < kBlockCells; ++z) cut_cell({first[0] + x, first[1] + y, first[2] + z});
      }
    }
  }

  void cut_cell(const Index3& cell) {
    std::array<Index3, 8> corners;
    int inside = 0;
    for (int c = 0; c < 8; ++c) {
      corners[static_cast<std::size_t>(c)] = corner_of(cell, c, 1);
      if (node_at(corners[static_cast<std::size_t>(c)]).value_m < 0.0) ++inside;
    }
    if (inside == 0 || inside == 8) return;
    for (const auto& tet : kKuhnTets) {
      std::array<Index3, 4> nodes;
      for (std::size_t k = 0; k < 4; ++k) nodes[k] = corners[static_cast<std::size_t>(tet[k])];
      cut_tet(nodes);
    }
  }

  /// One or two triangles, seen counter-clockwise from outside: the tets of the table are positively oriented, and an
  /// odd permutation of the nodes flips the triangle.
  void cut_tet(const std::array<Index3, 4>& nodes) {
    std::array<std::size_t, 4> order{};  // inner nodes first
    std::size_t inner = 0, outer = 4;
    for (std::size_t k = 0; k < 4; ++k) {
      if (node_at(nodes[k]).value_m < 0.0)
        order[inner++] = k;
      else
        order[--outer] = k;
    }
    if (inner == 0 || inner == 4) return;
    const auto cut = [&](std::size_t i, std::size_t o) { return cut_edge(nodes[order[i]], nodes[order[o]]); };
    const bool odd = is_odd(order);
    if (inner == 1) {
      add(cut(0, 1), cut(0, 2), cut(0, 3), odd);
    } else if (inner == 3) {
      add(cut(0, 3), cut(1, 3), cut(2, 3), odd);
    } else {
      const int a = cut(0, 2), b = cut(0, 3), c = cut(1, 3), d = cut(1, 2);
      add(a, b, c, odd);
      add(a, c, d, odd);
    }
  }

  static bool is_odd(const std::array<std::size_t, 4>& order) {
    bool odd = false;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) odd ^= order[i] > order[j];
    }
    return odd;
  }

  void add(int a, int b, int c, bool flipped) {
    if (flipped) std::swap(b, c);
    mesh_.triangles.push_back({a, b, c});
  }

  /// The vertex where the surface cuts the edge between an inner and an outer node.
  int cut_edge(const Index3& inner, const Index3& outer) {
    const Index3& low = std::min(inner, outer);
    int direction = 0;  // Kuhn's edges go to one of the seven other corners of a cube
    for (std::size_t k = 0; k < 3; ++k) direction |= (inner[k] != outer[k] ? 1 : 0) << k;
    const auto [found, added] = vertices_.try_emplace(key_of(low) * 8 + static_cast<std::uint64_t>(direction), 0);
    if (added) {
      found->second = static_cast<int>(mesh_.positions_m.size());
      mesh_.positions_m.push_back(root_between(node_at(inner), node_at(outer)));
    }
    return found->second;
  }

  /// False position; an end that stays counts half (the Illinois rule), or creases would hold the root on one side.
  Vec3 root_between(const LatticeNode& inner, const LatticeNode& outer) const {
    double low = 0.0, high = 1.0, low_m = inner.value_m, high_m = outer.value_m;
    double part = low_m / (low_m - high_m);
    for (int step = 0; step < kRootSteps; ++step) {
      const double value_m = field_(inner.position_m + part * (outer.position_m - inner.position_m));
      if (value_m < 0.0)
        low = part, low_m = value_m, high_m *= 0.5;
      else
        high = part, high_m = value_m, low_m *= 0.5;
      part = high_m > low_m ? low + (high - low) * low_m / (low_m - high_m) : 0.5 * (low + high);
    }
    part = std::clamp(part, kClearOfNodes, 1.0 - kClearOfNodes);
    return inner.position_m + part * (outer.position_m - inner.position_m);
  }

  const BodyField& field_;
  Vec3 origin_m_;
  double spacing_m_;
  std::unordered_map<std::uint64_t, LatticeNode> nodes_;
  std::unordered_map<std::uint64_t, int> vertices_;  // by the edge's lower node and direction
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh extract_level_set(const BodyField& field, const Eigen::AlignedBox3d& box, double spacing_m) {
  const Eigen::AlignedBox3d wide(box.min() - Vec3::Constant(spacing_m), box.max() + Vec3::Constant(spacing_m));
  const double cells = std::ceil(wide.sizes().maxCoeff() / spacing_m);
  int root = kBlockCells;
  while (root < static_cast<int>(cells)) root *= 2;
  Extractor extractor(field, wide.min(), spacing_m);
  extractor.visit({0, 0, 0}, root);
  return extractor.take();
}

double spacing_for_triangles_m(double area_m2, double triangles) {
  return std::sqrt(kTrianglesPerCell * area_m2 / triangles);
}

double spacing_for_thickness_m(double area_m2, double volume_m3) {
  return kMostOfThickness * 2.0 * volume_m3 / area_m2;
}

}  // namespace myotact::prepare

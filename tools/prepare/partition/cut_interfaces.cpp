#include <algorithm>
#include <array>
#include <unordered_map>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/at.h"
#include "prepare/partition/interfaces.h"

namespace myotact::prepare {

namespace {

/// Cut points keep this part of an edge away from its ends, so that no triangle is flat.
constexpr double kClearOfNodes = 0.05;

/// Six tets that fill a cube, all around its diagonal from corner 0 to corner 7 (corner = x + 2 y + 4 z). Each runs
/// from corner to corner up the cube, so that the corners' order tells a tet's edges and faces in every cube alike.
constexpr std::array<std::array<int, 4>, 6> kKuhnTets = {
    {{0, 1, 3, 7}, {0, 2, 3, 7}, {0, 2, 6, 7}, {0, 4, 6, 7}, {0, 4, 5, 7}, {0, 1, 5, 7}}};
constexpr std::array<std::array<std::size_t, 3>, 4> kTetFaces = {{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}};

Vec3 corner_place(int corner) {
  return {static_cast<double>(corner & 1), static_cast<double>(corner >> 1 & 1), static_cast<double>(corner >> 2 & 1)};
}

/// A vertex of the interfaces, and where it would be if all margins were alike: inside the cube, in steps, so that
/// triangles can be told to face one way or the other however flat they become.
struct Cut {
  int vertex = -1;
  Vec3 even;
};

/// A line on a tet's face that parts two of its corners.
struct Seam {
  Cut a, b;
  std::size_t one, other;  // corners of the tet on its two sides
};

class Cutter {
 public:
  explicit Cutter(const PartVolume& volume) : volume_(volume), mirrored_(volume.lattice.steps_m.determinant() < 0.0) {
    const std::size_t row = static_cast<std::size_t>(volume.lattice.counts[0]);
    const std::size_t layer = row * static_cast<std::size_t>(volume.lattice.counts[1]);
    for (std::size_t c = 0; c < 8; ++c) corner_step_[c] = (c & 1) + (c >> 1 & 1) * row + (c >> 2 & 1) * layer;
  }

  Interfaces run() {
    const auto& [nx, ny, nz] = volume_.lattice.counts;
    for (int z = 0; z + 1 < nz; ++z) {
      for (int y = 0; y + 1 < ny; ++y) {
        const std::size_t first = point_at(volume_.lattice.counts, 0, y, z);
        for (int x = 0; x + 1 < nx; ++x) cut_cube(first + static_cast<std::size_t>(x));
      }
    }
    return std::move(interfaces_);
  }

 private:
  using Tet = std::array<int, 4>;  // corners of the cube

  std::uint16_t label(int corner) const {
    return volume_.labels[cube_ + corner_step_[static_cast<std::size_t>(corner)]];
  }

  void cut_cube(std::size_t cube) {
    cube_ = cube;
    const std::uint16_t first = label(0);
    bool alike = true;
    for (int c = 1; c < 8 && alike; ++c) alike = label(c) == first;
    if (alike) return;
    for (const Tet& tet : kKuhnTets) cut_tet(tet);
  }

  void cut_tet(const Tet& tet) {
    std::array<std::uint16_t, 4> labels{};
    for (std::size_t k = 0; k < 4; ++k) labels[k] = label(tet[k]);
    std::array<std::uint16_t, 4> sorted = labels;
    std::sort(sorted.begin(), sorted.end());
    const auto kinds = std::unique(sorted.begin(), sorted.end()) - sorted.begin();
    if (kinds == 2) cut_in_two(tet, labels);
    if (kinds > 2) cut_around_middle(tet, labels);
  }

  /// One triangle around a corner, or two across.
  void cut_in_two(const Tet& tet, const std::array<std::uint16_t, 4>& labels) {
    std::array<std::size_t, 4> order{};  // those like the first corner first
    std::size_t inner = 0, outer = 4;
    for (std::size_t k = 0; k < 4; ++k) (labels[k] == labels[0] ? order[inner++] : order[--outer]) = k;
    const auto cut = [&](std::size_t i, std::size_t o) { return cut_edge(tet[order[i]], tet[order[o]]); };
    const int one = tet[order[0]], other = tet[order[3]];
    if (inner == 1) add({cut(0, 1), cut(0, 2), cut(0, 3)}, one, other);
    if (inner == 3) add({cut(0, 3), cut(1, 3), cut(2, 3)}, one, other);
    if (inner != 2) return;
    const Cut a = cut(0, 2), b = cut(0, 3), c = cut(1, 3), d = cut(1, 2);
    add({a, b, c}, one, other);
    add({a, c, d}, one, other);
  }

  /// Triangles from a point in the middle to every seam on the tet's faces.
  void cut_around_middle(const Tet& tet, const std::array<std::uint16_t, 4>& labels) {
    std::vector<Seam>& seams = seams_;
    seams.clear();
    for (const auto& face : kTetFaces) find_seams(tet, labels, face);
    Cut middle{static_cast<int>(interfaces_.positions_m.size()), Vec3::Zero()};
    Vec3 place_m = Vec3::Zero();
    int edges = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        if (labels[i] == labels[j]) continue;
        const Cut cut = cut_edge(tet[i], tet[j]);
        middle.even += cut.even;
        place_m += interfaces_.positions_m[static_cast<std::size_t>(cut.vertex)];
        ++edges;
      }
    }
    middle.even /= edges;
    middle.vertex = static_cast<int>(interfaces_.positions_m.size());
    interfaces_.positions_m.push_back(place_m / edges);
    for (const Seam& seam : seams) add({middle, seam.a, seam.b}, tet[seam.one], tet[seam.other]);
  }

  void find_seams(const Tet& tet, const std::array<std::uint16_t, 4>& labels, const std::array<std::size_t, 3>& face) {
    std::array<Cut, 3> cuts;
    std::array<std::array<std::size_t, 2>, 3> ends{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = face[k], j = face[(k + 1) % 3];
      if (labels[i] == labels[j]) continue;
      cuts[count] = cut_edge(tet[std::min(i, j)], tet[std::max(i, j)]);
      ends[count++] = {i, j};
    }
    if (count == 2) seams_.push_back({cuts[0], cuts[1], ends[0][0], ends[0][1]});
    if (count != 3) return;
    const Cut middle = cut_face({tet[face[0]], tet[face[1]], tet[face[2]]}, cuts);
    for (std::size_t k = 0; k < 3; ++k) seams_.push_back({cuts[k], middle, ends[k][0], ends[k][1]});
  }

  /// The vertex on the edge between two unlike corners of the cube.
  Cut cut_edge(int a, int b) {
    const int low = a & b, high = a | b;  // edges of Kuhn's tets run up the cube
    const std::size_t low_point = cube_ + corner_step_[static_cast<std::size_t>(low)];
    const std::size_t high_point = cube_ + corner_step_[static_cast<std::size_t>(high)];
    const auto [found, added] = vertices_.try_emplace(low_point * 64 + static_cast<std::size_t>(high - low), 0);
    if (added) {
      const double low_margin = volume_.margins[low_point], high_margin = volume_.margins[high_point];
      const double sum = low_margin + high_margin;
      const double part = std::clamp(sum > 0.0 ? low_margin / sum : 0.5, kClearOfNodes, 1.0 - kClearOfNodes);
      const Vec3 low_m = place_m(volume_.lattice, low_point), high_m = place_m(volume_.lattice, high_point);
      found->second = static_cast<int>(interfaces_.positions_m.size());
      interfaces_.positions_m.emplace_back(low_m + part * (high_m - low_m));
    }
    return {found->second, 0.5 * (corner_place(low) + corner_place(high))};
  }

  /// The vertex in the middle of a face whose three corners, the lowest first, are all unlike.
  Cut cut_face(const std::array<int, 3>& corners, const std::array<Cut, 3>& cuts) {
    const std::size_t low_point = cube_ + corner_step_[static_cast<std::size_t>(corners[0])];
    const std::size_t key = at(corners[1] - corners[0]) * 8 + at(corners[2] - corners[0]);
    const auto [found, added] = vertices_.try_emplace(low_point * 64 + key, 0);
    const auto at = [&](std::size_t k) { return interfaces_.positions_m[static_cast<std::size_t>(cuts[k].vertex)]; };
    if (added) {
      const Vec3 middle_m = (at(0) + at(1) + at(2)) / 3.0;
      found->second = static_cast<int>(interfaces_.positions_m.size());
      interfaces_.positions_m.push_back(middle_m);
    }
    return {found->second, (cuts[0].even + cuts[1].even + cuts[2].even) / 3.0};
  }

  /// A triangle between two corners of the cube with unlike labels.
  void add(const std::array<Cut, 3>& cuts, int one, int other) {
    const std::uint16_t one_label = label(one), other_label = label(other);
    const bool swapped = one_label == 0 || (other_label != 0 && other_label < one_label);
    const Vec3 outward = (swapped ? -1.0 : 1.0) * (corner_place(other) - corner_place(one));
    const Vec3 normal = (cuts[1].even - cuts[0].even).cross(cuts[2].even - cuts[0].even);
    Interfaces::Face face{{cuts[0].vertex, cuts[1].vertex, cuts[2].vertex},
                          swapped ? other_label : one_label,
                          swapped ? one_label : other_label};
    if ((normal.dot(outward) < 0.0) != mirrored_) std::swap(face.vertices[1], face.vertices[2]);
    interfaces_.faces.push_back(face);
  }

  const PartVolume& volume_;
  bool mirrored_;  // the lattice's axes are left-handed
  std::array<std::size_t, 8> corner_step_{};
  std::size_t cube_ = 0;  // its lowest point
  std::vector<Seam> seams_;
  std::unordered_map<std::size_t, int> vertices_;  // by lowest point and the way to the others
  Interfaces interfaces_;
};

}  // namespace

Interfaces cut_interfaces(const PartVolume& volume) {
  return Cutter(volume).run();
}

std::vector<geometry::TriangleMesh> surfaces_of(const Interfaces& interfaces, int parts) {
  std::vector<geometry::TriangleMesh> surfaces(static_cast<std::size_t>(parts));
  std::vector<std::unordered_map<int, int>> numbers(surfaces.size());
  const auto add = [&](std::size_t part, const std::array<int, 3>& vertices) {
    std::array<int, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [found, added] =
          numbers[part].try_emplace(vertices[k], static_cast<int>(surfaces[part].positions_m.size()));
      if (added) surfaces[part].positions_m.push_back(interfaces.positions_m[static_cast<std::size_t>(vertices[k])]);
      corners[k] = found->second;
    }
    surfaces[part].triangles.push_back(corners);
  };
  for (const auto& [v, inner, outer] : interfaces.faces) {
    add(static_cast<std::size_t>(inner - 1), v);
    if (outer > 0) add(static_cast<std::size_t>(outer - 1), {v[0], v[2], v[1]});
  }
  return surfaces;
}

}  // namespace myotact::prepare

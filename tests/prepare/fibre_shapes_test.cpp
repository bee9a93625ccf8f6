#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "geometry/tet_topology.h"
#include "prepare/architecture/fibre_field.h"
#include "prepare/shapes.h"
#include "prepare/tets/tetrahedralise.h"

// Fibre fields against directions that are known exactly.

namespace myotact::prepare {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;
constexpr double kLargestMean_deg = 2.0;

Vec3 centre_of(const geometry::TetMesh& tets, std::size_t t) {
  Vec3 centre = Vec3::Zero();
  for (const int n : tets.corners[t]) centre += 0.25 * tets.nodes_m[static_cast<std::size_t>(n)];
  return centre;
}

/// Mean over the volume of the angle between the field and `exact`, a direction at a place.
template <class Exact>
double mean_error_deg(const geometry::TetMesh& tets, const FibreField& field, Exact&& exact) {
  double sum = 0.0;
  for (std::size_t t = 0; t < tets.corners.size(); ++t) {
    const Vec3 direction = exact(centre_of(tets, t)).normalized();
    const double angle_rad = std::acos(std::clamp(direction.dot(field.direction[t]), -1.0, 1.0));
    sum += geometry::corner_volume_m3(tets, t) * angle_rad;
  }
  return sum / geometry::total_volume_m3(tets) / kDegree_rad;
}

/// The six tets of a cell, all about its diagonal, as the order of steps along the axes from one end to the other.
constexpr int kPaths[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};

/// The triangles whose corners are all in the patch.
template <class Inside>
AttachmentPatch patch_of(const geometry::TriangleMesh& surface, Inside&& inside) {
  AttachmentPatch patch;
  for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
    const auto& [a, b, c] = surface.triangles[f];
    const auto at = [&](int v) { return surface.positions_m[static_cast<std::size_t>(v)]; };
    if (!(inside(at(a)) && inside(at(b)) && inside(at(c)))) continue;
    patch.triangles.push_back(static_cast<int>(f));
    patch.vertices.insert(patch.vertices.end(), {a, b, c});
    patch.area_m2 += 0.5 * (at(b) - at(a)).cross(at(c) - at(a)).norm();
  }
  std::sort(patch.vertices.begin(), patch.vertices.end());
  patch.vertices.erase(std::unique(patch.vertices.begin(), patch.vertices.end()), patch.vertices.end());
  return patch;
}

/// Two fleshy halves between upright outer sides, where they arise, and a raphe in the plane x = 0, where they insert
/// from both sides: a cut of no width. Their fibres rise towards it at 25 degrees, as do their floors and ceilings.
/// The halves hang together at the raphe's foot. One even field fits all of that, so it is the answer.
class Bipennate {
 public:
  static constexpr double kSlope = 0.4663;  // tan 25 degrees
  static constexpr int kAcross = 6, kUp = 20, kDeep = 5;
  static constexpr double kCell_m = 2e-3;

  Bipennate() {
    for (int layer = 0; layer <= kDeep; ++layer) {
      for (int row = 0; row <= kUp; ++row) {
        for (int column = -kAcross; column <= kAcross; ++column) add_node(column, row, layer);
        if (row > 0) add_node(0, row, layer);  // the raphe's other side, last of its row
      }
    }
    for (int layer = 0; layer < kDeep; ++layer) {
      for (int row = 0; row < kUp; ++row) {
        for (int column = -kAcross; column < kAcross; ++column) add_cell(column, row, layer);
      }
    }
    surface.positions_m = tets.nodes_m;
    for (const auto& triangle : geometry::boundary_triangles(tets)) surface.triangles.push_back(triangle.corners);
  }

  /// The part of the surface at this distance from the raphe.
  AttachmentPatch side(double distance_m) const {
    return patch_of(surface, [&](const Vec3& p) { return std::abs(std::abs(p.x()) - distance_m) < 1e-9; });
  }

  static Vec3 fibre(const Vec3& place_m) { return {place_m.x() > 0.0 ? -1.0 : 1.0, kSlope, 0.0}; }

  geometry::TetMesh tets;
  geometry::TriangleMesh surface;

 private:
  void add_node(int column, int row, int layer) {
    const double x_m = kCell_m * column;
    tets.nodes_m.push_back({x_m, kCell_m * row - kSlope * std::abs(x_m), kCell_m * layer});
  }

  /// `left`: seen from the cells on the left of the raphe.
  int node(int column, int row, int layer, bool left) const {
    constexpr int kRow = 2 * kAcross + 1;
    const int before = layer * ((kUp + 1) * kRow + kUp) + row * kRow + std::max(0, row - 1);
    if (column == 0 && row > 0 && left) return before + kRow;
    return before + column + kAcross;
  }

  /// Six tets about the diagonal; mirrored on the right, so that both halves are alike.
  void add_cell(int column, int row, int layer) {
    const bool left = column < 0;
    for (const auto& path : kPaths) {
      int at[3] = {0, 0, 0};
      std::array<int, 4> corners{};
      for (std::size_t k = 0; k < 4; ++k) {
        if (k > 0) at[path[k - 1]] = 1;
        const int across = left ? at[0] : 1 - at[0];
        corners[k] = node(column + across, row + at[1], layer + at[2], left);
      }
      tets.corners.push_back(corners);
      if (geometry::corner_volume_m3(tets, tets.corners.size() - 1) < 0.0) {
        std::swap(tets.corners.back()[2], tets.corners.back()[3]);
      }
    }
  }
};

TEST(FibreShapes, RunObliquelyToTheRapheOfABipennateMuscle) {
  const Bipennate muscle;
  const FibreField field = solve_fibres("bipennate", muscle.tets, muscle.surface,
                                        {muscle.side(Bipennate::kCell_m * Bipennate::kAcross)}, {muscle.side(0.0)});
  const double error_deg = mean_error_deg(muscle.tets, field, Bipennate::fibre);
  RecordProperty("mean_error_deg", std::to_string(error_deg));
  EXPECT_LT(error_deg, kLargestMean_deg);
}

/// A bar of elliptic section, twisted about x. To first order in the twist the potential is x plus the twist times the
/// warping function of Saint-Venant's torsion with the other sign, which the ellipse has in closed form.
TEST(FibreShapes, TurnWithATwistedBar) {
  constexpr double kWide = 1.0, kThin = 0.5;                  // half-axes over the rod's radius
  constexpr double kTwist_rad_m = 60.0 * kDegree_rad / 0.10;  // 60 degrees from end to end
  const testing::RodShape shape{.radius_m = 0.012, .length_m = 0.10, .sides = 32, .rings = 32};
  geometry::TriangleMesh surface = testing::rod_surface(shape);
  AttachmentPatch begin = testing::rod_end(surface, 0.0), end = testing::rod_end(surface, shape.length_m);
  for (Vec3& p : surface.positions_m) {
    const double turn_rad = kTwist_rad_m * p.x(), y_m = kWide * p.y(), z_m = kThin * p.z();
    p = {p.x(), std::cos(turn_rad) * y_m - std::sin(turn_rad) * z_m,
         std::sin(turn_rad) * y_m + std::cos(turn_rad) * z_m};
  }
  const geometry::TetMesh tets = tetrahedralise("bar", surface);
  const FibreField field = solve_fibres("bar", tets, surface, {begin}, {end});
  const double flatness = (kWide * kWide - kThin * kThin) / (kWide * kWide + kThin * kThin);
  const double error_deg = mean_error_deg(tets, field, [&](const Vec3& p) {
    const double turn_rad = kTwist_rad_m * p.x();
    const double c = std::cos(turn_rad), s = std::sin(turn_rad);
    const double y_m = c * p.y() + s * p.z(), z_m = -s * p.y() + c * p.z();  // in the turned section
    const double v = kTwist_rad_m * flatness * z_m, w = kTwist_rad_m * flatness * y_m;
    return Vec3(1.0, c * v - s * w, s * v + c * w);
  });
  RecordProperty("mean_error_deg", std::to_string(error_deg));
  EXPECT_LT(error_deg, kLargestMean_deg);
  // Fibres that did not turn would be farther off than that.
  const double straight_deg = mean_error_deg(tets, field, [](const Vec3&) { return Vec3::UnitX(); });
  EXPECT_GT(straight_deg, error_deg);
}

/// A fan about the z axis, from the radius of 30 mm to 90, 70 degrees wide, in even steps of the radius's logarithm.
/// The flux is even on both arcs, so fibres are rays from the axis.
class Fan {
 public:
  static constexpr double kInner_m = 0.03, kOuter_m = 0.09, kThick_m = 0.012;
  static constexpr double kOpening_rad = 70.0 * kDegree_rad;
  static constexpr int kOut = 12, kAround = 14, kDeep = 3;

  Fan() {
    for (int k = 0; k <= kDeep; ++k) {
      for (int j = 0; j <= kAround; ++j) {
        for (int i = 0; i <= kOut; ++i) {
          const double radius_m = kInner_m * std::pow(kOuter_m / kInner_m, static_cast<double>(i) / kOut);
          const double angle_rad = kOpening_rad * (static_cast<double>(j) / kAround - 0.5);
          tets.nodes_m.emplace_back(radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad),
                                    kThick_m * k / kDeep);
        }
      }
    }
    for (int k = 0; k < kDeep; ++k) {
      for (int j = 0; j < kAround; ++j) {
        for (int i = 0; i < kOut; ++i) add_cell({i, j, k});
      }
    }
    surface.positions_m = tets.nodes_m;
    for (const auto& triangle : geometry::boundary_triangles(tets)) surface.triangles.push_back(triangle.corners);
  }

  AttachmentPatch arc(double radius_m) const {
    return patch_of(surface, [&](const Vec3& p) { return std::abs(std::hypot(p.x(), p.y()) - radius_m) < 1e-9; });
  }

  geometry::TetMesh tets;
  geometry::TriangleMesh surface;

 private:
  void add_cell(const std::array<int, 3>& first) {
    for (const auto& path : kPaths) {
      std::array<int, 3> at = first;
      std::array<int, 4> corners{};
      for (std::size_t c = 0; c < 4; ++c) {
        if (c > 0) ++at[static_cast<std::size_t>(path[c - 1])];
        corners[c] = (at[2] * (kAround + 1) + at[1]) * (kOut + 1) + at[0];
      }
      tets.corners.push_back(corners);
      if (geometry::corner_volume_m3(tets, tets.corners.size() - 1) < 0.0) {
        std::swap(tets.corners.back()[2], tets.corners.back()[3]);
      }
    }
  }
};

TEST(FibreShapes, SpreadLikeRaysInAFan) {
  const Fan fan;
  const FibreField field =
      solve_fibres("fan", fan.tets, fan.surface, {fan.arc(Fan::kInner_m)}, {fan.arc(Fan::kOuter_m)});
  const double error_deg = mean_error_deg(fan.tets, field, [](const Vec3& p) { return Vec3(p.x(), p.y(), 0.0); });
  RecordProperty("mean_error_deg", std::to_string(error_deg));
  EXPECT_LT(error_deg, kLargestMean_deg);
  // Parallel fibres would be a quarter of the opening off.
  EXPECT_GT(mean_error_deg(fan.tets, field, [](const Vec3&) { return Vec3::UnitX(); }), 10.0);
}

}  // namespace
}  // namespace myotact::prepare

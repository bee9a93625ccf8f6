#include "prepare/shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include <Eigen/Geometry>

namespace myotact::testing {

using geometry::TriangleMesh;

TriangleMesh box_surface(const Vec3& lowest_m, const Vec3& highest_m) {
  TriangleMesh box;
  for (int corner = 0; corner < 8; ++corner) {
    box.positions_m.emplace_back(corner & 1 ? highest_m.x() : lowest_m.x(), corner & 2 ? highest_m.y() : lowest_m.y(),
                                 corner & 4 ? highest_m.z() : lowest_m.z());
  }
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return box;
}

TriangleMesh rod_surface(const RodShape& shape) {
  TriangleMesh rod;
  for (int ring = 0; ring <= shape.rings; ++ring) {
    for (int side = 0; side < shape.sides; ++side) {
      const double angle = 2.0 * std::numbers::pi * side / shape.sides;
      rod.positions_m.emplace_back(shape.length_m * ring / shape.rings, shape.radius_m * std::cos(angle),
                                   shape.radius_m * std::sin(angle));
    }
  }
  const int first = static_cast<int>(rod.positions_m.size()), last = first + 1;
  rod.positions_m.emplace_back(0.0, 0.0, 0.0);
  rod.positions_m.emplace_back(shape.length_m, 0.0, 0.0);
  const auto vertex = [&](int ring, int side) { return ring * shape.sides + side % shape.sides; };
  for (int side = 0; side < shape.sides; ++side) {
    for (int ring = 0; ring < shape.rings; ++ring) {
      const int a = vertex(ring, side), b = vertex(ring, side + 1), c = vertex(ring + 1, side),
                d = vertex(ring + 1, side + 1);
      rod.triangles.push_back({a, b, c});
      rod.triangles.push_back({b, d, c});
    }
    rod.triangles.push_back({first, vertex(0, side + 1), vertex(0, side)});
    rod.triangles.push_back({last, vertex(shape.rings, side), vertex(shape.rings, side + 1)});
  }
  return rod;
}

double rod_section_m2(const RodShape& shape) {
  return 0.5 * shape.sides * shape.radius_m * shape.radius_m * std::sin(2.0 * std::numbers::pi / shape.sides);
}

prepare::AttachmentPatch rod_end(const TriangleMesh& rod, double x_m) {
  prepare::AttachmentPatch patch;
  std::set<int> vertices;
  for (std::size_t t = 0; t < rod.triangles.size(); ++t) {
    const auto& c = rod.triangles[t];
    const Vec3 a = rod.positions_m[static_cast<std::size_t>(c[0])], b = rod.positions_m[static_cast<std::size_t>(c[1])],
               d = rod.positions_m[static_cast<std::size_t>(c[2])];
    if (std::abs(a.x() - x_m) + std::abs(b.x() - x_m) + std::abs(d.x() - x_m) > 1e-9) continue;
    patch.triangles.push_back(static_cast<int>(t));
    patch.area_m2 += 0.5 * (b - a).cross(d - a).norm();
    vertices.insert(c.begin(), c.end());
  }
  patch.vertices.assign(vertices.begin(), vertices.end());
  patch.centroid_m = {x_m, 0.0, 0.0};
  return patch;
}

TriangleMesh sheet_surface(const SheetShape& shape) {
  TriangleMesh sheet;
  const int n = shape.steps;
  for (const double side : {-0.5, 0.5}) {
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) {
        const double u = 2.0 * i / n - 1.0, v = 2.0 * j / n - 1.0;
        sheet.positions_m.emplace_back(0.5 * u * shape.length_m, 0.5 * v * shape.width_m,
                                       shape.bulge_m * (1.0 - u * u) * (1.0 - v * v) + side * shape.thickness_m);
      }
    }
  }
  const auto at = [n](int layer, int i, int j) { return (layer * (n + 1) + i) * (n + 1) + j; };
  const auto quad = [&](int a, int b, int c, int d) {
    sheet.triangles.push_back({a, b, c});
    sheet.triangles.push_back({a, c, d});
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      quad(at(1, i, j), at(1, i + 1, j), at(1, i + 1, j + 1), at(1, i, j + 1));
      quad(at(0, i, j), at(0, i, j + 1), at(0, i + 1, j + 1), at(0, i + 1, j));
    }
    quad(at(0, i, 0), at(0, i + 1, 0), at(1, i + 1, 0), at(1, i, 0));
    quad(at(0, i + 1, n), at(0, i, n), at(1, i, n), at(1, i + 1, n));
    quad(at(0, 0, i + 1), at(0, 0, i), at(1, 0, i), at(1, 0, i + 1));
    quad(at(0, n, i), at(0, n, i + 1), at(1, n, i + 1), at(1, n, i));
  }
  return sheet;
}

TriangleMesh sphere_surface(const Vec3& centre_m, double radius_m, int halvings) {
  TriangleMesh sphere;
  const double a = 0.525731112119133606, b = 0.850650808352039932;  // of the icosahedron with unit radius
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-1.0, 1.0}) {
      sphere.positions_m.insert(sphere.positions_m.end(),
                                {Vec3(s * a, t * b, 0.0), Vec3(0.0, s * a, t * b), Vec3(t * b, 0.0, s * a)});
    }
  }
  for (int i = 0; i < 12; ++i) {
    for (int j = i + 1; j < 12; ++j) {
      for (int k = j + 1; k < 12; ++k) {
        const Vec3 &p = sphere.positions_m[static_cast<std::size_t>(i)],
                   &q = sphere.positions_m[static_cast<std::size_t>(j)],
                   &r = sphere.positions_m[static_cast<std::size_t>(k)];
        const double longest = std::max({(p - q).norm(), (q - r).norm(), (r - p).norm()});
        if (longest > 2.0 * a + 1e-6) continue;  // edges of the icosahedron only
        const bool outward = (q - p).cross(r - p).dot(p) > 0.0;
        sphere.triangles.push_back(outward ? std::array<int, 3>{i, j, k} : std::array<int, 3>{i, k, j});
      }
    }
  }
  for (int halving = 0; halving < halvings; ++halving) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int i, int j) {
      const auto [found, added] = middles.try_emplace(std::minmax(i, j), static_cast<int>(sphere.positions_m.size()));
      if (added) {
        sphere.positions_m.push_back(
            (sphere.positions_m[static_cast<std::size_t>(i)] + sphere.positions_m[static_cast<std::size_t>(j)])
                .normalized());
      }
      return found->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [i, j, k] : sphere.triangles) {
      const int ij = middle(i, j), jk = middle(j, k), ki = middle(k, i);
      finer.insert(finer.end(), {{i, ij, ki}, {ij, j, jk}, {ki, jk, k}, {ij, jk, ki}});
    }
    sphere.triangles = std::move(finer);
  }
  for (Vec3& p : sphere.positions_m) p = centre_m + radius_m * p;
  return sphere;
}

SmallLimb small_limb() {
  SmallLimb limb;
  prepare::AnatomyData& anatomy = limb.anatomy;
  anatomy.name = "two boxes and a rod";
  anatomy.side = "left";
  anatomy.bodies = {{"upper", 0.3, {-0.02, 0.0, -0.02}, {1e-4, 1e-4, 1e-4, 0.0, 0.0, 0.0}, true},
                    {"lower", 0.2, {0.12, 0.0, -0.02}, {1e-4, 1e-4, 1e-4, 0.0, 0.0, 0.0}, true}};
  anatomy.bones = {{"upper_bone", "Os superius", "upper bone", 0, ""},
                   {"lower_bone", "Os inferius", "lower bone", 1, ""}};
  anatomy::Joint hinge;
  hinge.key = "elbow";
  hinge.parent = 0;
  hinge.child = 1;
  hinge.centre_m = {0.05, 0.0, -0.02};
  hinge.axes = {-Vec3::UnitY()};
  hinge.range_rad = {{-0.2, 1.7}};
  anatomy.joints = {hinge};
  prepare::MuscleData muscle;
  muscle.mechanics.key = "rod";
  muscle.mechanics.material = "muscle";
  muscle.mechanics.peak_force_N = 100.0;
  muscle.mechanics.optimal_fibre_m = 0.1;
  muscle.origins = {{{"upper_bone"}, -1, Vec3::Zero(), 0.0}};
  muscle.insertions = {{{"lower_bone"}, -1, {0.10, 0.0, 0.0}, 0.0}};
  anatomy.muscles = {muscle};
  anatomy.groups = {{0, {"rod"}, {}}};
  limb.bones = {{"upper_bone", box_surface({-0.03, -0.02, -0.03}, {0.0, 0.02, 0.02})},
                {"lower_bone", box_surface({0.10, -0.02, -0.03}, {0.13, 0.02, 0.02})}};
  limb.muscles = {{"rod", rod_surface({})}};
  return limb;
}

}  // namespace myotact::testing

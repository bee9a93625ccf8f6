#include "measure/fidelity/touch_places.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <utility>

#include <Eigen/Geometry>

#include "core/at.h"
#include "geometry/triangle_tree.h"

namespace myotact::measure {

namespace {

constexpr double kFreeFrom_m = 1e-3, kFreeTo_m = 40e-3, kFreeStep_m = 2e-3;  // of the way to a place that is looked at
constexpr int kTriesAPlace = 40;  // muscles of which a fortieth lies open still get their places

/// A surface as it stands.
struct StandingSurface {
  geometry::TriangleTree tree;
  std::vector<Vec3> positions_m;

  explicit StandingSurface(geometry::TriangleMesh mesh) : tree(mesh), positions_m(std::move(mesh.positions_m)) {}
};

std::vector<StandingSurface> standing_surfaces(const anatomy::Specimen& specimen,
                                               const simulation::Simulation& simulation) {
  std::vector<StandingSurface> surfaces;
  for (std::size_t m = 0; m < specimen.muscles.size(); ++m) {
    const std::span<const Vec3> skin_m = simulation.skin_world_m(static_cast<int>(m));
    surfaces.emplace_back(geometry::TriangleMesh{{skin_m.begin(), skin_m.end()}, specimen.muscles[m].skin.triangles});
  }
  for (const anatomy::Bone& bone : specimen.bones) {
    geometry::TriangleMesh mesh = bone.surface;
    const Pose pose = simulation.body_pose(bone.body);
    for (Vec3& x : mesh.positions_m) x = pose * x;
    surfaces.emplace_back(std::move(mesh));
  }
  return surfaces;
}

/// Picks places of one surface by area.
class RandomPlaces {
 public:
  RandomPlaces(const StandingSurface& surface, std::uint64_t seed) : surface_(surface), random_(seed) {
    for (int t = 0; t < surface.tree.triangle_count(); ++t) {
      sums_m2_.push_back((sums_m2_.empty() ? 0.0 : sums_m2_.back()) + 0.5 * area_vector_m2(t).norm());
    }
  }

  /// Position and normal; of a surface with area.
  std::pair<Vec3, Vec3> next() {
    const auto found = std::upper_bound(sums_m2_.begin(), sums_m2_.end() - 1, unit() * sums_m2_.back());
    const auto triangle = static_cast<int>(found - sums_m2_.begin());
    const auto& [a, b, c] = surface_.tree.triangle(triangle);
    const double root = std::sqrt(unit()), share = unit();  // even over a triangle (Turk 1990)
    const Vec3 position_m = (1.0 - root) * surface_.positions_m[at(a)] +
                            root * (1.0 - share) * surface_.positions_m[at(b)] +
                            root * share * surface_.positions_m[at(c)];
    return {position_m, area_vector_m2(triangle).normalized()};
  }

 private:
  Vec3 area_vector_m2(int triangle) const {
    const auto& [a, b, c] = surface_.tree.triangle(triangle);
    const Vec3& corner_m = surface_.positions_m[at(a)];
    return (surface_.positions_m[at(b)] - corner_m).cross(surface_.positions_m[at(c)] - corner_m);
  }
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }  // the same with every library

  const StandingSurface& surface_;
  std::mt19937_64 random_;
  std::vector<double> sums_m2_;  // of the triangles up to each
};

bool is_free(const std::vector<StandingSurface>& surfaces, const Vec3& place_m, const Vec3& normal, double radius_m) {
  for (double way_m = kFreeFrom_m; way_m <= kFreeTo_m; way_m += kFreeStep_m) {
    const Vec3 centre_m = place_m + (radius_m + way_m) * normal;
    for (const StandingSurface& surface : surfaces) {
      if (surface.tree.nearest(centre_m, surface.positions_m, radius_m).triangle >= 0) return false;
    }
  }
  return true;
}

/// Direction of a muscle's line across a normal.
Vec3 along_line(const std::vector<Vec3>& line_m, const Vec3& normal) {
  const Vec3 way_m = line_m.size() < 2 ? Vec3::Zero() : Vec3(line_m.back() - line_m.front());
  const Vec3 across_m = way_m - way_m.dot(normal) * normal;
  return across_m.norm() > 1e-6 * way_m.norm() ? across_m.normalized() : normal.unitOrthogonal();
}

}  // namespace

std::vector<TouchPlace> touch_places(const anatomy::Specimen& specimen, const simulation::Simulation& simulation,
                                     double tool_radius_m, int count, std::uint64_t seed) {
  const std::vector<StandingSurface> surfaces = standing_surfaces(specimen, simulation);
  std::vector<TouchPlace> places;
  for (int m = 0; m < simulation.muscle_count(); ++m) {
    if (specimen.muscles[at(m)].skin.triangles.empty()) continue;
    RandomPlaces random(surfaces[at(m)], seed * 1000003u + static_cast<std::uint64_t>(m));
    const std::vector<Vec3> line_m = simulation.line_world_m(m);
    for (int tries = 0, found = 0; tries < kTriesAPlace * count && found < count; ++tries) {
      const auto [position_m, normal] = random.next();
      if (!normal.allFinite() || !is_free(surfaces, position_m, normal, tool_radius_m)) continue;
      places.push_back({m, position_m, normal, along_line(line_m, normal)});
      ++found;
    }
  }
  return places;
}

}  // namespace myotact::measure

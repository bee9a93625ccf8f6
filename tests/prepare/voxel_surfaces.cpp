#include "prepare/voxel_surfaces.h"

#include <array>
#include <map>

namespace myotact::testing {

namespace {

using Point = std::array<int, 3>;

class Cuberille {
 public:
  explicit Cuberille(double step_m) : step_m_(step_m) {}

  /// The face of a cube towards the lower or upper side along an axis.
  void add_face(const Point& cube, std::size_t axis, bool upper) {
    constexpr std::array<std::array<int, 2>, 4> kRound = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    std::array<int, 4> corner{};
    for (std::size_t k = 0; k < 4; ++k) {
      Point p = cube;
      p[axis] += upper ? 1 : 0;
      p[(axis + 1) % 3] += kRound[k][0];
      p[(axis + 2) % 3] += kRound[k][1];
      corner[k] = vertex(p);
    }
    if (!upper) std::swap(corner[1], corner[3]);
    mesh.triangles.push_back({corner[0], corner[1], corner[2]});
    mesh.triangles.push_back({corner[0], corner[2], corner[3]});
  }

  geometry::TriangleMesh mesh;

 private:
  int vertex(const Point& p) {
    const auto [known, added] = vertices_.try_emplace(p, static_cast<int>(mesh.positions_m.size()));
    if (added) mesh.positions_m.push_back(step_m_ * Vec3(p[0], p[1], p[2]));
    return known->second;
  }

  double step_m_;
  std::map<Point, int> vertices_;
};

}  // namespace

geometry::TriangleMesh cuberille(int counts, double step_m, const std::function<bool(int, int, int)>& is_inside) {
  const auto inside = [&](const Point& p) {
    for (const int i : p) {
      if (i < 0 || i >= counts) return false;
    }
    return is_inside(p[0], p[1], p[2]);
  };
  Cuberille surface(step_m);
  for (int z = 0; z < counts; ++z) {
    for (int y = 0; y < counts; ++y) {
      for (int x = 0; x < counts; ++x) {
        if (!inside({x, y, z})) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          for (const bool upper : {false, true}) {
            Point next = {x, y, z};
            next[axis] += upper ? 1 : -1;
            if (!inside(next)) surface.add_face({x, y, z}, axis, upper);
          }
        }
      }
    }
  }
  return std::move(surface.mesh);
}

}  // namespace myotact::testing

#include <cmath>
#include <numbers>

#include "prepare/dirty_surfaces.h"

namespace myotact::testing {

using geometry::TriangleMesh;

namespace {

struct TubeShape {
  std::string name;
  int rings = 0, sides = 0;
  double length_m = 0.0, width_m = 0.0, depth_m = 0.0, bend_m = 0.0;
  double fullness = 0.5;  // radius = (4 s (1 - s))^fullness; 0.5: an ellipse along the line
};

/// Ring by ring; the steps are closer at the ends, where the radius grows fast.
TubeBody tube(const TubeShape& shape) {
  TubeBody body{shape.name, shape.rings, shape.sides, {}};
  const auto centre = [&](double s) {
    return Vec3((s - 0.5) * shape.length_m, shape.bend_m * std::sin(std::numbers::pi * s), 0.0);
  };
  body.mesh.positions_m.push_back(centre(0.0));
  for (int ring = 0; ring < shape.rings; ++ring) {
    const double s = 0.5 - 0.5 * std::cos(std::numbers::pi * (ring + 1) / (shape.rings + 1));
    const double swell = std::pow(4.0 * s * (1.0 - s), shape.fullness);
    for (int side = 0; side < shape.sides; ++side) {
      const double angle = 2.0 * std::numbers::pi * side / shape.sides;
      body.mesh.positions_m.emplace_back(
          centre(s) + swell * Vec3(0.0, 0.5 * shape.width_m * std::cos(angle), 0.5 * shape.depth_m * std::sin(angle)));
    }
  }
  body.mesh.positions_m.push_back(centre(1.0));
  for (int side = 0; side < shape.sides; ++side) {
    body.mesh.triangles.push_back({0, body.vertex(0, side + 1), body.vertex(0, side)});
    for (int ring = 0; ring + 1 < shape.rings; ++ring) {
      const int a = body.vertex(ring, side), b = body.vertex(ring, side + 1), c = body.vertex(ring + 1, side),
                d = body.vertex(ring + 1, side + 1);
      body.mesh.triangles.push_back({a, b, c});
      body.mesh.triangles.push_back({b, d, c});
    }
    body.mesh.triangles.push_back(
        {body.last(), body.vertex(shape.rings - 1, side), body.vertex(shape.rings - 1, side + 1)});
  }
  return body;
}

}  // namespace

TubeBody sphere_body() {
  return tube({"sphere", 21, 20, 0.1, 0.1, 0.1, 0.0, 0.5});
}

TubeBody muscle_body() {
  return tube({"muscle", 23, 18, 0.15, 0.04, 0.03, 0.02, 0.8});
}

TubeBody sheet_body() {
  return tube({"sheet", 23, 26, 0.12, 0.06, 0.004, 0.0, 0.5});
}

std::vector<TubeBody> dirty_bodies() {
  return {sphere_body(), muscle_body(), sheet_body()};
}

TriangleMesh torus_surface() {
  constexpr int kRound = 36, kAcross = 18;
  TriangleMesh torus;
  for (int i = 0; i < kRound; ++i) {
    for (int j = 0; j < kAcross; ++j) {
      const double u = 2.0 * std::numbers::pi * i / kRound, v = 2.0 * std::numbers::pi * j / kAcross;
      const double radius_m = 0.04 + 0.012 * std::cos(v);
      torus.positions_m.emplace_back(radius_m * std::cos(u), radius_m * std::sin(u), 0.012 * std::sin(v));
      const int a = i * kAcross + j, b = i * kAcross + (j + 1) % kAcross, c = (i + 1) % kRound * kAcross + j,
                d = (i + 1) % kRound * kAcross + (j + 1) % kAcross;
      torus.triangles.push_back({a, c, b});
      torus.triangles.push_back({b, c, d});
    }
  }
  return torus;
}

}  // namespace myotact::testing

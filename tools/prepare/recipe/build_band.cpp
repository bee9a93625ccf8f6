#include "prepare/recipe/build_band.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace myotact::prepare {

namespace {

constexpr int kRings = 12;
constexpr int kAround = 12;
/// The first and last ring are this part of the full size: rounded ends.
constexpr double kEnd = 0.6;

}  // namespace

geometry::TriangleMesh build_band(const BandData& band) {
  const Vec3 along = band.ends_m[1] - band.ends_m[0];
  const Vec3 across = along.cross(Vec3::UnitY().cross(along)).normalized();
  const Vec3 through = along.normalized().cross(across);
  geometry::TriangleMesh mesh;
  for (int ring = 0; ring < kRings; ++ring) {
    const double size = ring == 0 || ring == kRings - 1 ? kEnd : 1.0;
    const Vec3 centre = band.ends_m[0] + along * ring / (kRings - 1);
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kAround;
      mesh.positions_m.push_back(
          centre +
          0.5 * size * (band.width_m * std::cos(angle) * across + band.thickness_m * std::sin(angle) * through));
    }
  }
  const auto vertex = [](int ring, int i) { return ring * kAround + i % kAround; };
  for (int ring = 0; ring + 1 < kRings; ++ring) {
    for (int i = 0; i < kAround; ++i) {
      mesh.triangles.push_back({vertex(ring, i), vertex(ring, i + 1), vertex(ring + 1, i + 1)});
      mesh.triangles.push_back({vertex(ring, i), vertex(ring + 1, i + 1), vertex(ring + 1, i)});
    }
  }
  for (const int ring : {0, kRings - 1}) {
    const int middle = static_cast<int>(mesh.positions_m.size());
    mesh.positions_m.push_back(band.ends_m[ring == 0 ? 0 : 1]);
    for (int i = 0; i < kAround; ++i) {
      if (ring == 0)
        mesh.triangles.push_back({middle, vertex(ring, i + 1), vertex(ring, i)});
      else
        mesh.triangles.push_back({middle, vertex(ring, i), vertex(ring, i + 1)});
    }
  }
  return mesh;
}

}  // namespace myotact::prepare

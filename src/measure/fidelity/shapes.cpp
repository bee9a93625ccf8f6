#include "measure/fidelity/shapes.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "geometry/mesh_files.h"

namespace myotact::measure {

using geometry::TriangleMesh;

void swell(const TriangleMesh& ball, const Swelling& swelling, double time_s, std::vector<Vec3>& positions_m) {
  const double cycle = swelling.speed_m_s * time_s / (4.0 * swelling.amplitude_m) + swelling.phase;
  const double wave = 4.0 * std::abs(cycle - std::floor(cycle + 0.5)) - 1.0;
  for (std::size_t i = 0; i < positions_m.size(); ++i) {
    const Vec3& rest_m = ball.positions_m[i];
    const Vec3 way = rest_m.normalized();
    const double bump_m =
        swelling.bump_m * std::sin(9.0 * way.x() + 2.0 * wave) * std::sin(7.0 * way.y()) * std::cos(8.0 * way.z());
    positions_m[i] = rest_m + (swelling.amplitude_m * wave + bump_m) * way;
  }
}

std::vector<NamedShape> canine_shapes() {
  const char* folder = std::getenv("MYOTACT_CANINE_DIR");
  std::vector<NamedShape> shapes;
  if (folder == nullptr) return shapes;
  const std::array<std::pair<const char*, const char*>, 2> files = {
      {{"biceps", "forelimb_left/muscles/biceps_brachii.stl"},
       {"gastrocnemius", "hindlimb_left/muscles/gastrocnemius.stl"}}};
  for (const auto& [name, file] : files) {
    const std::filesystem::path path = std::filesystem::path(folder) / file;
    if (!std::filesystem::exists(path)) continue;
    TriangleMesh mesh = geometry::read_stl(path);
    shapes.push_back({name, std::move(mesh)});
  }
  return shapes;
}

}  // namespace myotact::measure

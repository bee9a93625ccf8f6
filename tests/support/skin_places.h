#pragma once

#include "anatomy/specimen.h"
#include "simulation/simulation.h"

namespace myotact::testing {

/// Middle of a triangle of a muscle's skin now, in the world [m].
inline Vec3 skin_centre_m(const simulation::Simulation& simulation, const anatomy::Specimen& specimen, int muscle,
                          int triangle) {
  Vec3 sum_m = Vec3::Zero();
  for (int v : specimen.muscles[static_cast<std::size_t>(muscle)].skin.triangles[static_cast<std::size_t>(triangle)]) {
    sum_m += simulation.skin_world_m(muscle)[static_cast<std::size_t>(v)];
  }
  return sum_m / 3.0;
}

/// The triangle whose middle is nearest to a place.
inline int skin_triangle_near(const simulation::Simulation& simulation, const anatomy::Specimen& specimen, int muscle,
                              const Vec3& place_m) {
  const int count = static_cast<int>(specimen.muscles[static_cast<std::size_t>(muscle)].skin.triangles.size());
  int best = 0;
  for (int t = 1; t < count; ++t) {
    const double here_m = (skin_centre_m(simulation, specimen, muscle, t) - place_m).norm();
    if (here_m < (skin_centre_m(simulation, specimen, muscle, best) - place_m).norm()) best = t;
  }
  return best;
}

/// A tool that presses on the middle of a triangle of a surface, through a spring to `target_m` (world).
inline messages::ToolState press_tool(int surface, int triangle, const Vec3& target_m, double stiffness_N_m) {
  messages::ToolState tool;
  tool.tool_position_world_m = tool.proxy_position_world_m = to_array(target_m);
  tool.contact.surface = surface;
  tool.contact.triangle = triangle;
  tool.contact.barycentric = {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};
  tool.contact.target_world_m = to_array(target_m);
  tool.contact.stiffness_N_m = stiffness_N_m;
  return tool;
}

}  // namespace myotact::testing

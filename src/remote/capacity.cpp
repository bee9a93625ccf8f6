#include "remote/capacity.h"

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "core/at.h"
#include "messages/tool_state.h"
#include "simulation/simulation.h"

namespace myotact::remote {

namespace {

constexpr double kDepth_m = 3e-3;        // as deep as a careful finger goes
constexpr double kCoupling_N_m = 400.0;  // of a page's pseudo-haptic hand
constexpr int kFirstSteps = 10;          // until what was woken has settled
constexpr int kTimedSteps = 21;          // .2 s: of their median one tenth is noise on a busy machine
/// A stride that comes to all sides of a muscle before it comes back (golden ratio of 2^32).
constexpr std::uint32_t kStride = 2654435769u;

std::vector<int> soft_muscles(const scene::Scene& scene) {
  std::vector<int> soft;
  const std::vector<simulation::TissueModel>& tissue = scene.settings.tissue;
  for (std::size_t m = 0; m < scene.specimen.muscles.size(); ++m) {
    const bool is_soft =
        tissue.empty() || tissue[m] == simulation::TissueModel::Fem || tissue[m] == simulation::TissueModel::MassSpring;
    if (is_soft) soft.push_back(static_cast<int>(m));
  }
  return soft;
}

/// A hand that presses into the middle of a triangle of a muscle, as it lies now.
messages::ToolState pressing(const scene::Scene& scene, const simulation::Simulation& simulation, int muscle,
                             std::uint32_t place) {
  const auto& triangles = scene.specimen.muscles[at(muscle)].skin.triangles;
  const std::size_t index = (static_cast<std::uint64_t>(place) * triangles.size()) >> 32;
  const std::array<int, 3>& corners = triangles[index];
  const std::span<const Vec3> skin_W_m = simulation.skin_world_m(muscle);
  const Vec3 a = skin_W_m[at(corners[0])], b = skin_W_m[at(corners[1])], c = skin_W_m[at(corners[2])];
  const Vec3 normal = (b - a).cross(c - a).normalized();
  const Vec3 target_W_m = (a + b + c) / 3.0 - kDepth_m * normal;
  messages::ToolState tool;
  tool.sequence = 1;
  tool.tool_position_world_m = tool.proxy_position_world_m = to_array(target_W_m);
  tool.contact = {muscle,
                  static_cast<std::int32_t>(index),
                  {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0},
                  to_array(normal),
                  to_array(target_W_m),
                  kCoupling_N_m};
  return tool;
}

/// Joints locked: what holds the posture in a session is not here, and a limb that falls takes longer steps.
void rest_at_start(const scene::Scene& scene, simulation::Simulation& simulation) {
  std::vector<double> angles_rad;
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    angles_rad.push_back(scene.joints[j].angle_rad);
    simulation.set_joint_locked(static_cast<int>(j), true);
  }
  simulation.settle(angles_rad, scene.activations);
}

double median_step_s(simulation::Simulation& simulation, const std::vector<messages::ToolState>& tools) {
  for (int i = 0; i < kFirstSteps; ++i) simulation.step(tools);
  std::vector<double> taken_s;
  for (int i = 0; i < kTimedSteps; ++i) {
    const auto start = std::chrono::steady_clock::now();
    simulation.step(tools);
    taken_s.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(taken_s.begin(), taken_s.begin() + kTimedSteps / 2, taken_s.end());
  return taken_s[kTimedSteps / 2];
}

}  // namespace

std::vector<LoadedStep> measure_load(const scene::Scene& scene, double allowed_s, std::size_t most) {
  const std::vector<int> soft = soft_muscles(scene);
  if (soft.empty()) return {};
  simulation::Simulation simulation(scene.specimen, scene.settings);
  rest_at_start(scene, simulation);
  std::vector<messages::ToolState> tools;
  std::vector<LoadedStep> load = {{0, median_step_s(simulation, tools)}};
  for (std::size_t hands = 1; load.back().step_s <= allowed_s; hands *= 2) {
    hands = std::min(hands, most);
    while (tools.size() < hands) {
      const auto number = static_cast<std::uint32_t>(tools.size());
      tools.push_back(pressing(scene, simulation, soft[number % soft.size()], number * kStride));
    }
    load.push_back({hands, median_step_s(simulation, tools)});
    if (hands == most) break;
  }
  return load;
}

std::size_t hands_borne(const std::vector<LoadedStep>& load, double allowed_s, std::size_t most) {
  for (std::size_t i = 0; i < load.size(); ++i) {
    if (load[i].step_s <= allowed_s) continue;
    if (i == 0) return 0;
    const LoadedStep &fits = load[i - 1], &exceeds = load[i];
    const double part = (allowed_s - fits.step_s) / (exceeds.step_s - fits.step_s);
    return fits.hands + static_cast<std::size_t>(part * static_cast<double>(exceeds.hands - fits.hands));
  }
  return most;
}

}  // namespace myotact::remote

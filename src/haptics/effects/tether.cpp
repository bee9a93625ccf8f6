#include "haptics/effects/tether.h"

#include <algorithm>

namespace myotact::haptics {

Vec3 TetherSpring::force_N(const Vec3& hand_m) const noexcept {
  const Vec3 linear_N = stiffness_N_m * (anchor_m - hand_m);
  const double size_N = linear_N.norm();
  return size_N > most_N ? Vec3(most_N / size_N * linear_N) : linear_N;
}

double TetherSpring::energy_J(const Vec3& hand_m) const noexcept {
  if (!(stiffness_N_m > 0.0)) return 0.0;
  const double stretch_m = (anchor_m - hand_m).norm();
  const double linear_m = std::min(stretch_m, most_N / stiffness_N_m);
  return stiffness_N_m * linear_m * (stretch_m - 0.5 * linear_m);
}

Vec3 tether_anchor_m(const messages::LocalModel& model, std::uint64_t now_ns) noexcept {
  const std::uint64_t since_ns = now_ns > model.published_at_ns ? now_ns - model.published_at_ns : 0;
  const double ahead_s = 1e-9 * static_cast<double>(std::min(since_ns, 2 * model.dt_ns));
  const messages::LocalTether& tether = model.tether;
  return to_vec3(tether.anchor_world_m) + ahead_s * to_vec3(tether.anchor_velocity_world_m_s);
}

}  // namespace myotact::haptics

#pragma once

#include <array>
#include <cstdint>

#include "core/vector.h"
#include "messages/local_model.h"

namespace myotact::haptics {

struct PullingSettings {
  double stiffness_N_m = 800.0;  // of the spring as the hand feels it, that is after the force scale
  double force_scale = 1.0;      // felt over simulated force
};

/// C (Choi et al. 2011): a spring between the tool H and the body in hand,  F = k0 (p_S - p_H).
///
/// S is the point of the body that was at the tool when the hand closed: the nearest point that the engine knows
/// (LocalGrip), and from there as far as it was to the tool. Its place is the newest one that the engine published,
/// held until the next: nothing is extrapolated, so the age of the model feels like viscous drag. The engine gets
/// the same spring, as from BoneDrag. No damping, no ramp. Real-time safe; one thread.
class PullingMethod {
 public:
  explicit PullingMethod(const PullingSettings& settings);

  /// Force on the hand [N], scaled, of at most `peak_N`. `model`: the newest, null: none. `holds`: the bone button.
  Vec3 tick(const messages::LocalModel* model, const Vec3& tool_m, bool holds, double peak_N) noexcept;

  // ---- as BoneDrag reports it
  std::int32_t body() const noexcept { return body_; }
  const std::array<double, 3>& point_rest_m() const noexcept { return point_rest_m_; }
  double gain() const noexcept { return gain_; }
  double stiffness_N_m() const noexcept { return gain_ * settings_.stiffness_N_m * to_simulated_; }
  const Vec3& target_m() const noexcept { return target_m_; }

 private:
  PullingSettings settings_;
  double to_simulated_;  // by which a felt stiffness or force becomes one of the simulation
  bool held_before_ = false;
  double gain_ = 0.0;
  std::int32_t body_ = -1;
  std::array<double, 3> point_rest_m_{};
  Vec3 offset_m_ = Vec3::Zero();  // from the engine's point to S
  Vec3 point_m_ = Vec3::Zero();   // newest of the engine's point
  Vec3 target_m_ = Vec3::Zero();
};

}  // namespace myotact::haptics

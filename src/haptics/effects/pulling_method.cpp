#include "haptics/effects/pulling_method.h"

#include <algorithm>

namespace myotact::haptics {

namespace {

/// Below this force scale the spring in the simulation grows no stiffer: it takes no spring above 1 MN/m.
constexpr double kSmallestScale = 1e-3;

}  // namespace

PullingMethod::PullingMethod(const PullingSettings& settings)
    : settings_(settings), to_simulated_(1.0 / std::max(settings.force_scale, kSmallestScale)) {}

Vec3 PullingMethod::tick(const messages::LocalModel* model, const Vec3& tool_m, bool holds, double peak_N) noexcept {
  const bool knows = model != nullptr && model->grip.body >= 0;
  if (holds && !held_before_ && knows) {
    body_ = model->grip.body;
    point_rest_m_ = model->grip.point_rest_m;
    offset_m_ = tool_m - to_vec3(model->grip.position_world_m);
  }
  held_before_ = holds;
  if (!holds && gain_ <= 0.0) body_ = -1;  // the tick that lets go still names the body: its port gives up the spring
  gain_ = holds && body_ >= 0 ? 1.0 : 0.0;
  if (gain_ <= 0.0) return Vec3::Zero();
  const bool same = knows && model->grip.body == body_ && model->grip.point_rest_m == point_rest_m_;
  if (same) point_m_ = to_vec3(model->grip.position_world_m);
  Vec3 on_hand_N = settings_.stiffness_N_m * (point_m_ + offset_m_ - tool_m);
  if (on_hand_N.norm() > peak_N) on_hand_N *= peak_N / on_hand_N.norm();
  target_m_ = point_m_;
  if (settings_.stiffness_N_m > 0.0) target_m_ -= on_hand_N / settings_.stiffness_N_m;
  return on_hand_N * (settings_.force_scale * to_simulated_);
}

}  // namespace myotact::haptics

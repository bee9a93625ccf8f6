#include "haptics/effects/bone_drag.h"

#include <algorithm>

#include <Eigen/LU>

namespace myotact::haptics {

namespace {

constexpr double kRamp_s = 0.1;  // as for a muscle line
constexpr double kPositionShare = 0.5;
constexpr double kVelocityShare = 0.1;
/// Below this force scale the grip in the simulation grows no stiffer: it takes no spring above 1 MN/m.
constexpr double kSmallestScale = 1e-3;

Mat3 from_rows(const std::array<double, 9>& rows) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.data());
}

}  // namespace

BoneDrag::BoneDrag(const BoneDragSettings& settings)
    : settings_(settings), to_simulated_(1.0 / std::max(settings.force_scale, kSmallestScale)) {}

double BoneDrag::stiffness_N_m() const noexcept {
  return body_ < 0 ? 0.0 : gain_ * settings_.stiffness_N_m * to_simulated_;
}

Vec3 BoneDrag::tick(const messages::LocalModel* model, bool is_new, const Tool& tool, double dt_s) noexcept {
  const bool grabs = tool.holds && !held_before_ && body_ < 0 && model != nullptr && model->grip.body >= 0;
  held_before_ = tool.holds;
  if (grabs) grab(model->grip, tool);
  if (body_ < 0) return Vec3::Zero();
  gain_ = std::clamp(gain_ + (tool.holds ? dt_s : -dt_s) / kRamp_s, 0.0, 1.0);
  if (gain_ <= 0.0) {
    body_ = -1;
    return Vec3::Zero();
  }
  if (is_new && !grabs) correct(*model, tool, dt_s);
  return -settings_.force_scale * advance(tool, dt_s);
}

void BoneDrag::grab(const messages::LocalGrip& grip, const Tool& tool) noexcept {
  body_ = grip.body;
  grip_ = grip;
  gain_ = 0.0;
  point_ = {to_vec3(grip.position_world_m), to_vec3(grip.velocity_world_m_s)};
  offset_m_ = tool.position_m - point_.position_m;
  first_kept_ = tool.sequence;
  unplayed_m_ = played_a_tick_m_ = Vec3::Zero();
}

void BoneDrag::correct(const messages::LocalModel& model, const Tool& tool, double dt_s) noexcept {
  const messages::LocalGrip& grip = model.grip;
  if (grip.body != body_ || grip.point_rest_m != grip_.point_rest_m) return;
  grip_ = grip;
  const bool known = model.tool_sequence >= first_kept_ && model.tool_sequence < tool.sequence &&
                     tool.sequence - model.tool_sequence < kTicksKept;
  if (!known) return;
  const Motion then = kept(model.tool_sequence);
  const Vec3 moved_m = kPositionShare * (to_vec3(grip.position_world_m) - then.position_m);
  const Vec3 sped_m_s = kVelocityShare * (to_vec3(grip.velocity_world_m_s) - then.velocity_m_s);
  // What was here since then gets the same correction: the next model must not find this error again.
  Vec3 shift_m = moved_m;
  for (std::uint64_t at = model.tool_sequence; at < tool.sequence; ++at) {
    shift_m = moved_m + static_cast<double>(at - model.tool_sequence) * dt_s * sped_m_s;
    kept(at).position_m += shift_m;
    kept(at).velocity_m_s += sped_m_s;
  }
  point_.position_m += shift_m;
  point_.velocity_m_s += sped_m_s;
  unplayed_m_ += shift_m;
  const double step_s = std::max(dt_s, 1e-9 * static_cast<double>(model.dt_ns));
  played_a_tick_m_ = unplayed_m_ * (dt_s / step_s);
}

/// One implicit step of the point under the grip; returns the force on it, unscaled:
///   v = v0 + h (a + W (f - f_model) - S (x - x_model) - D (v - v_model)), x = x0 + h v
///   f = k (hand - offset - x - unplayed) + b (v_hand - v), then cut to the peak
Vec3 BoneDrag::advance(const Tool& tool, double dt_s) noexcept {
  const bool plays = unplayed_m_.squaredNorm() > played_a_tick_m_.squaredNorm();
  unplayed_m_ = plays ? Vec3(unplayed_m_ - played_a_tick_m_) : Vec3::Zero();
  const double k = stiffness_N_m();
  const double b = gain_ * settings_.damping_Ns_m * to_simulated_;
  const Mat3 mobility = from_rows(grip_.mobility_1_kg);
  const Mat3 stiffness = from_rows(grip_.stiffness_1_s2);
  const Mat3 damping = from_rows(grip_.damping_1_s);
  const Vec3 slack_m =
      tool.position_m - offset_m_ - (point_.position_m - unplayed_m_);  // where the point felt would be slack
  const Vec3 free_m_s =
      point_.velocity_m_s + dt_s * (to_vec3(grip_.acceleration_world_m_s2) - mobility * to_vec3(grip_.force_world_N) -
                                    stiffness * (point_.position_m - to_vec3(grip_.position_world_m)) +
                                    damping * to_vec3(grip_.velocity_world_m_s));
  const Mat3 limb = Mat3::Identity() + dt_s * dt_s * stiffness + dt_s * damping;
  const Mat3 coupled = limb + dt_s * (dt_s * k + b) * mobility;
  Vec3 velocity_m_s = coupled.inverse() * (free_m_s + dt_s * mobility * (k * slack_m + b * tool.velocity_m_s));
  Vec3 force_N = k * (slack_m - dt_s * velocity_m_s) + b * (tool.velocity_m_s - velocity_m_s);
  const double most_N = tool.peak_N * to_simulated_;
  if (force_N.norm() > most_N) {
    force_N *= most_N / force_N.norm();
    velocity_m_s = limb.inverse() * (free_m_s + dt_s * mobility * force_N);
  }
  point_.velocity_m_s = velocity_m_s;
  point_.position_m += dt_s * velocity_m_s;
  kept(tool.sequence) = point_;
  target_m_ = point_.position_m - unplayed_m_ + force_N / k;
  return force_N;
}

}  // namespace myotact::haptics

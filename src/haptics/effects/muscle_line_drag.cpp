#include "haptics/effects/muscle_line_drag.h"

#include <algorithm>

namespace myotact::haptics {

namespace {

constexpr double kRamp_s = 0.1;  // below what a hand perceives as delay, long enough not to kick

}  // namespace

Vec3 MuscleLineDrag::tick(const messages::LocalLine& line, const Tool& tool, double dt_s) noexcept {
  const bool grabs = tool.holds && !held_before_ && line.muscle >= 0;
  held_before_ = tool.holds;
  if (grabs) {
    muscle_ = line.muscle;
    fraction_ = line.fraction;
    gain_ = 0.0;
    line_ = line;
  }
  if (!tool.holds) muscle_ = -1;
  if (muscle_ >= 0 && line.muscle == muscle_) line_ = line;
  gain_ = std::clamp(gain_ + (muscle_ >= 0 ? dt_s : -dt_s) / kRamp_s, 0.0, 1.0);
  tension_N_ = 0.0;
  if (gain_ <= 0.0) return Vec3::Zero();

  const Vec3 to_proximal_m = to_vec3(line_.proximal_point_world_m) - tool.position_m;
  const Vec3 to_distal_m = to_vec3(line_.distal_point_world_m) - tool.position_m;
  const Vec3 along = to_proximal_m.normalized() + to_distal_m.normalized();  // Eigen keeps a zero vector zero
  const double length_m = to_proximal_m.norm() + to_distal_m.norm();
  const double lengthening_m_s = -along.dot(tool.velocity_m_s);
  tension_N_ = std::clamp(
      line_.tension_N + line_.stiffness_N_m * (length_m - line_.length_m) + line_.damping_Ns_m * lengthening_m_s, 0.0,
      settings_.max_tension_N);
  return gain_ * tension_N_ * along;
}

}  // namespace myotact::haptics

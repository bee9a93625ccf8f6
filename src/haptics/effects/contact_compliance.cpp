#include "haptics/effects/contact_compliance.h"

#include <algorithm>

namespace myotact::haptics {

namespace {

/// Stiffest coupling, where the tissue gives way enough for the device: tissue of 1000 N/m then reads 3 % soft. Twice
/// that makes the encoder's 20 um felt on stiff tissue (measured: 30 instead of 20 mN), half of it doubles the error.
constexpr double kLargestCoupling_N_m = 3e4;
/// No tissue gives way more in a step: 5 N would move it by half a metre. A model with more is invalid.
constexpr double kLargestCompliance_m_N = 0.1;

/// Part of the way to the model's numbers that a tick goes: all of them are reached when the model is played.
double share_of_tick(const messages::LocalModel& model, std::uint64_t now_ns, double dt_s) {
  const double age_s =
      now_ns <= model.published_at_ns ? 0.0 : 1e-9 * static_cast<double>(now_ns - model.published_at_ns);
  const double left_s = 1e-9 * static_cast<double>(model.dt_ns) - age_s + dt_s;
  return left_s > dt_s ? dt_s / left_s : 1.0;
}

double along(const Vec3& normal, const std::array<double, 9>& rows) {
  const Mat3 compliance = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.data());
  return std::clamp(normal.dot(compliance * normal), 0.0, kLargestCompliance_m_N);
}

bool rests_on(const ProxyContact& touching, std::int32_t surface) {
  return touching.surface == surface || std::any_of(touching.beside.begin(), touching.beside.end(),
                                                    [&](const ProxyNeighbour& b) { return b.surface == surface; });
}

/// Used in place of 0, so that nothing is divided by 0: a millimetre gives 1 uN.
constexpr double kLeastStiffness_N_m = 1e-3;

}  // namespace

void ContactCompliance::tick(const messages::LocalModel& model, const ProxyContact& touching, std::uint64_t now_ns,
                             double dt_s) noexcept {
  const messages::LocalContact& known = model.contact;
  const bool elsewhere = touching.active && !(known.surface >= 0 && rests_on(touching, known.surface));
  double compliance_m_N = compliance_m_N_;  // kept after the contact: the next touch of the same tissue finds it
  Vec3 used_N = Vec3::Zero();
  if (elsewhere && touching.surface != surface_) {
    compliance_m_N = 0.0;
    if (compliance_m_N_ == 0.0) surface_ = touching.surface;
  } else if (!elsewhere && known.surface >= 0) {
    used_N = to_vec3(known.force_world_N);
    if (touching.active) {
      surface_ = known.surface;
      compliance_m_N = along(touching.normal, known.compliance_m_N);
    }
  }
  const double share = share_of_tick(model, now_ns, dt_s);
  compliance_m_N_ += share * (compliance_m_N - compliance_m_N_);
  used_N_ += share * (used_N - used_N_);
}

void ContactCompliance::limit_stiffness(double stiffness_N_m) noexcept {
  stiffness_N_m_ = std::max(stiffness_N_m, kLeastStiffness_N_m);
}

void ContactCompliance::forget() noexcept {
  surface_ = -1;
  compliance_m_N_ = 0.0;
  used_N_ = Vec3::Zero();
}

double ContactCompliance::coupling_stiffness_N_m() const noexcept {
  return 1.0 / std::max(1.0 / stiffness_N_m_ - compliance_m_N_, 1.0 / std::max(kLargestCoupling_N_m, stiffness_N_m_));
}

double ContactCompliance::felt_stiffness_N_m() const noexcept {
  return 1.0 / (1.0 / coupling_stiffness_N_m() + compliance_m_N_);
}

}  // namespace myotact::haptics

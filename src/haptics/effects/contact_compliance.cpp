#include "haptics/effects/contact_compliance.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace myotact::haptics {

namespace {

/// Stiffest coupling, where the tissue gives way enough for the device: tissue of 1000 N/m then reads 3 % soft. Twice
/// that makes the encoder's 20 um felt on stiff tissue (measured: 30 instead of 20 mN), half of it doubles the error.
constexpr double kLargestCoupling_N_m = 3e4;
/// Softer tissue is taken as soft as this for the length of a step [m/N]. Tissue about to fold has next to no stiffness
/// in the linear solve (1.7 m/N were seen where 3 mm/N came before and after), and would not move by a tenth of that.
/// The long muscles of a whole limb have 5 to 15 mm/N: with 3 they felt up to four times too firm, with 30 a hand on
/// the elbow's brachialis swings.
constexpr double kLargestCompliance_m_N = 10e-3;
/// The room beside a sphere changes with the surfaces; slower, the coupling would be too stiff on a bone that a step
/// reached, faster it would follow every hop of the sphere.
constexpr double kRoom_s = 0.01;

/// Room that comes back and tissue that becomes softer make the coupling stiffer within this time. Both vary by a tenth
/// from one step to the next under a still hand, near a second muscle or where tissue buckles; a coupling that followed
/// at once made the force, and with it the dent, swing by 40 to 140 mN at 30 Hz.
constexpr double kStiffens_s = 0.3;
/// A touch is younger than this while the first steps tell of it [s], five at 62.5 Hz, one of them late: tissue that
/// nobody foretold becomes as soft as it is at once.
constexpr double kYoung_s = 0.1;

/// Used in place of 0, so that nothing is divided by 0: a millionth of what any tissue has.
constexpr double kLeastRoom_m_N = 1e-12;

/// Part of the way to the model's numbers that a tick goes: all of them are reached when the model is played.
double share_of_tick(const messages::LocalModel& model, std::uint64_t now_ns, double dt_s) {
  const double age_s =
      now_ns <= model.published_at_ns ? 0.0 : 1e-9 * static_cast<double>(now_ns - model.published_at_ns);
  const double left_s = 1e-9 * static_cast<double>(model.dt_ns) - age_s + dt_s;
  return left_s > dt_s ? dt_s / left_s : 1.0;
}

/// A symmetric matrix: along each of three directions.
struct Directions {
  Vec3 values;
  Mat3 vectors;
};

/// Closed form: nothing iterates. The values are brought to between `least` and `most`.
Directions bounded_directions(const Mat3& symmetric, double least, double most) {
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(symmetric);
  return {solver.eigenvalues().cwiseMax(least).cwiseMin(most), solver.eigenvectors()};
}

Mat3 matrix_of(const Directions& directions) {
  return directions.vectors * directions.values.asDiagonal() * directions.vectors.transpose();
}

/// Of a model, whatever it says.
Mat3 sound_compliance(const std::array<double, 9>& rows) {
  constexpr double kBeyondReason_m_N = 1e3;  // the square of more might overflow
  const Mat3 given = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.data())
                         .cwiseMax(-kBeyondReason_m_N)
                         .cwiseMin(kBeyondReason_m_N);
  return matrix_of(bounded_directions(0.5 * (given + given.transpose()), 0.0, kLargestCompliance_m_N));
}

/// A compliance that is `across_m_N` along the normal and nowhere more than `most_m_N`: along the surface each
/// direction is bounded, and what joins the two is kept as far as there is room,
///
///   most - C >= 0   <=>   (most - c) (most - T) >= x x^T,   c across, T along the surface, x what joins
Mat3 with_room(const Mat3& compliance_m_N, const Vec3& normal, double across_m_N, double most_m_N) {
  const Mat3 tangential = Mat3::Identity() - normal * normal.transpose();
  const Vec3 joining_m_N = tangential * compliance_m_N * normal;
  const Directions along_m_N = bounded_directions(tangential * compliance_m_N * tangential, 0.0, most_m_N);
  double needed_m_N = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double part_m_N = along_m_N.vectors.col(i).dot(joining_m_N);
    needed_m_N += part_m_N * part_m_N / std::max(most_m_N - along_m_N.values[i], kLeastRoom_m_N);
  }
  const double room_m_N = std::max(0.0, most_m_N - across_m_N);
  const double kept = needed_m_N > room_m_N ? std::sqrt(room_m_N / needed_m_N) : 1.0;
  const Mat3 joined_m_N = joining_m_N * normal.transpose();
  return across_m_N * normal * normal.transpose() + matrix_of(along_m_N) + kept * (joined_m_N + joined_m_N.transpose());
}

bool rests_on(const ProxyContact& touching, std::int32_t surface) {
  return touching.surface == surface || std::any_of(touching.beside.begin(), touching.beside.end(),
                                                    [&](const ProxyNeighbour& b) { return b.surface == surface; });
}

/// Gap to the nearest other surface, over what counts as beside. The other side of a dent is the same tissue.
double room_beside(const ProxyContact& touching) {
  double room = 1.0;
  for (const ProxyNeighbour& near : touching.beside) {
    if (near.surface >= 0 && near.surface != touching.surface) room = std::min(room, near.gap_m / kBeside_m);
  }
  return room;
}

/// Used in place of 0, so that nothing is divided by 0: a millimetre gives 1 uN.
constexpr double kLeastStiffness_N_m = 1e-3;

}  // namespace

void ContactCompliance::tick(const messages::LocalModel& model, const ProxyContact& touching, std::uint64_t now_ns,
                             double dt_s) noexcept {
  const messages::LocalContact& known = model.contact;
  const bool elsewhere = touching.active && !(known.surface >= 0 && rests_on(touching, known.surface));
  Mat3 compliance_m_N = compliance_m_N_;  // kept where nothing else is known: the next touch of that tissue finds it
  double normal_m_N = normal_m_N_;
  Vec3 used_N = Vec3::Zero();
  if (elsewhere && touching.surface != surface_) {
    compliance_m_N.setZero();
    normal_m_N = 0.0;
    if (compliance_m_N_.isZero(0.0)) surface_ = touching.surface;
  } else if (!elsewhere && known.surface >= 0) {
    used_N = to_vec3(known.force_world_N);
    surface_ = known.surface;
    if (known.compliance_m_N != model_rows_) {  // else it was said before: once a model, not once a tick
      model_rows_ = known.compliance_m_N;
      model_m_N_ = sound_compliance(model_rows_);
    }
    compliance_m_N = model_m_N_;
    normal_m_N = touching.active ? touching.normal.dot(compliance_m_N * touching.normal) : compliance_m_N.trace() / 3.0;
  }
  const double share = share_of_tick(model, now_ns, dt_s);
  const double known_share = touched_s_ > 0.0 ? share : 1.0;  // what is not felt may change at once
  const double stiffens_share = touched_s_ < kYoung_s ? 1.0 : std::min(1.0, dt_s / kStiffens_s);
  touched_s_ = touching.active ? touched_s_ + dt_s : 0.0;
  const double room = room_beside(touching);
  room_ += std::min(dt_s / kRoom_s, room > room_ ? stiffens_share : 1.0) * (room - room_);
  compliance_m_N_ += known_share * (compliance_m_N - compliance_m_N_);
  normal_m_N_ += known_share * (normal_m_N - normal_m_N_);
  sure_m_N_ += (normal_m_N_ > sure_m_N_ ? stiffens_share : 1.0) * (normal_m_N_ - sure_m_N_);
  const Vec3 change_N = share * (used_N - used_N_);
  unloaded_moved_m_ = -given_m_N_ * change_N;
  used_N_ += change_N;
  if (touching.active) normal_ = touching.normal;
  const double most_m_N = 1.0 / felt_stiffness_N_m() - 1.0 / stiffest_N_m();
  given_m_N_ = with_room(compliance_m_N_, normal_, normal_m_N_, most_m_N);
}

void ContactCompliance::limit_stiffness(double stiffness_N_m) noexcept {
  stiffness_N_m_ = std::max(stiffness_N_m, kLeastStiffness_N_m);
}

void ContactCompliance::forget() noexcept {
  surface_ = -1;
  compliance_m_N_ = given_m_N_ = Mat3::Zero();
  normal_m_N_ = sure_m_N_ = 0.0;
  room_ = 1.0;
  used_N_ = unloaded_moved_m_ = Vec3::Zero();
  touched_s_ = 0.0;
}

double ContactCompliance::stiffest_N_m() const noexcept {
  return std::max(kLargestCoupling_N_m, stiffness_N_m_);
}

double ContactCompliance::coupling_stiffness_N_m() const noexcept {
  const double device_m_N = 1.0 / stiffness_N_m_;
  const double hidden_m_N = std::max(device_m_N - sure_m_N_, 1.0 / stiffest_N_m());
  return 1.0 / (room_ * hidden_m_N + (1.0 - room_) * device_m_N);
}

double ContactCompliance::softness() const noexcept {
  constexpr double kUsualDevice_m_N = 1.0 / 800.0;  // coupling that most devices can render
  return normal_m_N_ / (normal_m_N_ + kUsualDevice_m_N);
}

double ContactCompliance::felt_stiffness_N_m() const noexcept {
  return 1.0 / (1.0 / coupling_stiffness_N_m() + normal_m_N_);
}

}  // namespace myotact::haptics

#include "measure/joint_response.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <unsupported/Eigen/MatrixFunctions>

namespace myotact::measure {
namespace {

/// Fibres that settle faster than this are always in balance with their tendon; a passive muscle's have no damping.
constexpr double kAtOnce_s = 1e-7;

}  // namespace

void add_muscle(double r_m, double dr_dq_m, const simulation::HillForce& force, JointResponse& response) {
  response.stiffness_Nm_rad -= dr_dq_m * force.force_N;
  const double both_N_m = force.fibre_stiffness_N_m + force.tendon_stiffness_N_m;
  if (std::isinf(force.tendon_stiffness_N_m)) {
    response.stiffness_Nm_rad += r_m * r_m * force.stiffness_N_m;
    response.damping_Nms_rad += r_m * r_m * force.fibre_damping_Ns_m;
  } else if (force.fibre_damping_Ns_m <= kAtOnce_s * std::abs(both_N_m)) {
    response.stiffness_Nm_rad += r_m * r_m * force.stiffness_N_m;
  } else {
    response.stiffness_Nm_rad += r_m * r_m * force.tendon_stiffness_N_m;
    response.fibres.push_back({r_m, force.fibre_stiffness_N_m, force.tendon_stiffness_N_m, force.fibre_damping_Ns_m});
  }
}

// A tendon's pull changes by kt (-r dq - dx).
Eigen::MatrixXd rates_1_s(const JointResponse& response) {
  const auto n = static_cast<Eigen::Index>(response.fibres.size());
  Eigen::MatrixXd rates = Eigen::MatrixXd::Zero(n + 2, n + 2);
  rates(0, 1) = 1.0;
  rates(1, 0) = -response.stiffness_Nm_rad / response.inertia_kg_m2;
  rates(1, 1) = -response.damping_Nms_rad / response.inertia_kg_m2;
  for (Eigen::Index i = 0; i < n; ++i) {
    const SlowFibre& fibre = response.fibres[static_cast<std::size_t>(i)];
    rates(1, i + 2) = -fibre.arm_m * fibre.kt_N_m / response.inertia_kg_m2;
    rates(i + 2, 0) = -fibre.arm_m * fibre.kt_N_m / fibre.bm_Ns_m;
    rates(i + 2, i + 2) = -(fibre.km_N_m + fibre.kt_N_m) / fibre.bm_Ns_m;
  }
  return rates;
}

JointMode mode_of(const JointResponse& response) {
  const Eigen::MatrixXd rates = rates_1_s(response);
  if (!rates.allFinite()) return {0.0, std::nan("")};
  const Eigen::VectorXcd roots = Eigen::EigenSolver<Eigen::MatrixXd>(rates, false).eigenvalues();
  JointMode mode;
  for (const std::complex<double>& root : roots) {
    const double ratio = -root.real() / std::abs(root);
    if (!(ratio < mode.damping_ratio)) continue;  // real and falling: 1
    mode = {std::abs(root.imag()) / (2.0 * std::numbers::pi), ratio};
  }
  return mode;
}

// The torque is one more number of the state, which does not change by itself.
std::vector<double> struck_angles_rad(const JointResponse& response, const Stroke& stroke, std::size_t steps) {
  const Eigen::MatrixXd rates = rates_1_s(response);
  const Eigen::Index n = rates.rows();
  Eigen::MatrixXd with_torque = Eigen::MatrixXd::Zero(n + 1, n + 1);
  with_torque.topLeftCorner(n, n) = rates;
  with_torque(1, n) = 1.0 / response.inertia_kg_m2;
  const Eigen::MatrixXd over_a_step = (with_torque * stroke.dt_s).exp();
  Eigen::VectorXd now = Eigen::VectorXd::Zero(n + 1);
  std::vector<double> angles_rad;
  for (std::size_t i = 0; i < steps; ++i) {
    angles_rad.push_back(now[0]);
    now[n] = (static_cast<double>(i) + 0.5) * stroke.dt_s < stroke.duration_s ? stroke.torque_Nm : 0.0;
    now = over_a_step * now;
  }
  return angles_rad;
}

}  // namespace myotact::measure

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <Eigen/Eigenvalues>

#include "measure/line/line_joint.h"

namespace myotact::measure {
namespace {

/// Fibres whose reach x moves by itself: bm dx/dt = kt (dL - dx) - km dx.
struct SlowFibre {
  double arm_m, km_N_m, kt_N_m, bm_Ns_m;
};

/// Fibres that settle faster than this are always in balance with their tendon; a passive muscle's have no damping.
constexpr double kAtOnce_s = 1e-7;

/// What of a joint answers at once, and what does not.
struct Response {
  double stiffness_Nm_rad = 0.0, damping_Nms_rad = 0.0;
  std::vector<SlowFibre> fibres;
};

Response response_of(const LineJointState& state) {
  Response response;
  for (const LineMuscleState& muscle : state.muscles) {
    const double r_m = muscle.path.arm_m;
    const simulation::HillForce& force = muscle.force;
    response.stiffness_Nm_rad -= muscle.path.arm_slope_m_rad * force.force_N;
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
  return response;
}

}  // namespace

// A tendon's pull changes by kt (-r dq - dx).
Eigen::MatrixXd line_joint_rates(const LineJoint& joint, const LineJointState& state) {
  const Response response = response_of(state);
  const auto n = static_cast<Eigen::Index>(response.fibres.size());
  Eigen::MatrixXd rates = Eigen::MatrixXd::Zero(n + 2, n + 2);
  rates(0, 1) = 1.0;
  rates(1, 0) = -response.stiffness_Nm_rad / joint.inertia_kg_m2;
  rates(1, 1) = -response.damping_Nms_rad / joint.inertia_kg_m2;
  for (Eigen::Index i = 0; i < n; ++i) {
    const SlowFibre& fibre = response.fibres[static_cast<std::size_t>(i)];
    rates(1, i + 2) = -fibre.arm_m * fibre.kt_N_m / joint.inertia_kg_m2;
    rates(i + 2, 0) = -fibre.arm_m * fibre.kt_N_m / fibre.bm_Ns_m;
    rates(i + 2, i + 2) = -(fibre.km_N_m + fibre.kt_N_m) / fibre.bm_Ns_m;
  }
  return rates;
}

LineMode line_joint_mode(const LineJoint& joint, const LineJointState& state) {
  const Eigen::MatrixXd rates = line_joint_rates(joint, state);
  if (!rates.allFinite()) return {0.0, std::nan("")};
  const Eigen::VectorXcd roots = Eigen::EigenSolver<Eigen::MatrixXd>(rates, false).eigenvalues();
  LineMode mode;
  for (const std::complex<double>& root : roots) {
    const double ratio = -root.real() / std::abs(root);
    if (!(ratio < mode.damping_ratio)) continue;  // real and falling: 1
    mode = {std::abs(root.imag()) / (2.0 * std::numbers::pi), ratio};
  }
  return mode;
}

}  // namespace myotact::measure

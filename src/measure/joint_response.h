#pragma once

#include <vector>

#include <Eigen/Core>

#include "simulation/line/hill_muscle.h"

namespace myotact::measure {

/// Fibres whose reach x moves by itself behind an elastic tendon: bm dx/dt = kt (dL - dx) - km dx.
struct SlowFibre {
  double arm_m = 0.0, km_N_m = 0.0, kt_N_m = 0.0, bm_Ns_m = 0.0;
};

/// A joint made linear about a state of rest, activations held: what answers at once, and what does not.
struct JointResponse {
  double inertia_kg_m2 = 0.0;
  double stiffness_Nm_rad = 0.0, damping_Nms_rad = 0.0;
  std::vector<SlowFibre> fibres;
};

/// Adds a muscle whose moment arm is r [m, positive flexes] and changes by dr/dq [m/rad].
void add_muscle(double r_m, double dr_dq_m, const simulation::HillForce& force, JointResponse& response);

/// Rates of (angle, angular velocity, reach of each slow fibre), size 2 + fibres.
Eigen::MatrixXd rates_1_s(const JointResponse& response);

/// How the joint swings back after a nudge.
struct JointMode {
  double frequency_hz = 0.0;   // 0 when it does not oscillate
  double damping_ratio = 1.0;  // 1 when it creeps back, negative when it runs away
};

/// From the eigenvalues of the rates: of several oscillations the one of least damping ratio.
JointMode mode_of(const JointResponse& response);

/// A torque that is constant for a while and then none.
struct Stroke {
  double torque_Nm = 0.0;
  double duration_s = 0.0;  // a multiple of dt_s
  double dt_s = 0.0;
};

/// Angle at the start and after each of `steps` - 1 steps of a joint struck at rest; exact in time.
std::vector<double> struck_angles_rad(const JointResponse& response, const Stroke& stroke, std::size_t steps);

}  // namespace myotact::measure

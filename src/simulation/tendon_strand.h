#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "anatomy/specimen.h"
#include "core/vector.h"
#include "simulation/skeleton.h"

namespace myotact::simulation {

/// The load-bearing part of a tendon as a one-dimensional elastic string: from the weighted mean p of the belly's end
/// nodes over points and surfaces on bodies to the bone. A string has true lever arms and no bending stiffness; tendon
/// tets of 1 GPa would lock in bending and spoil the solve.
struct TendonStrand {
  struct BodyPoint {
    int body = -1;
    Vec3 rest_m = Vec3::Zero();
    std::optional<anatomy::LineWrap> wrap = std::nullopt;  // the surface on the way here
  };
  std::vector<int> nodes;         // of the muscle's mesh, on the border between belly and tendon
  std::vector<double> weights;    // one a node, >= 0, sum 1
  std::vector<BodyPoint> points;  // from the belly to the bone
  double rest_length_m = 0.0;
  double stiffness_N_m = 0.0;  // beyond the toe
  bool at_insertion = true;    // which end of the muscle
  double toe_m = 0.0;          // the force rises as a parabola over this extension, so that its slope is continuous
};

/// Force and tangent of a strand in one state. Unknowns: p, then one angle a joint.
struct StrandState {
  double length_m = 0.0;
  double tension_N = 0.0;
  Vec3 pull_N = Vec3::Zero();         // slope of the energy against p
  Eigen::VectorXd torque_Nm;          // slope of the energy against the angles
  Mat3 stiffness_N_m = Mat3::Zero();  // second derivatives: p p
  Eigen::Matrix3Xd coupling_N_rad;    // p angle
  Eigen::MatrixXd stiffness_Nm_rad;   // angle angle
};

/// Length at the pose with the belly's end at p.
double strand_length(const TendonStrand& strand, const Skeleton& skeleton, const Vec3& p_W_m);

/// p is the belly's end now.
StrandState evaluate_strand(const TendonStrand& strand, const Skeleton& skeleton, const Vec3& p_W_m);

}  // namespace myotact::simulation

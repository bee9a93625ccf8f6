#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "anatomy/specimen.h"
#include "core/vector.h"
#include "simulation/skeleton/skeleton.h"

namespace myotact::simulation {

/// The load-bearing part of a tendon as a one-dimensional elastic string: from the weighted mean p of the belly's end
/// nodes over points and surfaces on bodies to the bone. A string has true moment arms and no bending stiffness; tendon
/// tets of 1 GPa would lock in bending and make the solve ill-conditioned.
struct TendonStrand {
  /// A point that the string passes, riding on a body.
  struct BodyPoint {
    int body = -1;                                         // that carries it
    Vec3 rest_m = Vec3::Zero();                            // L
    std::optional<anatomy::LineWrap> wrap = std::nullopt;  // the surface on the way here
  };
  std::vector<int> nodes;         // of the muscle's mesh, on the border between belly and tendon
  std::vector<double> weights;    // one a node, >= 0, sum 1
  std::vector<BodyPoint> points;  // from the belly to the bone
  double rest_length_m = 0.0;     // slack below
  double stiffness_N_m = 0.0;     // beyond the toe
  bool at_insertion = true;       // which end of the muscle
  double toe_m = 0.0;             // the force rises as a parabola over this extension, so that its slope is continuous
};

/// Force and tangent of a strand in one state. Unknowns: p (world), then one angle a joint.
struct StrandState {
  double length_m = 0.0;              // of the whole string
  double tension_N = 0.0;             // slightly negative when slack, so that the tangent never vanishes
  Vec3 pull_N = Vec3::Zero();         // slope of the energy against p
  Eigen::VectorXd torque_Nm;          // slope of the energy against the angles: minus what pulls the joints
  Mat3 stiffness_N_m = Mat3::Zero();  // second derivatives: p p
  Eigen::Matrix3Xd coupling_N_rad;    // p angle
  Eigen::MatrixXd stiffness_Nm_rad;   // angle angle
};

/// Length in the skeleton's pose with the belly's end at p.
double strand_length(const TendonStrand& strand, const Skeleton& skeleton, const Vec3& p_W_m);

/// Force and tangent in the skeleton's pose; p is the belly's end now. Allocates.
StrandState evaluate_strand(const TendonStrand& strand, const Skeleton& skeleton, const Vec3& p_W_m);

}  // namespace myotact::simulation

#include "simulation/muscle/neighbour_contact_forces.h"

#include <algorithm>
#include <cmath>

#include "core/at.h"
#include "simulation/contact/contact_law.h"

namespace myotact::simulation {
namespace {

/// What a touch does at one gap: d(energy)/d(gap).
struct TouchForce {
  double overlap_m = 0.0;  // 0 of a tie
  double slope_N_m = 0.0;  // as NeighbourTouch's
  double along_N = 0.0;    // along the normal; 0 of a tie
  Vec3 gradient_N = Vec3::Zero();
};

TouchForce force_of_tie(const NeighbourTouch& tie, const Eigen::VectorXd& position_m) {
  Vec3 gap_m = tie.others_m;
  for (std::size_t k = 0; k < at(tie.count); ++k) gap_m += tie.weights[k] * node_vector(position_m, tie.nodes[k]);
  const double stiffness_N_m = tie.area_m2 * tie.tension_Pa_m;
  return {0.0, stiffness_N_m, 0.0, stiffness_N_m * gap_m};
}

TouchForce force_of(const NeighbourTouch& touch, const Eigen::VectorXd& position_m) {
  if (touch.tie) return force_of_tie(touch, position_m);
  double overlap_m = touch.others_overlap_m;
  for (std::size_t k = 0; k < at(touch.count); ++k) {
    overlap_m += touch.weights[k] * touch.normal_W.dot(node_vector(position_m, touch.nodes[k]));
  }
  const ContactPressure law = held_pressure(kTissueContact, touch.tension_Pa_m, overlap_m);
  const double along_N = touch.area_m2 * law.pressure_Pa;
  return {overlap_m, touch.area_m2 * law.slope_Pa_m, along_N, along_N * touch.normal_W};
}

Vec3 rider_now(const TissuePass& pass, const NeighbourTouch& touch, std::size_t k) {
  return pass.skeleton.body_pose(touch.rider_bodies[k]) * touch.riders_rest_m[k];
}

/// d(gap)/dq of a joint, through the clamped nodes of the touched place [m/rad].
Vec3 joint_slope(const TissuePass& pass, const NeighbourTouch& touch, int joint) {
  Vec3 slope = Vec3::Zero();
  for (std::size_t k = 0; k < touch.rider_bodies.size(); ++k) {
    const int body = touch.rider_bodies[k];
    if (body < 0 || !pass.skeleton.is_distal(body, joint)) continue;
    slope += touch.rider_weights[k] * pass.skeleton.point_derivative(body, joint, rider_now(pass, touch, k));
  }
  return slope;
}

bool has_riders(const NeighbourTouch& touch) {
  return std::any_of(touch.rider_bodies.begin(), touch.rider_bodies.end(), [](int body) { return body >= 0; });
}

void add_forces(const TissuePass& pass, const NeighbourTouch& touch, const TouchForce& force) {
  for (std::size_t k = 0; k < at(touch.count); ++k) {
    const int node = touch.nodes[k];
    const Vec3 gradient = touch.weights[k] * force.gradient_N;
    if (pass.tissue.free_index[at(node)] < 0) continue;  // the joints' part is the riders'
    pass.system.internal_N.segment<3>(3 * node) += gradient;
    pass.system.force_scale_N += gradient.squaredNorm();
  }
  if (!touch.touched || !has_riders(touch)) return;
  for (int j = 0; j < pass.skeleton.joint_count(); ++j) {
    pass.system.muscle_torque_Nm[j] -= force.gradient_N.dot(joint_slope(pass, touch, j));
  }
}

void add_block(const TissuePass& pass, int row, int column, const Mat3& block) {
  if (pass.load.in_factor)
    pass.system.factor.matrix.add(row, column, block);
  else
    pass.system.matrix.add(row, column, block);
}

/// The joints' own second derivatives, from the touched side alone.
void add_joint_stiffness(const TissuePass& pass, const NeighbourTouch& touch, const Vec3& gradient_N,
                         const Mat3& slope_N_m) {
  for (int j = 0; j < pass.skeleton.joint_count(); ++j) {
    const Vec3 pull = slope_N_m * joint_slope(pass, touch, j);
    for (int k = 0; k < pass.skeleton.joint_count(); ++k) {
      double stiffness = pull.dot(joint_slope(pass, touch, k));
      for (std::size_t r = 0; r < touch.rider_bodies.size() && !pass.load.definite; ++r) {
        const int body = touch.rider_bodies[r];
        if (body < 0) continue;
        const Vec3 second = pass.skeleton.point_second_derivative(body, j, k, rider_now(pass, touch, r));
        stiffness += touch.rider_weights[r] * gradient_N.dot(second);
      }
      pass.system.joint_stiffness_Nm_rad(j, k) += stiffness;
    }
  }
}

void add_tangent(const TissuePass& pass, const NeighbourTouch& touch, const Vec3& gradient_N) {
  const Mat3 slope_N_m = touch_slope(touch, touch.slope_N_m);
  for (std::size_t a = 0; a < at(touch.count); ++a) {
    const int row = pass.tissue.free_index[at(touch.nodes[a])];
    if (row < 0) continue;
    for (std::size_t b = 0; b < at(touch.count); ++b) {
      const int column = pass.tissue.free_index[at(touch.nodes[b])];
      if (column < 0 || column > row) continue;
      add_block(pass, row, column, touch.weights[a] * touch.weights[b] * slope_N_m);
    }
  }
  if (!has_riders(touch)) return;
  for (int j = 0; j < pass.skeleton.joint_count(); ++j) {
    const Vec3 pull = slope_N_m * joint_slope(pass, touch, j);
    for (std::size_t a = 0; a < at(touch.count); ++a) {
      const int row = pass.tissue.free_index[at(touch.nodes[a])];
      if (row >= 0) pass.system.coupling_N_rad.col(j).segment<3>(3 * row) += touch.weights[a] * pull;
    }
  }
  if (touch.touched) add_joint_stiffness(pass, touch, gradient_N, slope_N_m);
}

}  // namespace

void add_neighbour_contact(const TissuePass& pass) {
  for (NeighbourTouch& touch : pass.state.touches) {
    const TouchForce force = force_of(touch, pass.state.now.position_m);
    if (pass.tangent) touch.slope_N_m = pass.load.contact_held ? 0.0 : force.slope_N_m;
    if (force.slope_N_m == 0.0) continue;
    pass.system.contact_N += std::abs(force.along_N);
    pass.system.contact_depth_m = std::max(pass.system.contact_depth_m, force.overlap_m);
    add_forces(pass, touch, force);
    if (pass.tangent && !pass.load.contact_held) add_tangent(pass, touch, force.gradient_N);
  }
}

}  // namespace myotact::simulation

#include "simulation/muscle/neighbour_contact_forces.h"

#include <algorithm>

#include "core/at.h"
#include "simulation/contact/contact_law.h"

namespace myotact::simulation {
namespace {

/// What a touch does at one gap.
struct TouchForce {
  double overlap_m = 0.0;
  double slope_N_m = 0.0;       // as NeighbourTouch's
  Vec3 force_N = Vec3::Zero();  // d(energy)/d(gap)
};

TouchForce force_of(const NeighbourTouch& touch, const Eigen::VectorXd& position_m) {
  Vec3 gap_m = touch.others_m;
  for (std::size_t k = 0; k < at(touch.count); ++k) gap_m += touch.weights[k] * node_vector(position_m, touch.nodes[k]);
  if (touch.tie) {
    const double stiffness_N_m = touch.area_m2 * touch.tension_Pa_m;
    return {0.0, stiffness_N_m, stiffness_N_m * gap_m};
  }
  const double overlap_m = touch.normal_W.dot(gap_m) - touch.rest_depth_m;
  const ContactPressure law = held_pressure(kTissueContact, touch.tension_Pa_m, overlap_m);
  return {overlap_m, touch.area_m2 * law.slope_Pa_m, touch.area_m2 * law.pressure_Pa * touch.normal_W};
}

Vec3 rider_now(const TissuePass& pass, const NeighbourTouch& touch, std::size_t k) {
  return pass.skeleton.body_pose(touch.rider_bodies[k]) * touch.riders_rest_m[k];
}

/// dg/dq of a joint: through the clamped nodes of the touched place.
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

void add_forces(const TissuePass& pass, const NeighbourTouch& touch, const Vec3& force_N) {
  for (std::size_t k = 0; k < at(touch.count); ++k) {
    const int node = touch.nodes[k];
    const Vec3 gradient = touch.weights[k] * force_N;
    if (pass.tissue.free_index[at(node)] < 0) continue;  // the joints' part is the riders'
    pass.system.internal_N.segment<3>(3 * node) += gradient;
    pass.system.force_scale_N += gradient.squaredNorm();
  }
  if (!touch.touched || !has_riders(touch)) return;
  for (int j = 0; j < pass.skeleton.joint_count(); ++j) {
    pass.system.muscle_torque_Nm[j] -= force_N.dot(joint_slope(pass, touch, j));
  }
}

void add_block(const TissuePass& pass, int row, int column, const Mat3& block) {
  if (pass.load.in_factor)
    pass.system.factor.matrix.add(row, column, block);
  else
    pass.system.matrix.add(row, column, block);
}

/// The joints' own second derivatives, from the touched side alone.
void add_joint_stiffness(const TissuePass& pass, const NeighbourTouch& touch, const Vec3& force_N) {
  for (int j = 0; j < pass.skeleton.joint_count(); ++j) {
    for (int k = 0; k < pass.skeleton.joint_count(); ++k) {
      const Vec3 pulled_N_rad = slope_times(touch, touch.slope_N_m, joint_slope(pass, touch, k));
      double stiffness = joint_slope(pass, touch, j).dot(pulled_N_rad);
      for (std::size_t r = 0; r < touch.rider_bodies.size() && !pass.load.definite; ++r) {
        const int body = touch.rider_bodies[r];
        if (body < 0) continue;
        const Vec3 second = pass.skeleton.point_second_derivative(body, j, k, rider_now(pass, touch, r));
        stiffness += touch.rider_weights[r] * force_N.dot(second);
      }
      pass.system.joint_stiffness_Nm_rad(j, k) += stiffness;
    }
  }
}

void add_tangent(const TissuePass& pass, const NeighbourTouch& touch, const Vec3& force_N) {
  const Mat3 along = slope_times(touch, touch.slope_N_m, Mat3::Identity());
  for (std::size_t a = 0; a < at(touch.count); ++a) {
    const int row = pass.tissue.free_index[at(touch.nodes[a])];
    if (row < 0) continue;
    for (std::size_t b = 0; b < at(touch.count); ++b) {
      const int column = pass.tissue.free_index[at(touch.nodes[b])];
      if (column < 0 || column > row) continue;
      add_block(pass, row, column, touch.weights[a] * touch.weights[b] * along);
    }
  }
  if (!has_riders(touch)) return;
  for (int j = 0; j < pass.skeleton.joint_count(); ++j) {
    const Vec3 pull = slope_times(touch, touch.slope_N_m, joint_slope(pass, touch, j));
    for (std::size_t a = 0; a < at(touch.count); ++a) {
      const int row = pass.tissue.free_index[at(touch.nodes[a])];
      if (row >= 0) pass.system.coupling_N_rad.col(j).segment<3>(3 * row) += touch.weights[a] * pull;
    }
  }
  if (touch.touched) add_joint_stiffness(pass, touch, force_N);
}

}  // namespace

void add_neighbour_contact(const TissuePass& pass) {
  for (NeighbourTouch& touch : pass.state.touches) {
    const TouchForce force = force_of(touch, pass.state.now.position_m);
    if (pass.tangent) touch.slope_N_m = pass.load.contact_held ? 0.0 : force.slope_N_m;
    if (force.slope_N_m == 0.0) continue;
    if (!touch.tie) pass.system.contact_N += force.force_N.norm();
    pass.system.contact_depth_m = std::max(pass.system.contact_depth_m, force.overlap_m);
    add_forces(pass, touch, force.force_N);
    if (pass.tangent && !pass.load.contact_held) add_tangent(pass, touch, force.force_N);
  }
}

}  // namespace myotact::simulation

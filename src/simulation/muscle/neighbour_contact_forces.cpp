#include "simulation/muscle/neighbour_contact_forces.h"

#include <algorithm>

#include "core/at.h"
#include "simulation/contact/contact_law.h"

namespace myotact::simulation {
namespace {

double overlap_m(const NeighbourTouch& touch, const Eigen::VectorXd& position_m) {
  double sum = touch.others_m;
  for (std::size_t k = 0; k < at(touch.count); ++k) {
    sum += touch.weights[k] * touch.normal_W.dot(node_vector(position_m, touch.nodes[k]));
  }
  return sum;
}

Vec3 rider_now(const TissuePass& pass, const NeighbourTouch& touch, std::size_t k) {
  return pass.skeleton.body_pose(touch.rider_bodies[k]) * touch.riders_rest_m[k];
}

/// ds/dq of a joint: through the clamped nodes of the touched face.
double joint_slope(const TissuePass& pass, const NeighbourTouch& touch, int joint) {
  double slope = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const int body = touch.rider_bodies[k];
    if (body < 0 || !pass.skeleton.is_distal(body, joint)) continue;
    const Vec3 jacobian = pass.skeleton.point_derivative(body, joint, rider_now(pass, touch, k));
    slope += touch.rider_weights[k] * touch.normal_W.dot(jacobian);
  }
  return slope;
}

bool has_riders(const NeighbourTouch& touch) {
  return std::any_of(touch.rider_bodies.begin(), touch.rider_bodies.end(), [](int body) { return body >= 0; });
}

void add_forces(const TissuePass& pass, const NeighbourTouch& touch, double force_N) {
  for (std::size_t k = 0; k < at(touch.count); ++k) {
    const int node = touch.nodes[k];
    const Vec3 gradient = touch.weights[k] * force_N * touch.normal_W;
    if (pass.tissue.free_index[at(node)] < 0) continue;  // the joints' part is the riders'
    pass.system.internal_N.segment<3>(3 * node) += gradient;
    pass.system.force_scale_N += gradient.squaredNorm();
  }
  if (!touch.touched || !has_riders(touch)) return;
  for (int j = 0; j < pass.skeleton.joint_count(); ++j) {
    pass.system.muscle_torque_Nm[j] -= force_N * joint_slope(pass, touch, j);
  }
}

void add_block(const TissuePass& pass, int row, int column, const Mat3& block) {
  if (pass.load.in_factor)
    pass.system.factor.matrix.add(row, column, block);
  else
    pass.system.matrix.add(row, column, block);
}

/// The joints' own second derivatives, from the touched side alone.
void add_joint_stiffness(const TissuePass& pass, const NeighbourTouch& touch, double force_N) {
  for (int j = 0; j < pass.skeleton.joint_count(); ++j) {
    for (int k = 0; k < pass.skeleton.joint_count(); ++k) {
      double stiffness = touch.slope_N_m * joint_slope(pass, touch, j) * joint_slope(pass, touch, k);
      for (std::size_t r = 0; r < 3 && !pass.load.definite; ++r) {
        const int body = touch.rider_bodies[r];
        if (body < 0) continue;
        const Vec3 second = pass.skeleton.point_second_derivative(body, j, k, rider_now(pass, touch, r));
        stiffness += force_N * touch.rider_weights[r] * touch.normal_W.dot(second);
      }
      pass.system.joint_stiffness_Nm_rad(j, k) += stiffness;
    }
  }
}

void add_tangent(const TissuePass& pass, const NeighbourTouch& touch, double force_N) {
  const Mat3 along = touch.slope_N_m * touch.normal_W * touch.normal_W.transpose();
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
    const Vec3 pull = touch.slope_N_m * joint_slope(pass, touch, j) * touch.normal_W;
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
    const double overlap = overlap_m(touch, pass.state.now.position_m);
    const ContactPressure law = contact_pressure(kTissueContact, overlap);
    if (pass.tangent) touch.slope_N_m = pass.load.contact_held ? 0.0 : touch.area_m2 * law.slope_Pa_m;
    if (!(law.pressure_Pa > 0.0)) continue;
    const double force_N = touch.area_m2 * law.pressure_Pa;
    pass.system.contact_N += force_N;
    pass.system.contact_depth_m = std::max(pass.system.contact_depth_m, overlap);
    add_forces(pass, touch, force_N);
    if (pass.tangent && !pass.load.contact_held) add_tangent(pass, touch, force_N);
  }
}

}  // namespace myotact::simulation

#include "simulation/limb/limb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "simulation/muscle/build_tissue.h"
#include "simulation/muscle/fascia_bonds.h"

namespace myotact::simulation {
namespace {

/// From the sparse matrix's solution to the whole one's, by Sherman and Morrison's formula.
void add_mean_term(const LimbMuscle& muscle, Eigen::MatrixXd& solution) {
  const Eigen::RowVectorXd along = muscle.mean_share_Nm * (muscle.system.mean.gradient.transpose() * solution);
  solution -= muscle.mean_solution * along;
}

/// The line of a muscle; build_muscle_tissue() has seen to it that there is one.
const anatomy::MuscleLine& line_of(const anatomy::Specimen& specimen, int muscle) {
  return *std::find_if(specimen.lines.begin(), specimen.lines.end(),
                       [&](const anatomy::MuscleLine& line) { return line.muscle == muscle; });
}

std::span<const double> as_span(const Eigen::VectorXd& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}

}  // namespace

Limb::Limb(const anatomy::Specimen& specimen, std::span<const TissueModel> models, Tendon tendon, Contact with_contact,
           const Fascia& held_by)
    : skeleton(specimen), contact(with_contact), fascia(held_by) {
  now.angle_rad = now.velocity_rad_s = Eigen::VectorXd::Zero(skeleton.joint_count());
  last = before = now;
  external_torque_Nm = now.angle_rad;
  std::shared_ptr<const BoneShapes> bones;  // made for the first muscle that can touch them: they take a while
  for (int m = 0; m < static_cast<int>(specimen.muscles.size()); ++m) {
    LimbMuscle muscle;
    const TissueModel model = models.empty() ? TissueModel::Fem : models[static_cast<std::size_t>(m)];
    muscle.tissue = build_muscle_tissue(specimen, m, model);
    muscle.rigid = model == TissueModel::Rigid || model == TissueModel::Line;
    if (muscle.rigid)
      muscle.follower = make_follower(muscle.tissue.mesh, muscle.tissue.body, line_of(specimen, m), skeleton);
    if (model == TissueModel::Line) {
      muscle.line =
          make_line_tissue(specimen.muscles[static_cast<std::size_t>(m)], line_of(specimen, m), skeleton, tendon);
    }
    if (contact != Contact::None && !muscle.rigid) {
      if (!bones) bones = make_bone_shapes(specimen);
      muscle.tissue.bone_contact = make_bone_contact(bones, muscle.tissue.mesh, muscle.tissue.body);
    }
    muscle.state = make_state(muscle.tissue);
    muscle.system = make_system(muscle.tissue, skeleton);
    muscle.stiffness_Nm_rad = muscle.contact_stiffness_Nm_rad = muscle.readout.torque_Nm =
        Eigen::VectorXd::Zero(skeleton.joint_count());
    muscles.push_back(std::move(muscle));
  }
  const bool held = fascia.tension_Pa_m > 0.0;
  if (contact != Contact::All && !held) return;
  std::vector<MuscleTissue*> soft;
  for (LimbMuscle& muscle : muscles) soft.push_back(muscle.rigid ? nullptr : &muscle.tissue);
  touch_surfaces = make_touch_surfaces(soft);
  if (held) lay_bonds(soft, fascia, touch_surfaces);
}

double seat_m_N(const Limb& limb, const ToolSpring& spring) {
  constexpr double kShareOfCoupling = 0.03;  // as much too soft is a sphere that one point alone bears
  const auto points = std::count_if(limb.springs.begin(), limb.springs.end(), [&](const ToolSpring& other) {
    return !other.open && of_one_sphere(spring, other);
  });
  return points > 1 ? kShareOfCoupling / spring.stiffness_N_m : 0.0;
}

Vec3 spring_force(const Limb& limb, std::size_t index) {
  const ToolSpring& spring = limb.springs[index];
  if (spring.open) return Vec3::Zero();
  const Vec3 way_m = spring.target_W_m - spring_point(limb, spring);
  const double seat = seat_m_N(limb, spring);
  if (seat == 0.0) return spring.stiffness_N_m * way_m;
  Vec3 ways_m = Vec3::Zero();
  int points = 0;
  for (const ToolSpring& other : limb.springs) {
    if (other.open || !of_one_sphere(spring, other)) continue;
    ways_m += other.target_W_m - spring_point(limb, other);
    ++points;
  }
  const Vec3 coupling_N = ways_m / (seat + points / spring.stiffness_N_m);
  return (way_m - coupling_N / spring.stiffness_N_m) / seat;
}

Vec3 spring_point(const Limb& limb, const ToolSpring& spring) {
  if (spring.muscle < 0) return limb.skeleton.body_pose(spring.body) * spring.body_rest_m;
  const LimbMuscle& muscle = limb.muscles[static_cast<std::size_t>(spring.muscle)];
  Vec3 p = Vec3::Zero();
  for (std::size_t k = 0; k < static_cast<std::size_t>(spring.point.count); ++k) {
    p += spring.point.weights[k] * node_vector(muscle.state.now.position_m, spring.point.nodes[k]);
  }
  return p;
}

Vec3 spring_slope(const Limb& limb, const ToolSpring& spring, int joint) {
  if (spring.muscle < 0) return limb.skeleton.point_derivative(spring.body, joint, spring_point(limb, spring));
  const LimbMuscle& muscle = limb.muscles[static_cast<std::size_t>(spring.muscle)];
  Vec3 slope = Vec3::Zero();
  for (std::size_t k = 0; k < static_cast<std::size_t>(spring.point.count); ++k) {
    const int node = spring.point.nodes[k];
    const int body = muscle.tissue.body[static_cast<std::size_t>(node)];
    if (body < 0) continue;
    const Vec3 x = node_vector(muscle.state.now.position_m, node);
    slope += spring.point.weights[k] * limb.skeleton.point_derivative(body, joint, x);
  }
  return slope;
}

void follow_angles(Limb& limb) {
  limb.skeleton.set_pose(limb.angles());
  for (LimbMuscle& muscle : limb.muscles) {
    if (is_solved(muscle)) place_clamped(muscle.tissue, limb.skeleton, muscle.state);
  }
  for (const ToolSpring& spring : limb.springs) {
    if (spring.muscle >= 0) place_follower(limb, spring.muscle);
  }
}

void place_follower(Limb& limb, int index) {
  LimbMuscle& muscle = limb.muscles[static_cast<std::size_t>(index)];
  if (!muscle.follower) return;
  place_follower(muscle.tissue.mesh, limb.skeleton, *muscle.follower, muscle.state.now.position_m);
}

void move_free_nodes(LimbMuscle& muscle, const Eigen::VectorXd& change_m) {
  for (std::size_t node = 0; node < muscle.tissue.body.size(); ++node) {
    const int f = muscle.tissue.free_index[node];
    if (f < 0) continue;
    muscle.state.now.position_m.segment<3>(static_cast<Eigen::Index>(3 * node)) += change_m.segment<3>(3 * f);
  }
}

void evaluate_lines(Limb& limb, const TimeRule& rule) {
  for (LimbMuscle& muscle : limb.muscles) {
    if (!muscle.line) continue;
    const LineLoad load = evaluate_line_tissue(limb.skeleton, rule, muscle.state.activation, *muscle.line);
    muscle.system.joint_residual_Nm = load.residual_Nm;
    muscle.system.joint_stiffness_Nm_rad = load.stiffness_Nm_rad;
    muscle.readout.torque_Nm = -load.residual_Nm;
    muscle.readout.tension_N = muscle.line->force.force_N;
  }
}

void read_out(Limb& limb) {
  for (LimbMuscle& muscle : limb.muscles) {
    if (muscle.rigid) continue;
    const TissueSystem& system = muscle.system;
    muscle.readout = {system.muscle_torque_Nm, system.tension_N, system.smallest_J,
                      system.volume_ratio,     system.contact_N, system.contact_depth_m};
  }
  const auto span = [](const Eigen::VectorXd& v) {
    return std::span<const double>(v.data(), static_cast<std::size_t>(v.size()));
  };
  limb.loads.compute(limb.skeleton, {limb.gravity_m_s2, span(limb.now.velocity_rad_s), span(limb.external_torque_Nm)});
}

void compute_system(const Skeleton& skeleton, TissueLoad load, LimbMuscle& muscle, Accuracy accuracy) {
  load.in_factor = accuracy == Accuracy::Single;
  muscle.kept_rule.reset();
  compute_system(muscle.tissue, skeleton, load, muscle.state, muscle.system);
}

Pivots factor_system(LimbMuscle& muscle, const Eigen::MatrixXd& right, Eigen::MatrixXd& solution, Accuracy accuracy) {
  BlockFactor& factor = muscle.system.factor.matrix;
  const bool refined = accuracy == Accuracy::Refined;
  if (!(refined ? factor.factor(muscle.system.matrix) : factor.factor())) return Pivots::Unusable;
  const MeanTerm& mean = muscle.system.mean;
  Eigen::MatrixXd sides(right.rows(), right.cols() + 1);
  sides << mean.gradient, right;
  const Eigen::MatrixXd solved = refined ? factor.solve_refined(muscle.system.matrix, sides) : factor.solve(sides);
  muscle.mean_solution = solved.col(0);
  const double pivot = 1.0 + mean.factor_Nm * mean.gradient.dot(muscle.mean_solution);
  if (!std::isfinite(pivot) || pivot == 0.0) return Pivots::Unusable;
  muscle.mean_share_Nm = mean.factor_Nm / pivot;
  solution = solved.rightCols(right.cols());
  add_mean_term(muscle, solution);
  return factor.positive() && pivot > 0.0 ? Pivots::Positive : Pivots::Mixed;
}

Eigen::MatrixXd solve(const LimbMuscle& muscle, const Eigen::MatrixXd& right) {
  Eigen::MatrixXd solution = muscle.system.factor.matrix.solve(right);
  add_mean_term(muscle, solution);
  return solution;
}

Eigen::VectorXd joint_velocity_rad_s(const Limb& limb, const TimeRule& rule) {
  return rule.rate_1_s * limb.now.angle_rad - rule.now_1_s * limb.last.angle_rad +
         rule.before_1_s * limb.before.angle_rad;
}

Eigen::VectorXd joint_acceleration_rad_s2(const Limb& limb, const TimeRule& rule) {
  return rule.rate_1_s * joint_velocity_rad_s(limb, rule) - rule.now_1_s * limb.last.velocity_rad_s +
         rule.before_1_s * limb.before.velocity_rad_s;
}

void stop_moving(Limb& limb) {
  limb.now.velocity_rad_s.setZero();
  for (LimbMuscle& muscle : limb.muscles) {
    muscle.state.now.velocity_m_s.setZero();
    std::fill(muscle.state.stretch_rate_1_s.begin(), muscle.state.stretch_rate_1_s.end(), 0.0);
  }
}

void return_to_file_pose(Limb& limb) {
  limb.now.angle_rad.setZero();
  limb.now.velocity_rad_s.setZero();
  limb.last = limb.before = limb.now;
  for (LimbMuscle& muscle : limb.muscles) {
    muscle.sleep.reset();
    muscle.definite_tangents = 0;
    muscle.state = make_state(muscle.tissue);
    if (muscle.follower) muscle.follower->placed_rad.clear();  // its nodes are back, whatever the angles were
    muscle.stiffness_Nm_rad.setZero();
    muscle.contact_stiffness_Nm_rad.setZero();
  }
  for (TouchSurface& surface : limb.touch_surfaces) {
    for (FasciaBond& bond : surface.bonds) bond.place = bond.rest;
  }
  follow_angles(limb);
  for (LimbMuscle& muscle : limb.muscles) {
    if (!muscle.line) continue;
    evaluate_line_tissue(limb.skeleton, {}, 0.0, *muscle.line);
    bring_to_rest(0.0, *muscle.line);
  }
}

void add_to_hash(std::span<const double> values, std::uint64_t& hash) {
  for (double value : values) {
    std::array<unsigned char, sizeof(double)> bytes;
    std::memcpy(bytes.data(), &value, sizeof(double));
    for (unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211ull;
  }
}

std::uint64_t hash_of_state(const Limb& limb) {
  std::uint64_t hash = kHashStart;
  add_to_hash(as_span(limb.now.angle_rad), hash);
  add_to_hash(as_span(limb.now.velocity_rad_s), hash);
  for (const LimbMuscle& muscle : limb.muscles) {
    add_to_hash(as_span(muscle.state.now.position_m), hash);
    add_to_hash(as_span(muscle.state.now.velocity_m_s), hash);
    add_to_hash({&muscle.state.activation, 1}, hash);
    if (muscle.line) add_to_hash({&muscle.line->fibre_now_m, 1}, hash);
  }
  return hash;
}

}  // namespace myotact::simulation

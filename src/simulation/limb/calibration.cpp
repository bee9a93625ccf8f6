#include "simulation/limb/calibration.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "simulation/limb/settle.h"
#include "simulation/line/line_model.h"
#include "simulation/muscle/fibre_field.h"

namespace myotact::simulation {
namespace {

constexpr double kActivation = 0.5;  // the middle of the range: the rest lies on both sides
/// Most muscles need some ten; the thickest ones creep.
constexpr int kMostRounds = 40;
/// From this round on, steps of half the size: offset, scale and gain act on each other, and with whole steps some
/// muscles swing about the goal for ever (measured: a biceps over its pulley, +-10 % after 60 rounds; so, done in 20).
constexpr int kWholeRounds = 12;
/// Agreement at which the rounds end. Under half of the 5 % that a specimen is allowed.
constexpr double kCloseEnough = 0.02;
/// A muscle whose force misses its line by more than this where the slope is fitted, too, is fitted to the force alone.
constexpr double kForceAgrees = 0.1;
/// Out-of-balance share to which each round is solved.
constexpr double kRoundShare = 1e-5;
/// A round changes scale and gain by no more than this factor, so that the guess of the next one stays near.
constexpr double kLargestFactor = 1.3;
/// Force and slope are adjusted once the mean fibre length is this near to rest_stretch.
constexpr double kLengthFits = 0.05;
/// Limits of the whole adjustment; beyond them the mesh is too coarse or too bent to stand for the line.
constexpr double kSmallestScale = 0.4, kLargestScale = 2.5;
/// An offset that would put the resting muscle farther out on the force-length curve than this, where little force is
/// left to begin with, makes it count as no longer than the curve's top.
constexpr double kFarthestAtRest = 1.4, kTop = 1.02;
/// Rotation for the slope of the tension, small against any curvature, large against rounding [rad].
constexpr double kProbe_rad = 1e-6;

/// The line at the file pose and the joint whose rotation gives the slope; -1 when none changes its length.
struct LineTarget {
  LineForce force;
  int joint = -1;
  double slope_m_rad = 0.0;
};

bool is_grouped(const anatomy::Specimen& specimen, int muscle, int joint) {
  return std::any_of(specimen.groups.begin(), specimen.groups.end(), [&](const anatomy::MuscleGroup& group) {
    const auto has = [&](const std::vector<int>& side) {
      return std::find(side.begin(), side.end(), muscle) != side.end();
    };
    return group.joint == joint && (has(group.flexors) || has(group.extensors));
  });
}

/// Of several joints that change the line's length, the one whose stiffness is shown with this muscle (the specimen's
/// groups) comes before the one that changes it most.
LineTarget line_target(const anatomy::Specimen& specimen, int index, const Skeleton& skeleton) {
  const auto line = std::find_if(specimen.lines.begin(), specimen.lines.end(),
                                 [&](const anatomy::MuscleLine& l) { return l.muscle == index; });
  LineGeometry geometry;
  measure_line(*line, skeleton, geometry);
  LineTarget target{line_force(specimen.muscles[static_cast<std::size_t>(index)], 0.0, 0.0, kActivation)};
  const double smallest_moment_arm_m = 1e-4;
  bool grouped = false;
  for (int j = 0; j < skeleton.joint_count(); ++j) {
    const double slope = geometry.slope_m_rad[j];
    if (std::abs(slope) < smallest_moment_arm_m) continue;
    const bool here = is_grouped(specimen, index, j);
    if (here == grouped ? std::abs(slope) < std::abs(target.slope_m_rad) : grouped) continue;
    grouped = here;
    target.joint = j;
    target.slope_m_rad = slope;
  }
  return target;
}

/// Change of the tension with a joint's angle, the free nodes following in equilibrium [N/rad]. At a settled state.
double tension_slope(const Skeleton& skeleton, int joint, LimbMuscle& muscle) {
  const TissueLoad load;
  compute_system(skeleton, load, muscle, Accuracy::Refined);
  Eigen::MatrixXd follow;
  const Pivots pivots = factor_system(muscle, muscle.system.coupling_N_rad.col(joint), follow, Accuracy::Refined);
  if (pivots == Pivots::Unusable) return std::nan("");
  const double tension_N = muscle.system.tension_N;
  const Eigen::VectorXd kept = muscle.state.now.position_m;
  std::vector<double> angles(static_cast<std::size_t>(skeleton.joint_count()));
  for (int j = 0; j < skeleton.joint_count(); ++j) angles[static_cast<std::size_t>(j)] = skeleton.angle_rad(j);
  angles[static_cast<std::size_t>(joint)] += kProbe_rad;
  Skeleton rotated = skeleton;
  rotated.set_pose(angles);
  move_free_nodes(muscle, -kProbe_rad * follow);
  place_clamped(muscle.tissue, rotated, muscle.state);
  compute_forces(muscle.tissue, rotated, load, muscle.state, muscle.system);
  muscle.state.now.position_m = kept;
  return (muscle.system.tension_N - tension_N) / kProbe_rad;
}

double error_of(const LineAgreement& agreement) {
  const double error = std::max(std::abs(agreement.force - 1.0), std::abs(agreement.stiffness - 1.0));
  return std::isfinite(error) ? error : 1e300;
}

LineAgreement measure(const LineTarget& target, const Skeleton& skeleton, LimbMuscle& muscle) {
  if (!settle_muscle(skeleton, Vec3::Zero(), kRoundShare, muscle)) return {std::nan(""), std::nan("")};
  LineAgreement agreement{muscle.system.tension_N / target.force.force_N, 1.0};
  if (target.joint >= 0 && target.force.stiffness_N_m > 0.0) {
    const double slope = tension_slope(skeleton, target.joint, muscle);
    agreement.stiffness = slope / target.slope_m_rad / target.force.stiffness_N_m;
  }
  return agreement;
}

/// Tension of the muscle when it is excited at rest, over the line's; NaN when it finds none. A muscle may agree on the
/// way here and never get there from rest.
double pull_from_rest(const LineTarget& target, const Skeleton& skeleton, LimbMuscle& muscle) {
  for (const double activation : {0.0, kActivation}) {
    muscle.state.activation = activation;
    if (!settle_muscle(skeleton, Vec3::Zero(), kRoundShare, muscle)) return std::nan("");
  }
  return muscle.system.tension_N / target.force.force_N;
}

double bounded(double factor) {
  return std::clamp(factor, 1.0 / kLargestFactor, kLargestFactor);
}

/// The rounds of one calibration: leaves the muscle's fibres at the best it found and returns how well that agrees.
LineAgreement fit_in_rounds(const LineTarget& target, const Skeleton& skeleton, LimbMuscle& muscle) {
  FibreMap& map = muscle.tissue.fibre_map;
  const FibreMap plain = map;
  muscle.state.activation = kActivation;
  FibreMap best_map = map;
  LineAgreement best{std::nan(""), std::nan("")};
  for (int round = 0; round < kMostRounds && !(error_of(best) < kCloseEnough); ++round) {
    const LineAgreement now = measure(target, skeleton, muscle);
    if (error_of(now) < error_of(best)) {
      best = now;
      best_map = map;
    }
    if (!std::isfinite(now.force) || !(now.force > 0.0)) break;
    const double short_of = map.rest_stretch - mean_fibre_length(muscle.tissue, muscle.state.now.stretch);
    const double part = round < kWholeRounds ? 1.0 : 0.5;
    map.offset += part * short_of;
    const double at_rest = map.rest_stretch + map.offset;
    map.beyond = at_rest > kFarthestAtRest ? (kTop - 1.0) / (at_rest - 1.0) : 1.0;
    if (std::abs(short_of) > kLengthFits) continue;  // force and slope mean little at another length
    map.scale = std::clamp(map.scale * bounded(std::pow(now.force, -part)), kSmallestScale, kLargestScale);
    const double steeper = now.stiffness > 0.0 ? bounded(std::pow(now.stiffness, -part)) : kLargestFactor;
    map.gain = std::clamp(map.gain * steeper, kSmallestScale * plain.gain, kLargestScale * plain.gain);
  }
  map = best_map;
  return best;
}

}  // namespace

std::uint64_t calibration_fingerprint(const anatomy::Specimen& specimen, int index, bool on_bones) {
  std::uint64_t hash = kHashStart;
  const auto add = [&](std::initializer_list<double> values) { add_to_hash({values.begin(), values.size()}, hash); };
  const auto add_points = [&](const std::vector<Vec3>& points) {
    for (const Vec3& p : points) add({p.x(), p.y(), p.z()});
  };
  const anatomy::Muscle& muscle = specimen.muscles[static_cast<std::size_t>(index)];
  add({muscle.peak_force_N, muscle.optimal_fibre_m, muscle.pennation_rad, muscle.rest_stretch, muscle.tendon_slack_m});
  add_points(muscle.tets.nodes_m);
  const auto add_numbers = [&](const auto& lists) {
    for (const auto& list : lists) {
      for (const int number : list) add({static_cast<double>(number)});
    }
  };
  add_numbers(muscle.tets.corners);
  add_numbers(muscle.tets.midsides);
  add_points(muscle.fibres);
  add_to_hash(muscle.sections_m2, hash);
  for (const anatomy::TissueRegion region : muscle.regions) add({static_cast<double>(region)});
  for (const int body : muscle.attachments) add({static_cast<double>(body)});
  for (const anatomy::MuscleLine& line : specimen.lines) {
    if (line.muscle != index) continue;
    for (const anatomy::LinePoint& point : line.points) {
      add({static_cast<double>(point.body), static_cast<double>(point.kind)});
      add_points({point.position_m});
    }
    for (const anatomy::LineWrap& wrap : line.wraps) {
      add({static_cast<double>(wrap.body), static_cast<double>(wrap.after), static_cast<double>(wrap.shape)});
      add_points({wrap.centre_m, wrap.axes.row(0), wrap.axes.row(1), wrap.axes.row(2), wrap.radii_m, wrap.side});
    }
  }
  for (const anatomy::Joint& joint : specimen.joints) {
    add({static_cast<double>(joint.type), static_cast<double>(joint.parent), static_cast<double>(joint.child)});
    add_points({joint.centre_m});
    add_points(joint.axes);
  }
  for (int j = 0; j < static_cast<int>(specimen.joints.size()); ++j) {
    if (is_grouped(specimen, index, j)) add({static_cast<double>(j)});
  }
  if (!on_bones) return hash;
  for (const anatomy::Bone& bone : specimen.bones) {
    add({static_cast<double>(bone.body)});
    add_points(bone.surface.positions_m);
  }
  return hash;
}

void apply_fit(const anatomy::FibreFit& fit, FibreMap& map) {
  map.offset = fit.offset;
  map.scale = fit.scale;
  map.gain = fit.gain;
  map.beyond = fit.beyond;
}

LineAgreement calibrate_muscle(const anatomy::Specimen& specimen, int index, const Skeleton& skeleton,
                               LimbMuscle& muscle) {
  const LineTarget target = line_target(specimen, index, skeleton);
  const FibreMap plain = muscle.tissue.fibre_map;
  LineAgreement best = fit_in_rounds(target, skeleton, muscle);
  if (!(std::abs(best.force - 1.0) < kForceAgrees) && target.joint >= 0) {
    const FibreMap with_slope = muscle.tissue.fibre_map;
    muscle.tissue.fibre_map = plain;
    muscle.state = make_state(muscle.tissue);
    LineTarget force_alone = target;
    force_alone.joint = -1;
    const LineAgreement other = fit_in_rounds(force_alone, skeleton, muscle);
    if (error_of(other) < std::abs(best.force - 1.0)) {
      best = measure(target, skeleton, muscle);
    } else {
      muscle.tissue.fibre_map = with_slope;
    }
  }
  muscle.state = make_state(muscle.tissue);
  best.force = pull_from_rest(target, skeleton, muscle);
  muscle.state = make_state(muscle.tissue);
  return best;
}

}  // namespace myotact::simulation

#include "measure/fidelity/joint_goals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "haptics/haptic_loop.h"
#include "haptics/haptic_thread.h"
#include "measure/fidelity/guided_device.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"

namespace myotact::measure {

namespace {

constexpr double kTick_s = 1e-3;
constexpr std::uint64_t kStep_ns = 10'000'000;

/// A scene's joint at the scene's pose, its muscles as lines, the scene's other joints held; balanced by an outer
/// torque.
class BalancedJoint {
 public:
  BalancedJoint(const scene::Scene& scene, double level) : simulation_(scene.specimen, scene.settings) {
    joint_ = scene.co_contraction->joint;
    std::vector<double> activations = scene.activations, angles_rad;
    for (const auto* side : {&scene.co_contraction->flexors, &scene.co_contraction->extensors})
      for (const int muscle : *side) activations[static_cast<std::size_t>(muscle)] = level;
    for (std::size_t j = 0; j < scene.joints.size(); ++j) {
      angles_rad.push_back(scene.joints[j].angle_rad);
      simulation_.set_joint_locked(static_cast<int>(j), static_cast<int>(j) != joint_);
    }
    for (std::size_t m = 0; m < activations.size(); ++m)
      simulation_.set_excitation(static_cast<int>(m), activations[m]);
    simulation_.settle(angles_rad, activations);
    const simulation::JointReadout at_rest = simulation_.joint(joint_);
    torque_Nm_ = -(at_rest.net_torque_Nm + at_rest.own_torque_Nm);
    simulation_.set_joint_torque(joint_, torque_Nm_);
  }

  simulation::JointReadout joint() const { return simulation_.joint(joint_); }
  void push(double torque_Nm) { simulation_.set_joint_torque(joint_, torque_Nm_ + torque_Nm); }
  simulation::Simulation& simulation() { return simulation_; }

 private:
  simulation::Simulation simulation_;
  int joint_ = -1;
  double torque_Nm_ = 0.0;
};

/// A hand on the point of the moved bones that is farthest from the joint.
class HeldPaw {
 public:
  HeldPaw(const scene::Scene& scene, double level) : limb_(scene, level), device_(40.0), loop_(device_, settings()) {
    const anatomy::Joint& joint = scene.specimen.joints[static_cast<std::size_t>(scene.co_contraction->joint)];
    const Pose parent = limb_.simulation().body_pose(joint.parent);
    axis_ = (parent.rotation * joint.axes[0]).normalized();
    origin_m_ = parent * joint.centre_m;
    double farthest_m = 0.0;
    for (const anatomy::Bone& bone : scene.specimen.bones) {
      if (bone.body != joint.child) continue;
      for (const Vec3& rest_m : bone.surface.positions_m) {
        const Vec3 here_m = limb_.simulation().body_pose(bone.body) * rest_m;
        if (arm_m(here_m).norm() <= farthest_m) continue;
        farthest_m = arm_m(here_m).norm();
        device_.position_m = here_m;
      }
    }
    // The gate opens in free air: a tool that presses on the limb would keep it shut.
    constexpr double kFree_m = 0.04, kNear_m = 0.005;
    const Vec3 outwards = arm_m(device_.position_m).normalized();
    device_.position_m += kFree_m * outwards;
    loop_.prepare(now_ns_ = haptics::kTickPeriod_ns);
    publish();
    run(0.3);
    move((kNear_m - kFree_m) * outwards, 0.2);
    device_.buttons = messages::kGrabBoneButton;
    run(0.4);
  }

  void run(double seconds) {
    for (long tick = 0; tick < std::lround(seconds / kTick_s); ++tick) {
      now_ns_ += haptics::kTickPeriod_ns;
      loop_.tick(now_ns_);
      for (haptics::HapticTick taken; loop_.ticks().pop(taken);) {  // the only reader of the queue
      }
      if (now_ns_ % kStep_ns != 0) continue;
      limb_.simulation().step({&loop_.tool_state(), 1});
      publish();
    }
  }
  void move(const Vec3& way_m, double seconds) {
    const long ticks = std::lround(seconds / kTick_s);
    for (long tick = 0; tick < ticks; ++tick) {
      device_.position_m += way_m / static_cast<double>(ticks);
      run(kTick_s);
    }
  }

  bool holds() const { return loop_.tool_state().grabbed_body >= 0; }
  Vec3 force_N() const { return to_vec3(loop_.tool_state().force_world_N); }
  Vec3 grip_m() {
    const messages::ToolState& tool = loop_.tool_state();
    return limb_.simulation().body_pose(tool.grabbed_body) * to_vec3(tool.body_point_rest_m);
  }
  /// From the joint's axis to a place, across the axis.
  Vec3 arm_m(const Vec3& place_m) const {
    const Vec3 from_m = place_m - origin_m_;
    return from_m - from_m.dot(axis_) * axis_;
  }
  Vec3 tangent() { return axis_.cross(arm_m(grip_m())).normalized(); }
  BalancedJoint& limb() { return limb_; }

 private:
  static haptics::HapticSettings settings() {
    haptics::HapticSettings settings;
    settings.gate.ramp_s = 0.1;
    return settings;
  }
  void publish() {
    messages::LocalModel& model = loop_.models().back();
    limb_.simulation().write_local_model(loop_.tool_state(), model);
    model.sequence = ++sequence_;
    model.published_at_ns = now_ns_;
    model.dt_ns = kStep_ns;
    model.tool_sequence = loop_.tool_state().sequence;
    loop_.models().publish();
  }

  BalancedJoint limb_;
  GuidedDevice device_;
  haptics::HapticLoop loop_;
  Vec3 axis_ = Vec3::UnitY(), origin_m_ = Vec3::Zero();
  std::uint64_t now_ns_ = 0, sequence_ = 0;
};

struct PawStiffness {
  double felt_Nm_rad = 0.0;    // force over the paw's way, times the moment arm squared
  double device_Nm_rad = 0.0;  // over the device's way, the grip in between
  double model_Nm_rad = 0.0;
  double heard_ms = 0.0;  // from a torque step to half of the force that it ends in
};

PawStiffness at_paw(const scene::Scene& scene, double level) {
  HeldPaw paw(scene, level);
  PawStiffness result;
  if (!paw.holds()) return result;
  const Vec3 along = paw.tangent();
  const double moment_arm_m = paw.arm_m(paw.grip_m()).norm(), way_m = 2e-3;
  result.model_Nm_rad = paw.limb().joint().stiffness_Nm_rad;
  std::array<double, 2> force_N{}, place_m{};
  for (std::size_t side = 0; side < 2; ++side) {
    paw.move(side == 0 ? Vec3(-way_m * along) : Vec3(2.0 * way_m * along), 0.5);
    paw.run(2.0);
    force_N[side] = paw.force_N().dot(along);
    place_m[side] = paw.grip_m().dot(along);
  }
  result.felt_Nm_rad = -(force_N[1] - force_N[0]) / (place_m[1] - place_m[0]) * moment_arm_m * moment_arm_m;
  result.device_Nm_rad = -(force_N[1] - force_N[0]) / (2.0 * way_m) * moment_arm_m * moment_arm_m;

  paw.limb().push(0.3);
  std::vector<double> after_N;
  for (int tick = 0; tick < 1000; ++tick) {
    paw.run(kTick_s);
    after_N.push_back(paw.force_N().dot(along) - force_N[1]);
  }
  const auto half = std::find_if(after_N.begin(), after_N.end(),
                                 [&](double change_N) { return std::abs(change_N) > 0.5 * std::abs(after_N.back()); });
  result.heard_ms = static_cast<double>(half - after_N.begin()) + 1.0;
  return result;
}

/// The scene with its soft muscles as lines; those that do not take part keep their shapes.
scene::Scene with_lines(const char* name) {
  scene::Scene scene = scene::load_scene(name);
  std::vector<simulation::TissueModel>& tissue = scene.settings.tissue;
  tissue.resize(scene.specimen.muscles.size(), simulation::TissueModel::Fem);
  std::replace(tissue.begin(), tissue.end(), simulation::TissueModel::Fem, simulation::TissueModel::Line);
  scene.settings.gravity_m_s2 = Vec3::Zero();
  return scene;
}

/// Adds one joint's figures; the longest time until a step of torque was felt.
double measure_joint(const char* name, const std::vector<double>& levels, GoalFigures& result) {
  const scene::Scene scene = with_lines(name);
  double worst_ms = 0.0;
  std::vector<PawStiffness> found;
  for (const double level : levels) {
    found.push_back(at_paw(scene, level));
    const PawStiffness& here = found.back();
    result.figures.push_back(
        {fmt::format("{} at a level of {}, against {:.2f} N m/rad", name, level, here.model_Nm_rad),
         100.0 * std::abs(here.felt_Nm_rad / here.model_Nm_rad - 1.0), "%", 5.0});
    worst_ms = std::max(worst_ms, here.heard_ms);
  }
  const double ratio = found.back().felt_Nm_rad / found.front().felt_Nm_rad;
  const double true_ratio = found.back().model_Nm_rad / found.front().model_Nm_rad;
  result.figures.push_back({fmt::format("{}, co-contracted over relaxed, against {:.2f}", name, true_ratio),
                            100.0 * std::abs(ratio / true_ratio - 1.0), "%", 5.0});
  result.note += fmt::format("{}{} {:.2f} and {:.2f}", result.note.empty() ? "" : ", ", name,
                             found.front().device_Nm_rad, found.back().device_Nm_rad);
  return worst_ms;
}

}  // namespace

GoalFigures measure_joint_at_paw(Effort effort) {
  const std::vector<double> levels =
      effort == Effort::Full ? std::vector{0.02, 0.1, 0.2, 0.35, 0.5} : std::vector{0.02, 0.35};
  GoalFigures result;
  double worst_ms = 0.0;
  for (const char* name : {"elbow", "stifle", "hock"})
    worst_ms = std::max(worst_ms, measure_joint(name, levels, result));
  result.figures.push_back({"torque step, until half of its force is felt", worst_ms, "ms", 30.0});
  result.note = fmt::format(
      "muscles as lines, the end of the moved bone in hand; force over the way of the bone. Over the way of the "
      "device, "
      "the grip in between: {} N m/rad",
      result.note);
  return result;
}

}  // namespace myotact::measure

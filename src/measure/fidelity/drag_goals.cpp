#include "measure/fidelity/drag_goals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "haptics/haptic_loop.h"
#include "haptics/haptic_thread.h"
#include "scene/scene_file.h"
#include "simulation/hill_muscle.h"
#include "simulation/simulation.h"

namespace myotact::measure {

namespace {

constexpr double kTick_s = 1e-3;
constexpr std::uint64_t kStep_ns = 10'000'000;

/// A stylus that is where the goal puts it, read through an encoder and a filter as a real one.
class GuidedDevice : public device::Device {
 public:
  explicit GuidedDevice(double peak_N) {
    profile_.peak_force_N = peak_N;
    profile_.coulomb_N = 0.3;
  }
  const std::string& name() const override { return name_; }
  const device::DeviceProfile& profile() const override { return profile_; }
  void open() override {}
  void close() noexcept override {}
  bool connected() const noexcept override { return true; }
  messages::DeviceState read(std::uint64_t now_ns) noexcept override {
    constexpr double kFilter_s = 5e-3;  // as the simulated device has it
    const double resolution_m = profile_.resolution_m;
    const Vec3 seen_m = (position_m / resolution_m).array().round().matrix() * resolution_m;
    if (now_ns > last_ns_ && last_ns_ > 0) {
      const double dt_s = 1e-9 * static_cast<double>(now_ns - last_ns_);
      velocity_m_s_ += dt_s / (dt_s + kFilter_s) * ((seen_m - seen_m_) / dt_s - velocity_m_s_);
    }
    seen_m_ = seen_m;
    last_ns_ = now_ns;
    return {to_array(seen_m), to_array(velocity_m_s_), now_ns, buttons};
  }
  void write(const messages::DeviceCommand&) noexcept override {}

  Vec3 position_m = Vec3::Zero();
  std::uint32_t buttons = 0;

 private:
  std::string name_ = "guided";
  device::DeviceProfile profile_;
  Vec3 seen_m_ = Vec3::Zero(), velocity_m_s_ = Vec3::Zero();
  std::uint64_t last_ns_ = 0;
};

// ---- goal 17

constexpr double kHalf_m = 0.1;       // of the strand, between its fixed ends on the x axis
constexpr double kDrag_m = 0.05;      // sideways
constexpr double kForceScale = 0.02;  // muscle tensions as a desktop stylus gives them: 2 N and less

/// Tension of a strand at a length, at rest, and its slope.
struct Strand {
  std::string name;
  std::function<double(double)> tension_N, stiffness_N_m;
};

std::vector<Strand> strands() {
  const simulation::HillMuscle hill{60.0, 0.08, 0.2, 0.115, simulation::Tendon::Elastic};
  const auto at_length = [hill](double length_m) { return simulation::hill_equilibrium(hill, length_m, 0.5); };
  return {{"linear", [](double l_m) { return 20.0 + 600.0 * (l_m - 2.0 * kHalf_m); }, [](double) { return 600.0; }},
          {"Hill muscle with an elastic tendon", [at_length](double l_m) { return at_length(l_m).force_N; },
           [at_length](double l_m) { return at_length(l_m).stiffness_N_m; }}};
}

double length_m(const Vec3& tool_m) {
  return (tool_m - kHalf_m * Vec3::UnitX()).norm() + (tool_m + kHalf_m * Vec3::UnitX()).norm();
}

/// Force of the strand on the hand: its tension along both halves.
double strand_force_N(const Strand& strand, double aside_m) {
  return 2.0 * strand.tension_N(length_m(Vec3(0, 0, aside_m))) * aside_m / std::hypot(kHalf_m, aside_m);
}

messages::LocalModel strand_model(const Strand& strand, const Vec3& tool_m) {
  messages::LocalModel model;
  model.dt_ns = kStep_ns;
  model.coverage_radius_m = 0.25;
  messages::LocalLine& line = model.line;
  line.muscle = 0;
  line.fraction = 0.5;
  line.proximal_point_world_m = {-kHalf_m, 0.0, 0.0};
  line.distal_point_world_m = {kHalf_m, 0.0, 0.0};
  line.length_m = length_m(tool_m);
  line.tension_N = strand.tension_N(line.length_m);
  line.stiffness_N_m = std::max(0.0, strand.stiffness_N_m(line.length_m));
  return model;
}

struct Drag {
  /// One a tick, after the hand has closed: sent (over the force scale), of the drag before ports and gate, true.
  std::vector<double> sent_N, alone_N, true_N;
};

/// The hand swings the strand to 50 mm and back. The strand's own step of 10 ms sees the hand at its beginning and is
/// told at its end: one step late.
Drag drag(const Strand& strand, double frequency_hz, double seconds) {
  GuidedDevice device(20.0);
  haptics::HapticSettings settings;
  settings.gate.ramp_s = 0.1;
  settings.force_scale = kForceScale;
  haptics::HapticLoop loop(device, settings);
  std::uint64_t now_ns = haptics::kTickPeriod_ns;
  loop.prepare(now_ns);
  haptics::MuscleLineDrag alone(settings.line);
  messages::LocalLine newest;
  Drag result;
  Vec3 seen_m = Vec3::Zero();
  const long settled = 600;
  for (long tick = 1; tick <= settled + std::lround(seconds / kTick_s); ++tick) {
    now_ns += haptics::kTickPeriod_ns;
    const double t_s = std::max(0.0, static_cast<double>(tick - settled) * kTick_s);
    const double aside_m = 0.5 * kDrag_m * (1.0 - std::cos(2.0 * std::numbers::pi * frequency_hz * t_s));
    device.position_m = {0.0, 0.0, aside_m};
    device.buttons = tick > settled / 2 ? messages::kGrabButton : 0;
    if (now_ns % kStep_ns == 0) {
      messages::LocalModel& model = loop.models().back();
      model = strand_model(strand, seen_m);
      model.sequence = now_ns / kStep_ns;
      model.published_at_ns = now_ns;
      newest = model.line;
      loop.models().publish();
      seen_m = device.position_m;
    }
    loop.tick(now_ns);
    const messages::DeviceState& hand = loop.last_tick().device;
    const Vec3 force_N = alone.tick(
        newest, {to_vec3(hand.stylus_position_world_m), to_vec3(hand.stylus_velocity_world_m_s), hand.buttons != 0},
        kTick_s);
    if (tick <= settled) continue;
    result.alone_N.push_back(-force_N.z());
    result.sent_N.push_back(-loop.tool_state().force_world_N[2] / kForceScale);
    result.true_N.push_back(strand_force_N(strand, aside_m));
  }
  return result;
}

/// Root of the mean square difference over that of the truth, with the truth `lag` ticks earlier.
double rms_share(const std::vector<double>& given_N, const Drag& drag, std::size_t lag) {
  double difference_N2 = 0.0, size_N2 = 0.0;
  for (std::size_t i = lag; i < given_N.size(); ++i) {
    difference_N2 += std::pow(given_N[i] - drag.true_N[i - lag], 2);
    size_N2 += std::pow(drag.true_N[i - lag], 2);
  }
  return std::sqrt(difference_N2 / size_N2);
}

// ---- goal 9

/// The elbow at the scene's pose, its muscles as lines, the scene's other joints held; balanced by an outer torque.
class Elbow {
 public:
  Elbow(const scene::Scene& scene, double level) : simulation_(scene.specimen, scene.settings) {
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
  HeldPaw(const scene::Scene& scene, double level) : elbow_(scene, level), device_(40.0), loop_(device_, settings()) {
    const anatomy::Joint& joint = scene.specimen.joints[static_cast<std::size_t>(scene.co_contraction->joint)];
    const Pose parent = elbow_.simulation().body_pose(joint.parent);
    axis_ = (parent.rotation * joint.axes[0]).normalized();
    origin_m_ = parent * joint.centre_m;
    double farthest_m = 0.0;
    for (const anatomy::Bone& bone : scene.specimen.bones) {
      if (bone.body != joint.child) continue;
      for (const Vec3& rest_m : bone.surface.positions_m) {
        const Vec3 here_m = elbow_.simulation().body_pose(bone.body) * rest_m;
        if (arm_m(here_m).norm() <= farthest_m) continue;
        farthest_m = arm_m(here_m).norm();
        device_.position_m = here_m;
      }
    }
    loop_.prepare(now_ns_ = haptics::kTickPeriod_ns);
    publish();
    run(0.3);
    device_.buttons = messages::kGrabBoneButton;
    run(0.4);
  }

  void run(double seconds) {
    for (long tick = 0; tick < std::lround(seconds / kTick_s); ++tick) {
      now_ns_ += haptics::kTickPeriod_ns;
      loop_.tick(now_ns_);
      for (haptics::HapticTick taken; loop_.ticks().pop(taken);) {  // nobody else empties the queue here
      }
      if (now_ns_ % kStep_ns != 0) continue;
      elbow_.simulation().step({&loop_.tool_state(), 1});
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
    return elbow_.simulation().body_pose(tool.grabbed_body) * to_vec3(tool.body_point_rest_m);
  }
  /// From the joint's axis to a place, across the axis.
  Vec3 arm_m(const Vec3& place_m) const {
    const Vec3 from_m = place_m - origin_m_;
    return from_m - from_m.dot(axis_) * axis_;
  }
  Vec3 tangent() { return axis_.cross(arm_m(grip_m())).normalized(); }
  Elbow& elbow() { return elbow_; }

 private:
  static haptics::HapticSettings settings() {
    haptics::HapticSettings settings;
    settings.gate.ramp_s = 0.1;
    return settings;
  }
  void publish() {
    messages::LocalModel& model = loop_.models().back();
    elbow_.simulation().write_local_model(loop_.tool_state(), model);
    model.sequence = ++sequence_;
    model.published_at_ns = now_ns_;
    model.dt_ns = kStep_ns;
    model.tool_sequence = loop_.tool_state().sequence;
    loop_.models().publish();
  }

  Elbow elbow_;
  GuidedDevice device_;
  haptics::HapticLoop loop_;
  Vec3 axis_ = Vec3::UnitY(), origin_m_ = Vec3::Zero();
  std::uint64_t now_ns_ = 0, sequence_ = 0;
};

struct PawStiffness {
  double felt_Nm_rad = 0.0;    // force over the paw's way, times the lever squared
  double device_Nm_rad = 0.0;  // over the device's way, the grip in between
  double model_Nm_rad = 0.0;
  double heard_ms = 0.0;  // from a torque step to half of the force that it ends in
};

PawStiffness at_paw(const scene::Scene& scene, double level) {
  HeldPaw paw(scene, level);
  PawStiffness result;
  if (!paw.holds()) return result;
  const Vec3 along = paw.tangent();
  const double lever_m = paw.arm_m(paw.grip_m()).norm(), way_m = 2e-3;
  result.model_Nm_rad = paw.elbow().joint().stiffness_Nm_rad;
  std::array<double, 2> force_N{}, place_m{};
  for (std::size_t side = 0; side < 2; ++side) {
    paw.move(side == 0 ? Vec3(-way_m * along) : Vec3(2.0 * way_m * along), 0.5);
    paw.run(2.0);
    force_N[side] = paw.force_N().dot(along);
    place_m[side] = paw.grip_m().dot(along);
  }
  result.felt_Nm_rad = -(force_N[1] - force_N[0]) / (place_m[1] - place_m[0]) * lever_m * lever_m;
  result.device_Nm_rad = -(force_N[1] - force_N[0]) / (2.0 * way_m) * lever_m * lever_m;

  paw.elbow().push(0.3);
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

}  // namespace

GoalFigures measure_joint_at_paw(Effort effort) {
  scene::Scene scene = scene::load_scene("elbow");
  scene.settings.tissue.assign(scene.specimen.muscles.size(), simulation::TissueModel::Line);
  scene.settings.gravity_m_s2 = Vec3::Zero();
  const std::vector<double> levels =
      effort == Effort::Full ? std::vector{0.02, 0.1, 0.2, 0.35, 0.5} : std::vector{0.02, 0.35};
  GoalFigures result;
  double worst_ms = 0.0;
  std::vector<PawStiffness> found;
  for (const double level : levels) {
    found.push_back(at_paw(scene, level));
    const PawStiffness& here = found.back();
    result.figures.push_back(
        {fmt::format("felt at the paw at a level of {}, against {:.2f} N m/rad", level, here.model_Nm_rad),
         100.0 * std::abs(here.felt_Nm_rad / here.model_Nm_rad - 1.0), "%", 5.0});
    worst_ms = std::max(worst_ms, here.heard_ms);
  }
  const double ratio = found.back().felt_Nm_rad / found.front().felt_Nm_rad;
  const double true_ratio = found.back().model_Nm_rad / found.front().model_Nm_rad;
  result.figures.push_back({fmt::format("ratio of co-contracted to relaxed, against {:.2f}", true_ratio),
                            100.0 * std::abs(ratio / true_ratio - 1.0), "%", 5.0});
  result.figures.push_back({"torque step, until half of its force is felt", worst_ms, "ms", 30.0});
  result.note = fmt::format(
      "elbow with muscles as lines, the end of the moved bone in hand; force over the way of the paw. Over the way of "
      "the device, the grip in between: {:.2f} and {:.2f} N m/rad",
      found.front().device_Nm_rad, found.back().device_Nm_rad);
  return result;
}

GoalFigures measure_line_drag(Effort effort) {
  const double seconds = effort == Effort::Full ? 20.0 : 4.0;
  GoalFigures result;
  double worst_alone = 0.0;
  for (const Strand& strand : strands()) {
    double worst = 0.0;
    std::size_t worst_lag = 0;
    for (const double frequency_hz : {0.25, 0.5, 1.0, 2.0}) {
      const Drag dragged = drag(strand, frequency_hz, seconds);
      worst = std::max(worst, rms_share(dragged.sent_N, dragged, 0));
      worst_alone = std::max(worst_alone, rms_share(dragged.alone_N, dragged, 0));
      std::size_t lag = 0;
      for (std::size_t ticks = 1; ticks <= 20; ++ticks)
        if (rms_share(dragged.sent_N, dragged, ticks) < rms_share(dragged.sent_N, dragged, lag)) lag = ticks;
      worst_lag = std::max(worst_lag, lag);
    }
    result.figures.push_back({fmt::format("{}: force sent, difference", strand.name), 100.0 * worst, "% RMS", 3.0});
    result.figures.push_back(
        {fmt::format("{}: force sent, lag", strand.name), static_cast<double>(worst_lag), "ticks", 2.0});
  }
  result.note = fmt::format(
      "0.25 to 2 Hz, {:.0f} mm sideways, strand of {:.0f} mm stepped at 100 Hz and told one step late, force scale {}; "
      "before observers of energy and gate the force differs by up to {:.1f} % RMS",
      1e3 * kDrag_m, 2e3 * kHalf_m, kForceScale, 100.0 * worst_alone);
  return result;
}

}  // namespace myotact::measure

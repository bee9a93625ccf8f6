#include "scene/conductor.h"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

#include "scene/turned_torques.h"

namespace myotact::scene {

namespace {

/// The hand starts beside the limb, out of reach of every muscle, so that the first touch is an approach.
constexpr double kStartAside_m = 0.15;
constexpr double kStartAbove_m = 0.05;  // where there are no muscles: a hand's breadth
constexpr double kStartApart_m = 0.08;  // of two hands, each from the middle: as a person holds them
constexpr double kSliderGlide_s = 0.1;  // a slider's jump is spread over this
/// Settles that mend what the table's interpolation leaves over: from 0.06 N m to below 1e-4 on the canine stifle.
constexpr int kStartCorrections = 2;

/// Where nothing is beside anything: above the middle of all bones, or over the origin where there are none.
Vec3 above_bones(const anatomy::Specimen& specimen) {
  Eigen::AlignedBox3d box(Vec3::Zero());
  if (!specimen.bones.empty()) box.setEmpty();
  for (const anatomy::Bone& bone : specimen.bones) {
    for (const Vec3& x : bone.surface.positions_m) box.extend(x);
  }
  return {box.center().x(), box.center().y(), box.max().z() + kStartAbove_m};
}

/// `side`: 1 where the limb's lateral side looks along y, -1 where it looks against it.
Vec3 beside_muscles(const anatomy::Specimen& specimen, double side) {
  Vec3 sum = Vec3::Zero();
  for (const auto& muscle : specimen.muscles) sum += muscle.skin.positions_m.front();
  return sum / static_cast<double>(specimen.muscles.size()) + side * kStartAside_m * Vec3::UnitY();
}

std::vector<double> start_angles(const Scene& scene) {
  std::vector<double> angles;
  for (const JointSetting& joint : scene.joints) angles.push_back(joint.angle_rad);
  return angles;
}

}  // namespace

Vec3 start_of_hand(const Scene& scene, std::size_t tool) {
  if (scene.settings.tether) return simulation::tether_start_m(*scene.settings.tether);
  const anatomy::Specimen& specimen = scene.specimen;
  const double side = specimen.side == "right" ? -1.0 : 1.0;
  const Vec3 start_m = specimen.muscles.empty() ? above_bones(specimen) : beside_muscles(specimen, side);
  if (scene.tools.size() < 2) return start_m;
  const double leftwards = scene.tools[tool].hand == "left" ? 1.0 : -1.0;
  return start_m + side * leftwards * kStartApart_m * Vec3::UnitX();
}

namespace {

std::vector<ScriptedHand> hands_at_start(const Scene& scene) {
  std::vector<ScriptedHand> hands;
  for (std::size_t t = 0; t < scene.tools.size(); ++t) hands.emplace_back(scene.specimen, start_of_hand(scene, t));
  return hands;
}

}  // namespace

double Conductor::Ramp::at(double time_s) const {
  if (time_s >= end_s) return to;
  if (time_s <= start_s) return from;
  return from + (time_s - start_s) / (end_s - start_s) * (to - from);
}

Conductor::Conductor(const Scene& scene, simulation::Simulation& simulation)
    : scene_(&scene),
      simulation_(&simulation),
      hands_(hands_at_start(scene)),
      shove_test_(scene.settings.dt_s),
      gravity_m_s2_(scene.settings.gravity_m_s2) {
  if (scene.co_contraction) {
    measured_torques_ = torques_ = measure_torques(scene, simulation, start_angles(scene));
    start_joint_ = simulation.joint(scene.co_contraction->joint);
  }
  settle();
}

void Conductor::restart() {
  hands_ = hands_at_start(*scene_);
  next_action_ = 0;
  script_start_s_ = simulation_->time_s();
  flexor_level_.reset();
  extensor_level_.reset();
  shoves_.clear();
  shove_test_ = ShoveTest(scene_->settings.dt_s);
  torques_ = measured_torques_;
  settle();
}

void Conductor::settle() {
  activations_.clear();
  for (const double activation : scene_->activations) activations_.push_back({0.0, 0.0, activation, activation});
  std::vector<double> excitations = scene_->activations;
  if (scene_->co_contraction) {
    const CoContraction& set = *scene_->co_contraction;
    common_ = {0.0, 0.0, set.common, set.common};
    difference_ = {0.0, 0.0, set.difference, set.difference};
    co_contracting_ = hold_posture_ = set.hold_posture;
    trim_.restart(start_joint_);
    if (co_contracting_) drive_co_contraction(0.0, excitations);
  }
  starts_at_rest_ = simulation_->settle(start_angles(*scene_), excitations);
  for (int i = 0; i < kStartCorrections && co_contracting_ && balanced_ && posture_is_held(0.0); ++i) {
    trim_.correct(simulation_->joint(scene_->co_contraction->joint));
    excitations = scene_->activations;
    drive_co_contraction(0.0, excitations);
    starts_at_rest_ = simulation_->settle(start_angles(*scene_), excitations);
  }
  for (std::size_t j = 0; j < scene_->joints.size(); ++j) {
    simulation_->set_joint_locked(static_cast<int>(j), scene_->joints[j].locked);
  }
}

void Conductor::begin(const ScriptAction& action) {
  hands_[action.tool].begin(action, *simulation_);
  const auto ramp = [&](const Ramp& now, double to) {
    return Ramp{action.start_s, action.end_s(), now.at(action.start_s), to};
  };
  if (const auto* deed = std::get_if<Activate>(&action.deed)) {
    Ramp& activation = activations_[static_cast<std::size_t>(deed->muscle)];
    activation = ramp(activation, deed->to);
  } else if (const auto* co_contract = std::get_if<CoContract>(&action.deed)) {
    common_ = ramp(common_, co_contract->common);
    difference_ = ramp(difference_, co_contract->difference);
    co_contracting_ = scene_->co_contraction.has_value();
  } else if (const auto* hold = std::get_if<HoldPosture>(&action.deed)) {
    ask_hold_posture(hold->on);
  } else if (std::holds_alternative<Shove>(action.deed)) {
    shoves_.push_back(action);
  } else if (const auto* test = std::get_if<TestShove>(&action.deed)) {
    shove_test_.start(test->joint, *simulation_);
  } else if (const auto* picture = std::get_if<TakePicture>(&action.deed)) {
    picture_ = *picture;
  }
}

void Conductor::drive_co_contraction(double time_s, std::vector<double>& excitations) {
  CoContraction set = *scene_->co_contraction;
  Balance levels;
  levels.held = true;  // nothing is to be balanced where the sides have levels of their own
  if (flexor_level_) {
    levels.flexors = flexor_level_->at(time_s);
    levels.extensors = extensor_level_->at(time_s);
  } else {
    set.common = common_.at(time_s);
    set.difference = difference_.at(time_s);
    levels = balance(torques_, set, excitations, hold_posture_ ? trim_.torque_Nm() : 0.0);
  }
  balanced_ = levels.held;
  for (const int m : set.flexors) excitations[static_cast<std::size_t>(m)] = levels.flexors;
  for (const int m : set.extensors) excitations[static_cast<std::size_t>(m)] = levels.extensors;
}

/// Not while one side is to win, and not while a shove measures the stiffness.
bool Conductor::posture_is_held(double time_s) const {
  return hold_posture_ && difference_.at(time_s) == 0.0 && shoves_.empty() && !shove_test_.under_way();
}

void Conductor::trim_posture(double time_s) {
  if (!posture_is_held(time_s)) return;
  trim_.update(simulation_->joint(scene_->co_contraction->joint), scene_->settings.dt_s);
}

void Conductor::prepare_step(double simulated_s, StepRecord& input) {
  const double time_s = simulated_s - script_start_s_;
  const double half_step_s = 0.5 * scene_->settings.dt_s;  // an action due within this step's first half starts now
  while (next_action_ < scene_->script.size() && scene_->script[next_action_].start_s <= time_s + half_step_s) {
    begin(scene_->script[next_action_++]);
  }
  input.excitations.clear();
  for (const Ramp& activation : activations_) input.excitations.push_back(activation.at(time_s));
  if (co_contracting_) {
    trim_posture(time_s);
    drive_co_contraction(time_s, input.excitations);
  }
  input.joint_torques_Nm.assign(scene_->specimen.joints.size(), 0.0);
  std::erase_if(shoves_, [&](const ScriptAction& shove) { return shove.end_s() <= time_s; });
  for (const ScriptAction& action : shoves_) {
    const auto& shove = std::get<Shove>(action.deed);
    input.joint_torques_Nm[static_cast<std::size_t>(shove.joint)] += shove.torque_Nm;
  }
  if (shove_test_.under_way()) {
    const auto joint = static_cast<std::size_t>(shove_test_.joint());
    input.joint_torques_Nm[joint] += shove_test_.next_torque_Nm(*simulation_);
  }
  input.gravity_m_s2 = gravity_m_s2_;
}

std::optional<TakePicture> Conductor::take_picture() {
  return std::exchange(picture_, std::nullopt);
}

void Conductor::ask_levels(double flexors, double extensors) {
  if (!scene_->co_contraction) return;
  const double now_s = simulation_->time_s() - script_start_s_;
  const auto glide = [&](const std::optional<Ramp>& level, double to) {
    return Ramp{now_s, now_s + kSliderGlide_s, level ? level->at(now_s) : to, to};
  };
  flexor_level_ = glide(flexor_level_, flexors);
  extensor_level_ = glide(extensor_level_, extensors);
  co_contracting_ = true;
}

void Conductor::ask_co_contraction(double common, double difference) {
  if (!scene_->co_contraction) return;
  const double now_s = simulation_->time_s() - script_start_s_;
  flexor_level_.reset();
  extensor_level_.reset();
  common_ = {now_s, now_s + kSliderGlide_s, common_.at(now_s), common};
  difference_ = {now_s, now_s + kSliderGlide_s, difference_.at(now_s), difference};
  co_contracting_ = true;
}

std::string Conductor::notice() const {
  if (!starts_at_rest_ || measured_torques_.unsettled_level) {
    return "the tissue came to no complete rest in the starting posture, so that the balance is rough; start nearer to "
           "the specimen's own posture, or without contact";
  }
  if (simulation_->particle_lost()) {
    return "the particle flew away: explicit integration gains energy in every step of its swing; choose \"implicit\", "
           "or a smaller dt_s, and reset";
  }
  if (const int muscle = simulation_->stuck_line(); muscle >= 0) {
    return "the line of " + scene_->specimen.muscles[static_cast<std::size_t>(muscle)].key +
           " cannot clear its wrap surface in this posture: its end lies inside it, so that its lever is not to be "
           "trusted; turn the joint back, or move the wrap or the end in the specimen";
  }
  if (balanced_ || !co_contracting_) return "";
  const std::string& joint = scene_->specimen.joints[static_cast<std::size_t>(scene_->co_contraction->joint)].key;
  return "the muscles cannot balance the " + joint +
         " in this posture: the passive pull of one side is more than the other can hold; choose a posture nearer to "
         "the middle of its range";
}

void Conductor::ask_shove_test() {
  if (scene_->co_contraction) shove_test_.start(scene_->co_contraction->joint, *simulation_);
}

void Conductor::ask_hold_posture(bool on) {
  if (on && !hold_posture_ && scene_->co_contraction) {
    std::vector<double> present_rad;
    for (std::size_t j = 0; j < scene_->joints.size(); ++j) {
      present_rad.push_back(simulation_->joint(static_cast<int>(j)).angle_rad);
    }
    torques_ = turned_torques(measured_torques_, *scene_, start_angles(*scene_), present_rad);
    trim_.restart(simulation_->joint(scene_->co_contraction->joint));
  }
  hold_posture_ = on;
}

double Conductor::script_end_s() const {
  double end_s = 0.0;
  for (const ScriptAction& action : scene_->script) end_s = std::max(end_s, action.end_s());
  return end_s;
}

void apply(const StepRecord& input, simulation::Simulation& simulation) {
  for (std::size_t m = 0; m < input.excitations.size(); ++m) {
    simulation.set_excitation(static_cast<int>(m), input.excitations[m]);
  }
  for (std::size_t j = 0; j < input.joint_torques_Nm.size(); ++j) {
    simulation.set_joint_torque(static_cast<int>(j), input.joint_torques_Nm[j]);
  }
  simulation.set_gravity(input.gravity_m_s2);
}

}  // namespace myotact::scene

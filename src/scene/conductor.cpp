#include "scene/conductor.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "scene/rotated_torques.h"

namespace myotact::scene {

namespace {

/// The hand starts beside the limb, out of reach of every muscle, so that the first touch is an approach.
constexpr double kStartAside_m = 0.15;
constexpr double kStartAbove_m = 0.05;  // where there are no muscles: a hand's breadth
constexpr double kStartApart_m = 0.08;  // of two hands, each from the middle: as a person holds them
/// Settles that mend what the table's interpolation leaves over: from 0.06 N m to below 1e-4 on the canine stifle.
constexpr int kStartCorrections = 2;
/// Of what a person asks for, from none to all [1/s]. At once it swings the elbow by 2.2 degrees, since no two muscles
/// gather force alike; in a second by 0.6.
constexpr double kFastestDrive_1_s = 1.0;

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

double Conductor::now_s() const {
  return simulation_->time_s() - script_start_s_;
}

/// The torque table is kept. The clock runs on: times of the script count from here. What a person set stays.
void Conductor::obey(const messages::Reset&, const When&) {
  const messages::ControlState before = control();
  const messages::Commander holder = holder_;
  hands_ = hands_at_start(*scene_);
  next_action_ = 0;
  script_start_s_ = simulation_->time_s();
  flexor_level_.reset();
  extensor_level_.reset();
  drive_ = messages::Drive::Script;
  driver_ = holder_ = messages::Commander::Script;
  shoves_.clear();
  shove_test_ = ShoveTest(scene_->settings.dt_s);
  torques_ = measured_torques_;
  settle();
  if (before.drive == messages::Drive::Levels)
    apply({messages::SetLevels{before.flexors, before.extensors}, before.driver});
  if (before.drive == messages::Drive::Balance)
    apply({messages::CoContract{before.common, before.difference}, before.driver});
  if (holder != messages::Commander::Script) apply({messages::HoldPosture{before.hold_posture}, holder});
}

void Conductor::settle() {
  activations_.clear();
  for (const double activation : scene_->activations) activations_.push_back({0.0, 0.0, activation, activation});
  std::vector<double> excitations = scene_->activations;
  if (scene_->co_contraction) {
    const CoContraction& set = *scene_->co_contraction;
    common_ = {0.0, 0.0, set.common, set.common};
    difference_ = {0.0, 0.0, set.difference, set.difference};
    scripted_ = {set.common, set.difference};
    scripted_end_s_ = 0.0;
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
  if (moves_hand(action.what)) return hands_[action.tool].begin(action, *simulation_);
  if (const auto* picture = std::get_if<TakePicture>(&action.what)) picture_ = *picture;
  std::visit(
      [&](const auto& what) {
        if constexpr (std::is_constructible_v<messages::Order, decltype(what)>) {
          carry_out({what, messages::Commander::Script, action.duration_s}, action.start_s);
        }
      },
      action.what);
}

void Conductor::apply(const messages::Command& command) {
  carry_out(command, now_s());
}

void Conductor::carry_out(const messages::Command& command, double start_s) {
  const When when{command.by, start_s, start_s + command.over_s};
  std::visit(
      [&]<class Order>(const Order& order) {
        // These are the session's: they say whether there is a step at all.
        if constexpr (!messages::kIsOneOf<Order, messages::Pause, messages::SingleStep, messages::EndRecording>) {
          obey(order, when);
        }
      },
      command.order);
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
  if (!from_ && std::exchange(holds_from_there_, false)) apply({messages::HoldPosture{true}, holder_});
  input.from = std::exchange(from_, std::nullopt);
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
  std::erase_if(shoves_, [&](const Push& push) { return push.end_s <= time_s; });
  for (const Push& push : shoves_) {
    input.joint_torques_Nm[static_cast<std::size_t>(push.shove.joint)] += push.shove.torque_Nm;
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

/// Who asks again for what leads already does not begin its glide anew.
void Conductor::obey(const messages::SetLevels& levels, const When& when) {
  if (!scene_->co_contraction) return;
  const bool leads = flexor_level_ && flexor_level_->to == levels.flexors && extensor_level_->to == levels.extensors;
  if (leads) return;
  const auto glide = [&](const std::optional<Ramp>& level, double to) {
    return Ramp{when.start_s, when.end_s, level ? level->at(when.start_s) : to, to};
  };
  flexor_level_ = glide(flexor_level_, levels.flexors);
  extensor_level_ = glide(extensor_level_, levels.extensors);
  drive_ = messages::Drive::Levels;
  driver_ = when.by;
  co_contracting_ = true;
}

void Conductor::balance_by(const messages::CoContract& balance, const When& when) {
  flexor_level_.reset();
  extensor_level_.reset();
  common_ = {when.start_s, when.end_s, common_.at(when.start_s), balance.common};
  difference_ = {when.start_s, when.end_s, difference_.at(when.start_s), balance.difference};
  co_contracting_ = true;
}

/// As SetLevels; the script is heard while a person leads, and obeyed when it leads again. What a person asks for at
/// once comes as fast as the joint can bear.
void Conductor::obey(const messages::CoContract& balance, const When& when) {
  if (!scene_->co_contraction) return;
  const bool is_scripts = when.by == messages::Commander::Script;
  if (is_scripts) {
    scripted_ = balance;
    scripted_end_s_ = when.end_s;
    if (drive_ != messages::Drive::Script) return;
  } else {
    const bool same = common_.to == balance.common && difference_.to == balance.difference;
    if (drive_ == messages::Drive::Balance && same) return;
    drive_ = messages::Drive::Balance;
    driver_ = when.by;
  }
  const double way = std::max(std::abs(balance.common - common_.at(when.start_s)),
                              std::abs(balance.difference - difference_.at(when.start_s)));
  const double soonest_s = is_scripts ? when.end_s : when.start_s + way / kFastestDrive_1_s;
  balance_by(balance, {when.by, when.start_s, std::max(when.end_s, soonest_s)});
}

/// Where the script never drove the balance, the levels that the scene began with stand for it.
void Conductor::obey(const messages::FollowScript&, const When& when) {
  if (drive_ == messages::Drive::Script) return;
  drive_ = messages::Drive::Script;
  driver_ = messages::Commander::Script;
  balance_by(scripted_, {when.by, when.start_s, std::max(when.end_s, scripted_end_s_)});
}

void Conductor::obey(const messages::Activate& activate, const When& when) {
  Ramp& activation = activations_[static_cast<std::size_t>(activate.muscle)];
  activation = {when.start_s, when.end_s, activation.at(when.start_s), activate.to};
}

void Conductor::obey(const messages::HoldPosture& hold, const When& when) {
  holder_ = when.by;
  if (hold.on && !hold_posture_ && scene_->co_contraction) {
    std::vector<double> present_rad;
    for (std::size_t j = 0; j < scene_->joints.size(); ++j) {
      present_rad.push_back(simulation_->joint(static_cast<int>(j)).angle_rad);
    }
    torques_ = rotated_torques(measured_torques_, *scene_, start_angles(*scene_), present_rad);
    trim_.restart(simulation_->joint(scene_->co_contraction->joint));
  }
  hold_posture_ = hold.on;
}

void Conductor::obey(const messages::SetGravity& gravity, const When&) {
  constexpr double kGravity_m_s2 = 9.81;
  const Vec3& own_m_s2 = scene_->settings.gravity_m_s2;
  const Vec3 down_m_s2 = own_m_s2.isZero() ? Vec3(0.0, 0.0, -kGravity_m_s2) : own_m_s2;
  gravity_m_s2_ = gravity.on ? down_m_s2 : Vec3::Zero();
}

/// What it means to a hand is the session's: it has the loop.
void Conductor::obey(const messages::ChooseTool& choice, const When&) {
  if (choice.tool < 0 || static_cast<std::size_t>(choice.tool) >= scene_->tools.size()) return;
  tools_chosen_.at(static_cast<std::size_t>(choice.tool)) = choice.shape;
}

void Conductor::obey(const messages::Shove& shove, const When& when) {
  shoves_.push_back({shove, when.end_s});
}

void Conductor::obey(const messages::TestShove& test, const When&) {
  const int joint = test.joint < 0 && scene_->co_contraction ? scene_->co_contraction->joint : test.joint;
  if (joint >= 0) shove_test_.start(joint, *simulation_);
}

messages::ControlState Conductor::control() const {
  const double time_s = now_s();
  messages::ControlState state;
  state.drive = drive_;
  state.driver = driver_;
  const bool script_drives = drive_ == messages::Drive::Script;
  state.common = script_drives ? common_.at(time_s) : common_.to;
  state.difference = script_drives ? difference_.at(time_s) : difference_.to;
  if (co_contracting_) state.common_now = common_.at(time_s);
  if (flexor_level_) {
    state.flexors = flexor_level_->to;
    state.extensors = extensor_level_->to;
    state.common_now = std::min(flexor_level_->at(time_s), extensor_level_->at(time_s));
  }
  state.hold_posture = hold_posture_;
  state.gravity = gravity_m_s2_.norm() > 0.0;
  state.tools = tools_chosen_;
  return state;
}

/// The first muscle in use whose tissue does not pull as its line does.
std::string Conductor::weak_tissue() const {
  constexpr double kWorthSaying = 0.3;
  for (int m = 0; m < simulation_->muscle_count(); ++m) {
    const double pull = simulation_->pull_over_line(m);
    if (simulation_->excitation(m) == 0.0 || std::abs(pull - 1.0) <= kWorthSaying) continue;
    return fmt::format(
        "{} of finite elements pulls {:.0f} % of what its line would: its mesh cannot stand for it; choose \"line\" or "
        "\"rigid\" for it under /tissue/muscles",
        scene_->specimen.muscles[static_cast<std::size_t>(m)].key, std::isfinite(pull) ? 100.0 * pull : 0.0);
  }
  return "";
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
           " cannot clear its wrap surface in this posture: its end lies inside it, so that its moment arm is not to "
           "be "
           "trusted; rotate the joint back, or move the wrap or the end in the specimen";
  }
  if (balanced_ || !co_contracting_) return weak_tissue();
  const std::string& joint = scene_->specimen.joints[static_cast<std::size_t>(scene_->co_contraction->joint)].key;
  return "the muscles cannot balance the " + joint +
         " in this posture: the passive pull of one side is more than the other can hold; choose a posture nearer to "
         "the middle of its range";
}

double Conductor::script_end_s() const {
  double end_s = 0.0;
  for (const ScriptAction& action : scene_->script) end_s = std::max(end_s, action.end_s());
  return end_s;
}

void apply(const StepRecord& input, simulation::Simulation& simulation) {
  if (input.from) simulation.settle(input.from->angles_rad, input.from->activations);
  for (std::size_t m = 0; m < input.excitations.size(); ++m) {
    simulation.set_excitation(static_cast<int>(m), input.excitations[m]);
  }
  for (std::size_t j = 0; j < input.joint_torques_Nm.size(); ++j) {
    simulation.set_joint_torque(static_cast<int>(j), input.joint_torques_Nm[j]);
  }
  simulation.set_gravity(input.gravity_m_s2);
}

}  // namespace myotact::scene

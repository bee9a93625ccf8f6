#include "haptics/haptic_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "haptics/faults.h"
#include "haptics/stiffness_bound.h"

namespace myotact::haptics {

namespace {

constexpr std::size_t kTicksKept = 8192;  // 8 s of ticks: a recorder that writes files may be held up that long
/// Ticks are 1 ms; what lies outside of these bounds is a clock that stood still or a stopped process.
constexpr double kShortestTick_s = 1e-5;
constexpr double kLongestTick_s = 0.02;

bool is_finite(const std::array<double, 3>& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

constexpr double kFelt_N = 0.02;    // less force than this moves no device: nothing can buzz
constexpr double kSoften_s = 0.02;  // a stiffness that is too much is gone before a second swing
constexpr double kStiffen_s = 0.5;  // and comes back without a push
constexpr double kTold_J = 0.1e-3;  // what a port may lack before it is called a fault: a count of an encoder at 5 N

std::uint32_t of_clamp(std::uint32_t buttons) {
  const bool line = (buttons & messages::kGrabButton) != 0;
  return line ? (buttons & ~messages::kGrabButton) | messages::kGrabBoneButton : buttons;
}

/// The settings as this loop's device bears them.
HapticSettings bearable(HapticSettings settings, const device::DeviceProfile& profile) {
  settings.bone.force_scale = settings.force_scale;
  if (!settings.limit_stiffness) return settings;
  const double most_N_m = stiffness_bound(profile).smallest_N_m();
  settings.bone.stiffness_N_m = std::min(settings.bone.stiffness_N_m, most_N_m);
  settings.contact.stiffness_N_m = std::min(settings.contact.stiffness_N_m, most_N_m);
  return settings;
}

}  // namespace

Vec3 coupling_force_N(const Proxy& proxy, const ProxyGoal& device, const ContactSettings& settings) noexcept {
  const ProxyContact& contact = proxy.contact();
  if (!contact.active) return Vec3::Zero();
  const Vec3 spring_N = settings.stiffness_N_m * (proxy.position_m() - device.position_m);
  const double approach_m_s = std::max(0.0, -contact.normal.dot(device.velocity_m_s - contact.velocity_m_s));
  const double normal_N = spring_N.dot(contact.normal);
  const Vec3 tangential_N = spring_N - normal_N * contact.normal;
  return tangential_N + std::max(0.0, normal_N + settings.damping_Ns_m * approach_m_s) * contact.normal;
}

HapticLoop::HapticLoop(device::Device& device, const HapticSettings& settings)
    : device_(device),
      settings_(bearable(settings, device.profile())),
      ticks_(kTicksKept),
      proxy_(settings_.contact),
      texture_(settings_.texture),
      line_(settings_.line),
      snap_(settings_.snap),
      bone_(settings_.bone),
      plane_(settings_.contact.radius_m),
      pulling_({settings_.bone.stiffness_N_m, settings_.force_scale}),
      stiffest_tether_N_m_(settings.limit_stiffness ? stiffness_bound(device.profile()).smallest_N_m()
                                                    : std::numeric_limits<double>::infinity()),
      ports_(device.profile()),
      buzz_(device.profile().resolution_m),
      notice_(settings.limit_stiffness ? stiffness_notice(device.profile(), settings.contact.stiffness_N_m) : ""),
      gate_(device.profile(), settings_.gate) {}

void HapticLoop::prepare(std::uint64_t now_ns) {
  device_.open();
  const messages::DeviceState state = device_.read(now_ns);
  if (is_finite(state.stylus_position_world_m)) {
    last_.tool.tool_position_world_m = state.stylus_position_world_m;
    last_.tool.proxy_position_world_m = state.stylus_position_world_m;  // around which the first model is looked up
  }
  last_.tool.time_ns = now_ns;
  tools_.publish(last_.tool);
  last_ns_ = now_ns;
  gate_.enable();
}

void HapticLoop::tick(std::uint64_t now_ns) noexcept {
  const bool forwards = ticked_ && now_ns > last_ns_;
  dt_s_ = forwards ? std::clamp(1e-9 * static_cast<double>(now_ns - last_ns_), kShortestTick_s, kLongestTick_s) : 1e-3;
  ticked_ = true;
  last_ns_ = now_ns;
  faults_ = missed_ ? bit(Fault::MissedDeadline) : 0;
  missed_ = false;

  const messages::DeviceState state = device_.read(now_ns);
  if ((state.buttons & messages::kStopButton) != 0) gate_.stop();
  const bool is_new = take_model(now_ns);
  Vec3 contact_N = Vec3::Zero();
  PortForces felt;
  forces_ = {};
  const bool device_is_sound = is_finite(state.stylus_position_world_m) && is_finite(state.stylus_velocity_world_m_s);
  if (device_is_sound) {
    const ProxyGoal goal{to_vec3(state.stylus_position_world_m), to_vec3(state.stylus_velocity_world_m_s)};
    soften(goal.position_m);
    const std::uint32_t buttons = settings_.takes_bones_only ? of_clamp(state.buttons) : state.buttons;
    felt.bone_N = bone_force_N(goal, buttons, is_new);
    contact_N = contact_force_N(goal, now_ns, is_new);
    felt.contact_N = settings_.force_scale * contact_N;
    felt.texture_N = settings_.force_scale * texture_force_N(goal, contact_N);
    const messages::LocalLine nothing_near;
    const messages::LocalLine& line = model_ == nullptr ? nothing_near : model_->line;
    const bool open = line_.gain() <= 0.0 && held_.body < 0;
    forces_.strummed_N = settings_.force_scale * snap_.tick(line, goal.position_m, open, dt_s_);
    felt.texture_N += forces_.strummed_N;
    const Vec3 line_N =
        line_.tick(line, {goal.position_m, goal.velocity_m_s, (buttons & messages::kGrabButton) != 0}, dt_s_);
    felt.line_N = settings_.force_scale * line_N;
    tether_ = tether_spring(now_ns);
    felt.tether_N = tether_.force_N(goal.position_m);
    forces_.wanted = felt;
    felt = make_passive(felt, goal);
    forces_.ports_change_N = felt.sum_N() - forces_.wanted.sum_N();
  } else {
    faults_ |= bit(Fault::NonFiniteDevice);
  }
  const Vec3 nowhere = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  const Vec3 position_m = device_is_sound ? to_vec3(state.stylus_position_world_m) : nowhere;
  const Vec3 sent_N = gate_and_write(felt.sum_N(), position_m, state.buttons, now_ns);
  ports_.book(sent_N);
  forces_.gate_damping_N = gate_.damping_N();
  forces_.sent_N = sent_N;
  faults_ |= proxy_faults();
  tell(state, sent_N, contact_N);
}

/// True: a new model is in use. An unsound one is left alone, and with it the surface: the reader's slot now holds it.
bool HapticLoop::take_model(std::uint64_t now_ns) noexcept {
  if (!models_.update()) return false;
  if (!is_sound(models_.front())) {
    faults_ |= bit(Fault::BadModel);
    model_ = nullptr;
    return false;
  }
  model_ = &models_.front();
  model_interval_ns_ = model_arrived_ns_ != 0 && now_ns > model_arrived_ns_ ? now_ns - model_arrived_ns_ : 0;
  model_arrived_ns_ = now_ns;
  return true;
}

Vec3 HapticLoop::bone_force_N(const ProxyGoal& goal, std::uint32_t buttons, bool is_new) noexcept {
  const bool holds = (buttons & messages::kGrabBoneButton) != 0;
  const auto held_by = [](const auto& method) {
    return HeldBone{method.body(), method.point_rest_m(), method.gain(), method.stiffness_N_m(), method.target_m()};
  };
  Vec3 force_N;
  if (settings_.method == ForceMethod::Pulling) {
    force_N = pulling_.tick(model_, goal.position_m, holds, gate_.limit_N());
    held_ = held_by(pulling_);
  } else {
    const std::uint64_t sequence = last_.tool.sequence + 1;
    force_N = bone_.tick(model_, is_new, {goal.position_m, goal.velocity_m_s, holds, gate_.limit_N(), sequence}, dt_s_);
    held_ = held_by(bone_);
  }
  return force_N;
}

TetherSpring HapticLoop::tether_spring(std::uint64_t now_ns) const noexcept {
  if (model_ == nullptr || !(model_->tether.stiffness_N_m > 0.0)) return {};
  const double wanted_N_m = settings_.force_scale * model_->tether.stiffness_N_m;
  return {tether_anchor_m(*model_, now_ns), std::min(wanted_N_m, stiffest_tether_N_m_), gate_.limit_N()};
}

bool HapticLoop::goes_by_reports() const noexcept {
  return settings_.method == ForceMethod::Penetration || settings_.method == ForceMethod::Plane;
}

Vec3 HapticLoop::contact_force_N(const ProxyGoal& goal, std::uint64_t now_ns, bool is_new) noexcept {
  if (model_ != nullptr) surface_.begin_tick(*model_, now_ns, is_new);
  Vec3 force_N = goes_by_reports() ? reported_force_N(goal.position_m, is_new) : proxy_force_N(goal, now_ns);
  const double peak_N = gate_.limit_N() / settings_.force_scale;  // the tissue feels no more than the hand
  if (force_N.norm() > peak_N) force_N *= peak_N / force_N.norm();
  tissue_shift_m_ = compliance_.tissue_shift_m(force_N);
  return force_N;
}

Vec3 HapticLoop::proxy_force_N(const ProxyGoal& goal, std::uint64_t now_ns) noexcept {
  const bool nothing_known = model_ == nullptr || (model_->triangle_count == 0 && !(model_->coverage_radius_m > 0.0));
  if (nothing_known) {
    proxy_.follow(goal.position_m);
    compliance_.forget();
    return Vec3::Zero();
  }
  const Vec3 unloaded_m = -compliance_.shift_m();
  compliance_.bear(contact_share() * settings_.contact.stiffness_N_m);
  compliance_.tick(*model_, proxy_.contact(), now_ns, dt_s_);
  unloaded_moved_m_ = -compliance_.shift_m() - unloaded_m;
  ContactSettings felt = settings_.contact;
  felt.stiffness_N_m = compliance_.felt_stiffness_N_m();
  felt.damping_Ns_m *= contact_share();
  const ProxyGoal played{goal.position_m + compliance_.shift_m(), goal.velocity_m_s};
  proxy_.couple(felt.stiffness_N_m, felt.damping_Ns_m);
  proxy_.tick(surface_, *model_, played, dt_s_);
  return contact_share() > 0.0 ? coupling_force_N(proxy_, played, felt) : Vec3::Zero();
}

WayOut HapticLoop::reported_way_out(const Vec3& tool_m) const noexcept {
  return settings_.method == ForceMethod::Plane ? plane_.way_out(tool_m) : penetration_.way_out();
}

/// The proxy stands where the way out ends. A report that makes the spring jump from d0 to d1 changes its energy by
/// k (d1^2 - d0^2) / 2; per force k d0, that is a motion of its end.
Vec3 HapticLoop::reported_force_N(const Vec3& tool_m, bool is_new) noexcept {
  penetration_.move(tool_m);
  const Vec3 before_m = reported_way_out(tool_m).way_m;
  if (is_new || model_ == nullptr) {
    const messages::ReportedContacts nothing;
    const messages::ReportedContacts& reported = model_ == nullptr ? nothing : model_->reported;
    penetration_.take(reported);
    plane_.take(reported);
  }
  way_out_ = reported_way_out(tool_m);
  const double before_m2 = before_m.squaredNorm();
  reported_moved_m_ =
      before_m2 > 0.0 ? Vec3((0.5 * (way_out_.way_m.squaredNorm() / before_m2 - 1.0)) * before_m) : Vec3::Zero();
  proxy_.follow(tool_m + way_out_.way_m);
  return reported_stiffness_N_m() * way_out_.way_m;
}

/// A hand that holds the bone does not also press on it: two springs would be stiffer than the device stands.
double HapticLoop::contact_share() const noexcept {
  return (1.0 - held_.gain) * age_share_ * buzz_.stiffness_share();
}

/// Of the state that the newest model shows. The simulation looked at the hand at the beginning of the step that ended
/// with this model; steps may take longer than the time that they simulate.
double HapticLoop::model_age_s() const noexcept {
  if (model_ == nullptr) return 0.0;
  const std::uint64_t since_ns = last_ns_ > model_->published_at_ns ? last_ns_ - model_->published_at_ns : 0;
  const std::uint64_t step_ns = std::max(model_->dt_ns, model_interval_ns_);
  return 1e-9 * (static_cast<double>(since_ns) + static_cast<double>(step_ns));
}

void HapticLoop::soften(const Vec3& device_m) noexcept {
  if (buzz_.tick(device_m, to_vec3(last_.tool.force_world_N).norm() > kFelt_N, dt_s_)) faults_ |= bit(Fault::Buzz);
  if (model_ == nullptr || !settings_.limit_stiffness) return;
  const double age_s = std::max(1e-3, model_age_s());
  const double bears = std::min(1.0, stiffness_by_age_N_m(age_s) / settings_.contact.stiffness_N_m);
  age_share_ += std::min(1.0, dt_s_ / (bears < age_share_ ? kSoften_s : kStiffen_s)) * (bears - age_share_);
  if (bears < 1.0) faults_ |= bit(Fault::StiffnessLowered);
}

PortForces HapticLoop::make_passive(const PortForces& felt, const ProxyGoal& goal) noexcept {
  PortsTick tick;
  tick.wanted = felt;
  tick.hand_m = goal.position_m;
  tick.dt_s = dt_s_;
  tick.texture_held_J = settings_.force_scale * snap_.held_J();
  // The contact's spring, tissue included, ends where the tissue would be without the tool.
  tick.proxy_m = proxy_.position_m() - compliance_.shift_m();
  if (proxy_.contact().active) {
    tick.texture_held_J += settings_.force_scale * texture_.held_J();
    tick.tissue_moved_m = dt_s_ * proxy_.contact().velocity_m_s + unloaded_moved_m_;
    tick.contact_stiffness_N_m = settings_.force_scale * compliance_.felt_stiffness_N_m();
  } else if (goes_by_reports()) {
    tick.tissue_moved_m = reported_moved_m_;
    if (way_out_.bearing >= 0) tick.contact_stiffness_N_m = settings_.force_scale * reported_stiffness_N_m();
  }
  if (model_ != nullptr && line_.muscle() >= 0 && model_->line.muscle == line_.muscle()) tick.line = &model_->line;
  tick.line_gain = settings_.force_scale * line_.gain();
  tick.body = held_.body;
  tick.body_stiffness_N_m = settings_.force_scale * held_.stiffness_N_m;
  tick.body_point_m = held_.target_m;
  if (tick.body_stiffness_N_m > 0.0) tick.body_point_m += felt.bone_N / tick.body_stiffness_N_m;
  tick.tether = tether_;
  const PortForces passive = ports_.admit(tick);
  if (ports_.missing_J() > kTold_J) faults_ |= bit(Fault::EnergyInjected);
  return passive;
}

/// For the hand only: the tissue feels the contact's force, about which texture goes to and fro.
Vec3 HapticLoop::texture_force_N(const ProxyGoal& goal, const Vec3& contact_N) noexcept {
  const double normal_N = std::max(0.0, contact_N.dot(proxy_.contact().normal));
  return texture_.tick_N(surface_, proxy_.contact(), {goal, normal_N, settings_.contact.stiffness_N_m, dt_s_});
}

Vec3 HapticLoop::gate_and_write(const Vec3& wanted_N, const Vec3& position_m, std::uint32_t buttons,
                                std::uint64_t now_ns) noexcept {
  GateInput input;
  input.wanted_N = wanted_N;
  input.device_position_m = position_m;
  input.connected = device_.connected();
  input.cut = cut_;
  input.clutched = (buttons & messages::kClutchButton) != 0;
  input.damping_Ns_m = ports_.damping_Ns_m();
  cut_ = false;
  input.has_model = model_ != nullptr;
  input.now_ns = now_ns;
  input.model_arrived_ns = model_arrived_ns_;
  input.step_ns = model_ == nullptr ? 0 : model_->dt_ns;
  const Vec3 sent_N = gate_.admit(input);
  faults_ |= gate_.faults();
  device_.write({to_array(sent_N)});
  return sent_N;
}

std::uint32_t HapticLoop::proxy_faults() noexcept {
  const ProxyCounters& now = proxy_.counters();
  std::uint32_t faults = 0;
  if (now.rescues != counted_.rescues) faults |= bit(Fault::ProxyRescued);
  if (now.over_budget != counted_.over_budget) faults |= bit(Fault::ProxyBudget);
  counted_ = now;
  return faults;
}

void HapticLoop::tell(const messages::DeviceState& state, const Vec3& sent_N, const Vec3& contact_N) noexcept {
  messages::ToolState& tool = last_.tool;
  ++tool.sequence;
  tool.time_ns = last_ns_;
  tool.model_sequence = model_ == nullptr ? 0 : model_->sequence;
  if ((faults_ & bit(Fault::NonFiniteDevice)) == 0) tool.tool_position_world_m = state.stylus_position_world_m;
  tool.proxy_position_world_m = to_array(proxy_.position_m() + tissue_shift_m_);
  tool.force_world_N = to_array(sent_N);
  tool.contact = {};
  tool.touched_world_m = {};
  if ((faults_ & bit(Fault::NonFiniteDevice)) == 0 && contact_share() > 0.0) tell_contact(contact_N, tool);
  tool.buttons = state.buttons;
  tool.faults = faults_;
  tell_grabs(tool);
  tools_.publish(tool);
  last_.device = state;
  last_.model_sequence = tool.model_sequence;
  last_.line_tension_N = line_.tension_N();
  last_.gate = gate_.state();
  ticks_.push(last_);
  tell_felt();
}

void HapticLoop::tell_felt() noexcept {
  const ProxyContact& contact = proxy_.contact();
  if (!goes_by_reports() && contact.active) forces_.contact_normal = contact.normal;
  felt_now_ = {last_.tool, force_parts(forces_), last_.line_tension_N, model_age_s()};
  felt_.publish(felt_now_);
}

/// The spring pulls the touched point with the opposite of what the hand feels, as long as the tissue is where it is
/// believed to be; its rest place follows the device.
void HapticLoop::tell_contact(const Vec3& contact_N, messages::ToolState& tool) const noexcept {
  const ProxyContact& contact = proxy_.contact();
  if (contact.active) {
    const Vec3 touched_m = contact.point_m + tissue_shift_m_;
    const double stiffness_N_m = compliance_.coupling_stiffness_N_m();
    tool.contact = {contact.surface,
                    contact.triangle,
                    contact.barycentric,
                    to_array(contact.normal),
                    to_array(touched_m - contact_N / stiffness_N_m),
                    stiffness_N_m};
    tool.touched_world_m = to_array(touched_m);
  } else if (goes_by_reports() && way_out_.bearing >= 0) {
    const messages::ReportedContact& reported = model_->reported.contacts[static_cast<std::size_t>(way_out_.bearing)];
    const Vec3 lowest_m =
        to_vec3(tool.tool_position_world_m) - settings_.contact.radius_m * to_vec3(reported.normal_world);
    const Vec3 touched_m = lowest_m + way_out_.depth_m * to_vec3(reported.normal_world);
    const double stiffness_N_m = reported_stiffness_N_m();
    tool.contact = {reported.surface, -1, {}, reported.normal_world, to_array(touched_m - contact_N / stiffness_N_m),
                    stiffness_N_m};
    tool.touched_world_m = to_array(touched_m);
  }
}

void HapticLoop::tell_grabs(messages::ToolState& tool) const noexcept {
  tool.grabbed_line = line_.muscle();
  tool.grab_fraction = line_.fraction();
  tool.line_stiffness_N_m = line_.muscle() >= 0 ? line_.grab_stiffness_N_m() : 0.0;
  tool.grabbed_body = held_.body;
  tool.body_point_rest_m = held_.point_rest_m;
  tool.body_target_world_m = to_array(held_.target_m);
  tool.body_stiffness_N_m = held_.stiffness_N_m;
}

}  // namespace myotact::haptics

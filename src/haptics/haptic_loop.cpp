#include "haptics/haptic_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "haptics/faults.h"
#include "haptics/gate/stiffness_bound.h"
#include "haptics/proxy/moving_surface.h"

namespace myotact::haptics {

namespace {

constexpr std::size_t kTicksKept = 8192;  // 8 s of ticks: a recorder that writes files may be held up that long
/// Ticks are 1 ms; what lies outside of these bounds is a clock that stood still or a stopped process.
constexpr double kShortestTick_s = 1e-5;
constexpr double kLongestTick_s = 0.02;

bool is_finite(const std::array<double, 3>& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

/// A hand that is held off stays so for two steps after the end was asked for: a scene may be put elsewhere between two
/// ticks, and the way of the surface is played over the step after.
constexpr int kEndingTicks = 20;

/// What a port may lack before it is called a fault: a count of an encoder at 5 N.
constexpr double kReportedEnergy_J = 0.1e-3;

std::uint32_t of_clamp(std::uint32_t buttons) {
  const bool line = (buttons & messages::kGrabButton) != 0;
  return line ? (buttons & ~messages::kGrabButton) | messages::kGrabBoneButton : buttons;
}

/// The settings as this loop's device supports them.
HapticSettings limited_to_device(HapticSettings settings, const device::DeviceProfile& profile) {
  settings.bone.force_scale = settings.force_scale;
  if (!settings.limit_stiffness) return settings;
  const double most_N_m = stiffness_bound(profile).smallest_N_m();
  settings.bone.stiffness_N_m = std::min(settings.bone.stiffness_N_m, most_N_m);
  settings.contact.stiffness_N_m = std::min(settings.contact.stiffness_N_m, most_N_m);
  return settings;
}

}  // namespace

HapticLoop::HapticLoop(device::Device& device, const HapticSettings& settings)
    : device_(device),
      settings_(limited_to_device(settings, device.profile())),
      ticks_(kTicksKept),
      effects_(settings_, device.profile()),
      ports_(device.profile()),
      gate_(device.profile(), settings_.gate),
      notice_(settings.limit_stiffness ? stiffness_notice(device.profile(), settings.contact.stiffness_N_m) : ""),
      held_{settings.shape, settings.contact.radius_m},
      chosen_(held_) {}

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
  advance_clock(now_ns);
  faults_ = missed_ ? bit(Fault::MissedDeadline) : 0;
  missed_ = false;
  const messages::DeviceState state = read_device(now_ns);
  if ((state.buttons & messages::kStopButton) != 0) gate_.stop();
  change_tool();
  const bool is_new = take_model();
  forces_ = {};
  device_is_sound_ = is_finite(state.stylus_position_world_m) && is_finite(state.stylus_velocity_world_m_s);
  Vec3 felt_N = Vec3::Zero();
  if (device_is_sound_) {
    felt_N = felt_force_N(hand_tick(state, is_new));
  } else {
    faults_ |= bit(Fault::NonFiniteDevice);
  }
  forces_.sent_N = gate_and_write(felt_N, state);
  ports_.book(forces_.sent_N);
  forces_.gate_damping_N = gate_.damping_N();
  report(state);
}

/// In the device's own buttons, so that who records and repeats them need not know of it.
messages::DeviceState HapticLoop::read_device(std::uint64_t now_ns) noexcept {
  messages::DeviceState state = device_.read(now_ns);
  HoldOff hold = held_off_.load(std::memory_order_acquire);
  if (hold == HoldOff::No) return state;
  state.buttons = (state.buttons & messages::kStopButton) | messages::kClutchButton;
  ending_ticks_ = hold == HoldOff::Ending ? ending_ticks_ + 1 : 0;
  if (ending_ticks_ < kEndingTicks) return state;
  ending_ticks_ = 0;
  held_off_.compare_exchange_strong(hold, HoldOff::No);  // unless somebody asks again just now
  return state;
}

void HapticLoop::advance_clock(std::uint64_t now_ns) noexcept {
  const bool forwards = ticked_ && now_ns > last_ns_;
  dt_s_ = forwards ? std::clamp(1e-9 * static_cast<double>(now_ns - last_ns_), kShortestTick_s, kLongestTick_s) : 1e-3;
  ticked_ = true;
  last_ns_ = now_ns;
}

/// Not while anything of the old tool's force gets through: a sphere of another size has another force.
void HapticLoop::change_tool() noexcept {
  if (choices_.update()) chosen_ = choices_.front();
  if (chosen_ == held_ || !gate_.is_shut()) return;
  effects_.change_tool(chosen_.radius_m);
  held_ = chosen_;
}

/// True: a new model is in use. An unsound one is left alone, and with it the surface: the reader's slot now holds it.
bool HapticLoop::take_model() noexcept {
  if (!models_.update()) return false;
  if (!is_sound(models_.front())) {
    faults_ |= bit(Fault::BadModel);
    model_ = nullptr;
    return false;
  }
  model_ = &models_.front();
  model_interval_ns_ = model_arrived_ns_ != 0 && last_ns_ > model_arrived_ns_ ? last_ns_ - model_arrived_ns_ : 0;
  model_arrived_ns_ = last_ns_;
  return true;
}

/// Of the state that the newest model shows. The simulation looked at the hand at the beginning of the step that ended
/// with this model; steps may take longer than the time that they simulate.
double HapticLoop::model_age_s() const noexcept {
  if (model_ == nullptr) return 0.0;
  const std::uint64_t since_ns = last_ns_ > model_->published_at_ns ? last_ns_ - model_->published_at_ns : 0;
  const std::uint64_t step_ns = std::max(model_->dt_ns, model_interval_ns_);
  return 1e-9 * (static_cast<double>(since_ns) + static_cast<double>(step_ns));
}

HandTick HapticLoop::hand_tick(const messages::DeviceState& state, bool is_new) const noexcept {
  HandTick hand;
  hand.hand = {to_vec3(state.stylus_position_world_m), to_vec3(state.stylus_velocity_world_m_s)};
  hand.buttons = held_.shape == messages::ToolShape::Clamp ? of_clamp(state.buttons) : state.buttons;
  hand.model = model_;
  hand.is_new = is_new;
  hand.model_age_s = model_age_s();
  hand.now_ns = last_ns_;
  hand.dt_s = dt_s_;
  hand.sequence = last_.tool.sequence + 1;
  hand.limit_N = gate_.limit_N();
  hand.sent_N = to_vec3(last_.tool.force_world_N).norm();
  return hand;
}

/// What the effects want together, as their ports admit it.
Vec3 HapticLoop::felt_force_N(const HandTick& hand) noexcept {
  forces_.wanted = effects_.tick(hand);
  forces_.passed_lines_N = effects_.notes().passed_lines_N;
  std::array<PortTick, kEffectCount> ports;
  Vec3 wanted_N = forces_.wanted[0].force_N;
  for (std::size_t i = 0; i < kEffectCount; ++i) {
    const EffectTick& effect = forces_.wanted[i];
    if (i > 0) wanted_N += effect.force_N;
    faults_ |= effect.faults;
    ports[i] = effect.port;
    ports[i].wanted_N = effect.force_N;
  }
  const Vec3 felt_N = ports_.admit(ports, {hand.hand.position_m, hand.dt_s});
  forces_.ports_change_N = felt_N - wanted_N;
  if (ports_.missing_J() > kReportedEnergy_J) faults_ |= bit(Fault::EnergyInjected);
  return felt_N;
}

Vec3 HapticLoop::gate_and_write(const Vec3& wanted_N, const messages::DeviceState& state) noexcept {
  const Vec3 nowhere = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  GateInput input;
  input.wanted_N = wanted_N;
  input.device_position_m = device_is_sound_ ? to_vec3(state.stylus_position_world_m) : nowhere;
  input.connected = device_.connected();
  input.cut = cut_;
  input.changing = chosen_ != held_;
  input.clutched = (state.buttons & messages::kClutchButton) != 0;
  input.damping_Ns_m = ports_.damping_Ns_m();
  cut_ = false;
  input.has_model = model_ != nullptr;
  input.now_ns = last_ns_;
  input.model_arrived_ns = model_arrived_ns_;
  input.step_ns = model_ == nullptr ? 0 : model_->dt_ns;
  const Vec3 sent_N = gate_.admit(input);
  faults_ |= gate_.faults();
  device_.write({to_array(sent_N)});
  return sent_N;
}

/// To simulation, recorder and drawing.
void HapticLoop::report(const messages::DeviceState& state) noexcept {
  messages::ToolState& tool = last_.tool;
  ++tool.sequence;
  tool.time_ns = last_ns_;
  tool.model_sequence = model_ == nullptr ? 0 : model_->sequence;
  if (device_is_sound_) tool.tool_position_world_m = state.stylus_position_world_m;
  tool.force_world_N = to_array(forces_.sent_N);
  tool.buttons = state.buttons;
  tool.faults = faults_;
  effects_.report(tool);
  if (!device_is_sound_) {  // what was touched before is not touched now
    tool.contact = {};
    tool.beside = {};
    tool.touched_world_m = {};
  }
  tools_.publish(tool);
  const EffectNotes& notes = effects_.notes();
  last_.device = state;
  last_.model_sequence = tool.model_sequence;
  last_.line_tension_N = notes.line_tension_N;
  last_.gate = gate_.state();
  last_.chosen = chosen_.shape;
  ticks_.push(last_);
  if (notes.touch.contact.active) forces_.contact_normal = notes.touch.contact.normal;
  felt_now_ = {tool, force_parts(forces_), last_.line_tension_N, model_age_s(), held_};
  felt_.publish(felt_now_);
}

}  // namespace myotact::haptics

#include "device/drivers/touch/frame_validator.h"

#include <algorithm>
#include <cmath>

namespace myotact::device::touch {

namespace {

constexpr double kMillimetre = 1e-3;
/// What no hand does between two frames: 5 m/s, and on top what comes late.
constexpr double kFastestHand_m_s = 5.0, kSlack_m = 0.005;
constexpr std::uint64_t kLeapRest_ns = 100'000'000;  // without force after it: many frames that agree

/// What was too much for a moment is over soon; motors cool in seconds; a device that does not answer is to have
/// answered for a while before it pushes again.
Consequence consequence_of(Code error) {
  constexpr std::uint64_t kMoment_ns = 100'000'000, kCooling_ns = 2'000'000'000, kDoubt_ns = 1'000'000'000;
  switch (error) {
    case kWarmMotors:
      return {kCooling_ns, "The motors are warm: let them rest."};
    case kExceededForce:
    case kForceImpulse:
    case kForceError:
      return {kMoment_ns, "The device refused a force; it goes on by itself."};
    case kExceededVelocity:
      return {kMoment_ns, "The stylus moved too fast; it goes on by itself."};
    case kDeviceFault:
    case kCommunication:
    case kCommunicationSettings:
    case kTimer:
      return {kDoubt_ns,
              "The device does not answer: see to its cable and its power; if that does not help, open the scene again "
              "or start anew.",
              true};
    default:
      return {kDoubt_ns, "The device reports an error; it goes on when there is none any more."};
  }
}

const char* calibration_hint(Code style) {
  if ((style & kInkwell) != 0) return "Put the stylus into the inkwell.";
  if ((style & kAutomatic) != 0) return "Move the stylus through its whole reach.";
  return "Hold the stylus in its rest position: the encoders are set anew.";
}

std::uint32_t buttons_of(int raw) {
  std::uint32_t buttons = 0;
  if ((raw & 1) != 0) buttons |= messages::kGrabButton;
  if ((raw & 2) != 0) buttons |= messages::kClutchButton;
  if ((raw & 4) != 0) buttons |= messages::kGrabBoneButton;
  return buttons;
}

}  // namespace

bool FrameValidator::leaps(const Vec3& position_m, std::uint64_t now_ns) const noexcept {
  if (state_.sampled_at_ns == 0 || now_ns <= state_.sampled_at_ns) return false;
  const double most_m = kSlack_m + kFastestHand_m_s * 1e-9 * static_cast<double>(now_ns - state_.sampled_at_ns);
  return (position_m - to_vec3(state_.stylus_position_world_m)).norm() > most_m;
}

void FrameValidator::distrust(const Consequence& consequence, std::uint64_t now_ns) noexcept {
  distrusted_until_ns_ = std::max(distrusted_until_ns_, now_ns + consequence.rest_ns);
  fault_hint_ = consequence.hint;
  is_silence_ = consequence.is_silence;
}

void FrameValidator::take(const RawFrame& frame, std::uint64_t now_ns) noexcept {
  const Vec3 position_mm = to_vec3(frame.position_mm), velocity_mm_s = to_vec3(frame.velocity_mm_s);
  Code error = frame.error;
  if (!position_mm.allFinite() || !velocity_mm_s.allFinite()) {
    error = error == kNone ? Code{kDeviceFault} : error;
  } else {
    const Vec3 position_m = kMillimetre * (position_mm - middle_mm_);
    if (leaps(position_m, now_ns))
      distrust({kLeapRest_ns, "The device's answers are not to be believed for the moment."}, now_ns);
    state_.stylus_position_world_m = to_array(position_m);
    state_.stylus_velocity_world_m_s = to_array(Vec3(kMillimetre * velocity_mm_s));
    state_.sampled_at_ns = now_ns;
    state_.buttons = buttons_of(frame.buttons);
  }
  if (error != kNone) distrust(consequence_of(error), now_ns);
  if (now_ns < distrusted_until_ns_) {
    phase_ = DevicePhase::Lost;
    hint_ = fault_hint_;
  } else if (frame.calibration != kCalibrated) {
    phase_ = DevicePhase::NeedsCalibration;
    hint_ = calibration_hint(frame.style);
  } else {
    phase_ = DevicePhase::Ready;
    hint_ = "";
  }
}

Vec3 FrameValidator::allowed(const std::array<double, 3>& wanted_N, double peak_N) const noexcept {
  const Vec3 force_N = to_vec3(wanted_N);
  const double size_N = force_N.norm();
  if (phase_ != DevicePhase::Ready || !std::isfinite(size_N)) return Vec3::Zero();
  return size_N > peak_N ? Vec3(force_N * (peak_N / size_N)) : force_N;
}

}  // namespace myotact::device::touch

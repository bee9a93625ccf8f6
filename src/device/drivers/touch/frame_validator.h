#pragma once

#include <array>
#include <cstdint>

#include "core/vector.h"
#include "device/drivers/touch/hdapi.h"
#include "device/hardware_device.h"

namespace myotact::device::touch {

/// What the library reports of a device in one frame, in its units.
struct RawFrame {
  std::array<double, 3> position_mm{}, velocity_mm_s{};
  int buttons = 0;
  Code error = kNone;              // of this frame or the one before
  Code calibration = kCalibrated;  // as it was last asked for
  Code style = kInkwell;           // of calibration
};

/// What follows from something wrong.
struct Consequence {
  std::uint64_t rest_ns;  // without force, from the newest of them on
  const char* hint;
  bool is_silence = false;  // the device may be gone
};

/// Which frames are to be believed: a force is allowed where the device is calibrated, nothing was wrong for a while
/// and the position is a number that a hand could have reached. Pure, on the clock that it is given; real-time safe.
class FrameValidator {
 public:
  /// `middle_mm`: of the workspace, in the library's frame, whose axes are ours.
  explicit FrameValidator(const Vec3& middle_mm) : middle_mm_(middle_mm) {}

  void take(const RawFrame& frame, std::uint64_t now_ns) noexcept;
  /// A force as it may be sent: none unless Ready, finite and asked for; never beyond `peak_N`.
  Vec3 allowed(const std::array<double, 3>& wanted_N, double peak_N) const noexcept;

  DevicePhase phase() const noexcept { return phase_; }
  const char* hint() const noexcept { return hint_; }
  /// Lost since it did not answer, so that it may have to be opened anew.
  bool is_silent() const noexcept { return phase_ == DevicePhase::Lost && is_silence_; }
  const messages::DeviceState& state() const noexcept { return state_; }  // the newest that was a number

 private:
  bool leaps(const Vec3& position_m, std::uint64_t now_ns) const noexcept;
  void distrust(const Consequence& consequence, std::uint64_t now_ns) noexcept;

  Vec3 middle_mm_;
  DevicePhase phase_ = DevicePhase::Opening;
  const char* hint_ = "";
  messages::DeviceState state_;
  std::uint64_t distrusted_until_ns_ = 0;
  const char* fault_hint_ = "";  // while it is distrusted
  bool is_silence_ = false;      // why
};

}  // namespace myotact::device::touch

#include "device/drivers/touch/touch_device.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "realtime/periodic_loop.h"

namespace myotact::device::touch {

namespace {

constexpr std::uint64_t kWindow_ns = 1'000'000'000;
constexpr std::uint64_t kSilence_ns = 500'000'000;  // of a servo thread that should tick: its device is gone
// Frames between looks: what they cost the library is not known, and a tick has a millisecond for all.
constexpr std::uint64_t kCalibrationEvery = 10;
constexpr std::uint64_t kMotorsEvery = 100;

/// As assets/devices/touch.json, whose sources hold here, too; what the device reports itself replaces it.
DeviceProfile touch_profile(const TouchSettings& settings) {
  DeviceProfile profile;
  profile.max_stiffness_N_m = settings.max_stiffness_N_m;
  profile.inertia_kg = 0.045;
  profile.coulomb_N = 0.2;
  profile.resolution_m = 5.5e-5;
  return profile;
}

}  // namespace

Trouble trouble_of(const Hdapi& api, Code error) {
  Trouble trouble{"it does not open: " + api.text_of(error), ""};
  trouble.remedy = error == kAlreadyOpen
                       ? "end the other program that uses it"
                       : "see to its cable and its power, try the maker's own test program, and let this computer's "
                         "user open it by assets/devices/udev/70-myotact.rules";
  return trouble;
}

TouchDevice::TouchDevice(std::string name, std::string configuration, const TouchSettings& settings,
                         std::shared_ptr<TouchLibrary> library)
    : name_(std::move(name)),
      configuration_(std::move(configuration)),
      library_(std::move(library)),
      profile_(touch_profile(settings)) {}

void TouchDevice::open() {
  if (phase_ != DevicePhase::Closed) return;
  if (library_->servo.is_ticking()) {
    throw Error(ExitStatus::Unavailable, name_ + ": another Touch is being felt; open both before the first is");
  }
  acquire();
  learn_profile();
  validator_ = FrameValidator(middle_mm_);
  library_->servo.add(*this);
}

/// What it can support stays as it was learnt: the loops that feel it have heard of it.
void TouchDevice::recover(bool hung) {
  if (handle_ != kNoDevice && !hung && !validator_.is_silent()) return;
  release();
  acquire();
  validator_ = FrameValidator(middle_mm_);
}

void TouchDevice::acquire() {
  api().take_error();
  handle_ = api().init_device(configuration_.empty() ? nullptr : configuration_.c_str());
  Code error = api().take_error();
  if (error == kNone && handle_ != kNoDevice) {
    api().enable(kForceOutput);
    error = api().take_error();
  }
  if (error != kNone || handle_ == kNoDevice) {
    release();
    const Trouble trouble = trouble_of(api(), error);
    throw Error(ExitStatus::Unavailable, fmt::format("{}: {}; {}", name_, trouble.cause, trouble.remedy));
  }
  raw_ = {};
  raw_.calibration = kCalibrationNeedsInput;  // until it was asked for
  end_error_ = kNone;
  tells_warmth_ = true;
  frames_ = counted_ = counted_from_ns_ = 0;
  framed_ns_ = 0;
  phase_ = DevicePhase::Opening;
}

void TouchDevice::release() noexcept {
  if (handle_ == kNoDevice) return;
  api().disable_device(handle_);
  api().take_error();
  handle_ = kNoDevice;
}

/// What is no sensible number is not taken.
void TouchDevice::learn_profile() {
  const auto number = [&](Code parameter, double lowest, double highest, double fallback) {
    double value = 0.0;
    api().get_doublev(parameter, &value);
    return api().take_error() == kNone && value >= lowest && value <= highest ? value : fallback;
  };
  profile_.peak_force_N = number(kNominalMaxForce, 0.1, 100.0, profile_.peak_force_N);
  profile_.continuous_force_N = number(kNominalContinuous, 0.05, profile_.peak_force_N,
                                       std::min(profile_.continuous_force_N, profile_.peak_force_N));
  std::array<double, 6> corners_mm{};
  api().get_doublev(kUsableWorkspace, corners_mm.data());
  const Vec3 lowest_mm(corners_mm[0], corners_mm[1], corners_mm[2]);
  const Vec3 edges_mm = Vec3(corners_mm[3], corners_mm[4], corners_mm[5]) - lowest_mm;
  constexpr double kSmallest_mm = 10.0, kLargest_mm = 2000.0;
  const bool is_one = api().take_error() == kNone && lowest_mm.allFinite() && edges_mm.allFinite() &&
                      edges_mm.minCoeff() >= kSmallest_mm && edges_mm.maxCoeff() <= kLargest_mm;
  if (is_one) profile_.workspace_m = to_array(Vec3(1e-3 * edges_mm));
  middle_mm_ = is_one ? Vec3(lowest_mm + 0.5 * edges_mm) : Vec3::Zero();
}

void TouchDevice::close() noexcept {
  if (phase_ == DevicePhase::Closed) return;
  library_->servo.remove(*this);
  release();
  phase_ = DevicePhase::Closed;
}

void TouchDevice::write(const messages::DeviceCommand& command) noexcept {
  wanted_N_ = command.force_world_N;
}

void TouchDevice::begin_frame(std::uint64_t now_ns) noexcept {
  api().begin_frame(handle_);
  api().get_doublev(kPosition, raw_.position_mm.data());
  api().get_doublev(kVelocity, raw_.velocity_mm_s.data());
  api().get_integerv(kButtons, &raw_.buttons);
  raw_.error = end_error_;
  const auto note = [this](Code error) { raw_.error = error != kNone ? error : raw_.error; };
  note(api().take_error());
  if (frames_ % kMotorsEvery == 0) note(look_after_motors());
  if (frames_ % kCalibrationEvery == 0) note(look_after_calibration());
  validator_.take(raw_, now_ns);
  phase_ = validator_.phase();
  hint_ = validator_.hint();
  wanted_N_ = {};  // what is not written in this frame is no force
  ++frames_;
  count_rate(now_ns);
  framed_ns_ = now_ns;
}

void TouchDevice::end_frame(bool is_last) noexcept {
  const Vec3 force_N = is_last ? Vec3::Zero() : validator_.allowed(wanted_N_, profile_.peak_force_N);
  api().make_current(handle_);
  api().set_doublev(kForce, force_N.data());
  api().end_frame(handle_);
  end_error_ = api().take_error();
}

/// A calibration that the library can bring up to date by itself is; the position may leap by it, so that no force
/// comes before it was asked for again. Returns what went wrong.
Code TouchDevice::look_after_calibration() noexcept {
  raw_.calibration = api().check_calibration();
  if (raw_.calibration == kCalibrated) return api().take_error();
  raw_.style = api().check_calibration_style();
  if (raw_.calibration != kCalibrationNeedsUpdate) return api().take_error();
  for (const Code style : {kInkwell, kAutomatic, kEncoderReset}) {
    if ((raw_.style & style) == 0) continue;
    api().update_calibration(style);
    break;
  }
  return api().take_error();
}

/// A model that does not report its motors' temperature is not asked again. Returns what went wrong.
Code TouchDevice::look_after_motors() noexcept {
  if (!tells_warmth_) return kNone;
  std::array<double, 6> warmth{};
  api().get_doublev(kMotorTemperature, warmth.data());
  const Code error = api().take_error();
  tells_warmth_ = !is_of_call(error);
  const bool is_told =
      tells_warmth_ && std::all_of(warmth.begin(), warmth.end(), [](double w) { return std::isfinite(w); });
  warmth_ = is_told ? std::clamp(*std::max_element(warmth.begin(), warmth.end()), 0.0, 1.0) : -1.0;
  return tells_warmth_ ? error : kNone;
}

void TouchDevice::count_rate(std::uint64_t now_ns) noexcept {
  if (counted_from_ns_ == 0) counted_from_ns_ = now_ns;
  ++counted_;
  if (now_ns - counted_from_ns_ < kWindow_ns) return;
  rate_Hz_ = 1e9 * static_cast<double>(counted_) / static_cast<double>(now_ns - counted_from_ns_);
  counted_ = 0;
  counted_from_ns_ = now_ns;
}

DeviceReport TouchDevice::report() const noexcept {
  DeviceReport report{phase_, rate_Hz_, warmth_, hint_};
  if (report.phase == DevicePhase::Closed) return {};
  if (!library_->servo.is_ticking()) return {DevicePhase::Opening, 0.0, warmth_, ""};
  const std::uint64_t framed_ns = framed_ns_;
  if (framed_ns != 0 && realtime::steady_now_ns() > framed_ns + kSilence_ns) {
    report.phase = DevicePhase::Lost;
    report.rate_Hz = 0.0;
    report.hint =
        "The device's servo loop has stopped: plug the device in again and open the scene again or start anew.";
  }
  return report;
}

}  // namespace myotact::device::touch

#include "device/drivers/inverse/exchange.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace myotact::device::inverse {

namespace {

/// What a hand does not do between two states: 10 m/s, and 1 cm on top for states that came late together.
constexpr double kFastestHand_m_s = 10.0;
constexpr double kJumpSlack_m = 0.01;
/// The gate before us keeps to the peak. A little more is cut; this much more is an error.
constexpr double kSane = 2.0;
constexpr std::uint64_t kForceLife_ns = 20'000'000;  // age of the state that a force answers
/// Commands without an answer, the second of no force, beyond which none is sent: they are answered in order, and a
/// force behind a queue of them would come late for ever.
constexpr int kMostOwed = 2;
constexpr std::uint64_t kRateSpan_ns = 1'000'000'000;

constexpr const char* kServiceGone = "Start the Inverse Service (haply-inverse-service) again.";
constexpr const char* kDeviceGone = "Check the power and the USB cable of the Inverse3.";
constexpr const char* kNotUnderstood = "The Inverse Service sends what Myotact does not understand: check its version.";

std::uint64_t since(std::uint64_t then_ns, std::uint64_t now_ns) {
  return now_ns > then_ns ? now_ns - then_ns : 0;  // threads read the clock one after the other
}

/// Zero for what is not finite or far beyond `peak_N`, cut to it otherwise.
Vec3 limited_N(const Vec3& force_N, double peak_N) {
  const double norm_N = force_N.norm();
  if (!(norm_N <= kSane * peak_N)) return Vec3::Zero();
  return norm_N <= peak_N ? force_N : Vec3(force_N * (peak_N / norm_N));
}

/// The grip's first button takes hold of a muscle, the second is the clutch, the third takes hold of a bone, a fourth
/// stops.
std::uint32_t stylus_buttons(std::uint32_t grip) {
  const auto as = [&](std::uint32_t bit, std::uint32_t meaning) { return (grip & bit) != 0 ? meaning : 0u; };
  return as(1, messages::kGrabButton) | as(2, messages::kClutchButton) | as(4, messages::kGrabBoneButton) |
         as(8, messages::kStopButton);
}

}  // namespace

Exchange::Exchange(std::string id, std::size_t place, const InverseSettings& settings)
    : id_(std::move(id)), place_(place), settings_(settings) {}

void Exchange::begin(CommandForm form, std::uint64_t now_ns) {
  form_ = form;
  good_ = 0;
  owed_ = 0;
  position_service_m_.setConstant(std::numeric_limits<double>::quiet_NaN());  // none of an earlier connection
  sent_ns_ = answered_ns_ = 0;
  heard_ns_ = now_ns;
  counted_from_ns_ = now_ns;
  exchanges_ = 0;
  hint_ = "";
  phase_ = DevicePhase::Opening;
}

void Exchange::end(DevicePhase phase) {
  fault(phase == DevicePhase::Lost ? kServiceGone : "");
  phase_ = phase;
  rate_Hz_ = 0.0;
}

void Exchange::fault(const char* hint) {
  good_ = 0;
  sample_.epoch = 0;
  samples_.publish(sample_);
  hint_ = hint;
  if (phase_ == DevicePhase::Ready) phase_ = DevicePhase::Lost;
}

std::string Exchange::take(std::string_view text, std::uint64_t now_ns) {
  owed_ = std::max(0, owed_ - 1);
  answered_ns_ = now_ns;
  count(now_ns);
  std::string problem = read_message(text, message_);
  if (!problem.empty()) {
    fault(kNotUnderstood);
    return problem;
  }
  if (owed_ > 0) return "";  // an answer to an earlier command: what it reports is old
  const auto device = std::find_if(message_.devices.begin(), message_.devices.end(),
                                   [&](const DeviceEntry& entry) { return entry.id == id_; });
  if (device == message_.devices.end()) {
    heard_ns_ = now_ns;  // the service is there, the device is not
    fault(kDeviceGone);
    return fmt::format("the service no longer knows the device {}", id_);
  }
  return take_device(*device, now_ns);
}

std::string Exchange::take_device(const DeviceEntry& device, std::uint64_t now_ns) {
  const auto& axes = device.position_service_m;
  // Without any position nothing is fresh: left to the limit of silence, since the origin, where all three could be
  // left out, is in the mounting plate.
  const bool has_position = axes[0] || axes[1] || axes[2];
  const Vec3 last_m = position_service_m_;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    position_service_m_[static_cast<int>(i)] = axes[i].value_or(last_m[static_cast<int>(i)]);
  }
  if (!has_position || !position_service_m_.allFinite()) return fmt::format("the state of {} has no position", id_);
  const double jump_m = (position_service_m_ - last_m).norm();
  const double farthest_m = kJumpSlack_m + kFastestHand_m_s * 1e-9 * static_cast<double>(since(heard_ns_, now_ns));
  heard_ns_ = now_ns;
  if (good_ > 0 && jump_m > farthest_m) {
    fault(kDeviceGone);
    return fmt::format("the position of {} jumps by {:.3f} m; at most {:.3f} m are a hand's", id_, jump_m, farthest_m);
  }
  if (++good_ >= kGoodBeforeReady && phase_ != DevicePhase::Ready) {
    ++epoch_;
    hint_ = "";
    phase_ = DevicePhase::Ready;
  }
  const Vec3 from_middle_m = position_service_m_ - settings_.workspace_middle_service_m;
  sample_ = {to_array(device_from_service(from_middle_m)), to_array(device_from_service(device.velocity_service_m_s)),
             place_ < message_.grips.size() ? stylus_buttons(message_.grips[place_].buttons) : 0, now_ns,
             phase_ == DevicePhase::Ready ? epoch_ : 0};
  samples_.publish(sample_);
  return "";
}

std::uint64_t Exchange::silence_ns(std::uint64_t now_ns) {
  const std::uint64_t silence_ns = since(heard_ns_, now_ns);
  if (silence_ns > kSilence_ns && good_ > 0) fault(kServiceGone);
  return silence_ns;
}

std::uint64_t Exchange::due_ns() const {
  if (owed_ == 0) return sent_ns_ + kExchange_ns;
  if (answered_ns_ > sent_ns_) return answered_ns_ + kSilence_ns;  // it answers no more: nothing is queued there
  if (owed_ < kMostOwed) return sent_ns_ + kSilence_ns;
  return std::numeric_limits<std::uint64_t>::max();  // with its answer, or in a new connection
}

const std::string& Exchange::next_command(std::uint64_t now_ns) {
  silence_ns(now_ns);
  owed_ = answered_ns_ > sent_ns_ ? 1 : owed_ + 1;
  sent_ns_ = now_ns;
  write_force_command(id_, service_from_device(force_to_send_N(now_ns)), form_, command_);
  return command_;
}

Vec3 Exchange::force_to_send_N(std::uint64_t now_ns) {
  answers_.update();
  const Answer& answer = answers_.front();
  if (phase_ != DevicePhase::Ready || answer.epoch != epoch_) return Vec3::Zero();
  if (since(answer.received_ns, now_ns) > kForceLife_ns) return Vec3::Zero();  // the tick stands still
  return limited_N(to_vec3(answer.force_N), settings_.profile.peak_force_N);
}

void Exchange::count(std::uint64_t now_ns) {
  ++exchanges_;
  const std::uint64_t span_ns = since(counted_from_ns_, now_ns);
  if (span_ns < kRateSpan_ns) return;
  rate_Hz_ = 1e9 * exchanges_ / static_cast<double>(span_ns);
  counted_from_ns_ = now_ns;
  exchanges_ = 0;
}

messages::DeviceState Exchange::read(std::uint64_t now_ns) noexcept {
  samples_.update();
  const Sample& sample = samples_.front();
  const bool is_fresh =
      phase_ == DevicePhase::Ready && sample.epoch != 0 && since(sample.received_ns, now_ns) <= kSilence_ns;
  is_fresh_ = is_fresh;
  if (!is_fresh) return {sample.position_m, {}, sample.received_ns, 0};
  return {sample.position_m, sample.velocity_m_s, sample.received_ns, sample.buttons};
}

void Exchange::write(const messages::DeviceCommand& command) noexcept {
  const Sample& sample = samples_.front();
  answers_.publish(Answer{command.force_world_N, sample.received_ns, is_fresh_ ? sample.epoch : 0});
}

DeviceReport Exchange::report() const noexcept {
  return {phase_, rate_Hz_, -1.0, hint_};
}

}  // namespace myotact::device::inverse

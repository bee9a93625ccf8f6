#include "app/device_bench.h"

#include <algorithm>
#include <ostream>
#include <thread>

#include <fmt/format.h>

#include "app/interruption.h"
#include "realtime/periodic_loop.h"

namespace myotact::app {

namespace {

constexpr std::chrono::milliseconds kPeriod(10);  // of the models that hold the pull: as often as a simulation's steps

device::ServoClock* servo_of(device::HardwareDevice* device) {
  return device == nullptr ? nullptr : device->servo_clock();
}

haptics::HapticSettings settings_for(const device::Device& device, double most_N) {
  haptics::HapticSettings settings;
  settings.gate.force_limit = std::min(settings.gate.force_limit, most_N / device.profile().peak_force_N);
  return settings;
}

}  // namespace

DeviceBench::DeviceBench(device::Device& device, device::HardwareDevice* on_table, realtime::Watchdog* watchdog,
                         double most_N)
    : on_table_(on_table),
      most_N_(std::min(most_N, haptics::GateSettings{}.force_limit * device.profile().peak_force_N)),
      loop_(device, settings_for(device, most_N)),
      thread_(loop_, watchdog, servo_of(on_table)) {
  loop_.prepare(realtime::steady_now_ns());
  thread_.start();
}

bool DeviceBench::wait_until_ready(std::ostream& out) {
  std::string shown;
  while (on_table_ != nullptr && on_table_->report().phase != device::DevicePhase::Ready) {
    const std::string hint = on_table_->report().hint;
    if (hint != shown && !hint.empty()) out << hint << '\n' << std::flush;
    shown = hint;
    run(kPeriod);
    if (interruption() != 0) return false;
  }
  faults_ = 0;  // of what it was not yet ready for
  return true;
}

void DeviceBench::run(std::chrono::milliseconds duration) {
  for (auto left = duration; left > left.zero() && interruption() == 0; left -= kPeriod) {
    publish();
    std::this_thread::sleep_for(kPeriod);
    look();
  }
}

std::optional<std::string> DeviceBench::wait_for_line(LineInput& answers) {
  while (interruption() == 0) {
    publish();
    auto line = answers.next(kPeriod);
    look();
    if (answers.ended()) return std::nullopt;
    if (line) return line;
  }
  return std::nullopt;
}

void DeviceBench::pull_to(const Vec3& anchor_m) {
  anchor_m_ = anchor_m;
  pulls_ = Pull::ToPoint;
}

void DeviceBench::pull_with(const Vec3& force_N) {
  anchor_m_ = force_N / kPull_N_m;
  pulls_ = Pull::WithForce;
}

void DeviceBench::publish() {
  messages::LocalModel& model = loop_.models().back();
  model = {};
  model.sequence = ++sequence_;
  model.published_at_ns = realtime::steady_now_ns();
  model.dt_ns = static_cast<std::uint64_t>(std::chrono::nanoseconds(kPeriod).count());
  const Vec3 anchor_m = pulls_ == Pull::WithForce ? Vec3(position_m_ + anchor_m_) : anchor_m_;
  if (pulls_ != Pull::No) model.tether = {kPull_N_m, to_array(anchor_m), {}};
  loop_.models().publish();
}

void DeviceBench::look() {
  for (haptics::HapticTick tick; loop_.ticks().pop(tick);) {
    position_m_ = to_vec3(tick.device.stylus_position_world_m);
    lowest_m_ = seen_ ? Vec3(lowest_m_.cwiseMin(position_m_)) : position_m_;
    highest_m_ = seen_ ? Vec3(highest_m_.cwiseMax(position_m_)) : position_m_;
    seen_ = true;
    buttons_ |= tick.device.buttons;
    faults_ |= tick.tool.faults;
    largest_N_ = std::max(largest_N_, to_vec3(tick.tool.force_world_N).norm());
  }
}

std::string DeviceBench::range() const {
  std::string text = "   reached [mm]:";
  for (int k = 0; k < 3; ++k) {
    text += fmt::format("  {} {:.1f} .. {:.1f}", kDeviceAxes[k], 1e3 * lowest_m_[k], 1e3 * highest_m_[k]);
  }
  text += "\n   buttons seen:";
  for (int button = 0; button < 32; ++button) {
    if ((buttons_ >> button & 1u) != 0) text += fmt::format(" {}", button + 1);
  }
  return text + (buttons_ == 0 ? " none\n" : "\n");
}

std::string DeviceBench::rate() const {
  const realtime::DurationSummary periods = thread_.periods().summary();
  const double median_us = 1e-3 * static_cast<double>(periods.p50_ns);
  std::string text =
      fmt::format("3. Rate: period {:.0f} us (median), {:.0f} us (99 %), {:.0f} us (longest); {} of {} ticks missed\n",
                  median_us, 1e-3 * static_cast<double>(periods.p99_ns), 1e-3 * static_cast<double>(periods.max_ns),
                  thread_.missed_count(), thread_.tick_count());
  if (on_table_ != nullptr)
    text += fmt::format("   exchanges with the device: {:.0f} Hz\n", on_table_->report().rate_Hz);
  return text;
}

}  // namespace myotact::app

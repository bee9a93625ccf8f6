#include "measure/fidelity/device_figures.h"

#include <algorithm>
#include <cstdint>

#include "haptics/gate/stiffness_bound.h"
#include "haptics/haptic_loop.h"
#include "measure/fidelity/calm_stiffness.h"

namespace myotact::measure {

namespace {

/// Goes where it is put; forces are only looked at.
class PlacedDevice : public device::Device {
 public:
  explicit PlacedDevice(const device::DeviceProfile& profile) : profile_(profile) {}
  const std::string& name() const override { return name_; }
  const device::DeviceProfile& profile() const override { return profile_; }
  void open() override {}
  void close() noexcept override {}
  bool connected() const noexcept override { return true; }
  messages::DeviceState read(std::uint64_t now_ns) noexcept override { return {{0.0, 0.0, height_m}, {}, now_ns, 0}; }
  void write(const messages::DeviceCommand& command) noexcept override { force_N = command.force_world_N[2]; }

  double height_m = 0.01;
  double force_N = 0.0;

 private:
  std::string name_ = "placed";
  device::DeviceProfile profile_;
};

/// A wall at height 0, one triangle of half a metre.
void write_wall(messages::LocalModel& model) {
  model = {};
  model.vertex_count = 3;
  model.triangle_count = 1;
  model.current_world_m[0] = {-0.25, -0.25, 0.0};
  model.current_world_m[1] = {0.25, -0.25, 0.0};
  model.current_world_m[2] = {0.0, 0.25, 0.0};
  model.previous_world_m = model.current_world_m;
  model.triangles[0] = {0, 0, {0, 1, 2}, {}};
  model.coverage_radius_m = 0.2;
  model.dt_ns = 10'000'000;
}

}  // namespace

StiffnessRange stiffness_range(const std::string& name, const device::DeviceProfile& profile) {
  StiffnessRange range;
  range.device = name;
  range.in_hand_N_m = stiffest_calm_N_m(profile, kHoldingHand);
  range.no_hand_N_m = stiffest_calm_N_m(profile, kNoHand);
  range.in_hand_bound_N_m = stiffness_bound_N_m(profile, kHoldingHand);
  range.no_hand_bound_N_m = stiffness_bound_N_m(profile, kNoHand);
  range.allowed_N_m = haptics::stiffness_bound(profile).smallest_N_m();
  return range;
}

AnswerTime answer_time(const device::DeviceProfile& profile) {
  constexpr double kDeep_m = 1e-3, kJump_m = 2e-4;
  constexpr int kSettle_ticks = 1500, kLongest_ticks = 100;
  PlacedDevice device(profile);
  haptics::HapticSettings settings;
  haptics::HapticLoop loop(device, settings);
  std::uint64_t now_ns = haptics::kTickPeriod_ns;
  loop.prepare(now_ns);
  const auto tick = [&] {
    now_ns += haptics::kTickPeriod_ns;
    if (now_ns % 10'000'000 == 0) {
      write_wall(loop.models().back());
      loop.models().back().sequence = now_ns / 10'000'000;
      loop.models().back().published_at_ns = now_ns;
      loop.models().publish();
    }
    loop.tick(now_ns);
    for (haptics::HapticTick taken; loop.ticks().pop(taken);) {  // the only reader of the queue
    }
  };
  const double touching_m = settings.contact.radius_m;
  for (int i = 0; i < kSettle_ticks; ++i) {
    // Down at 20 mm/s once the gate is armed in free air.
    device.height_m = std::max(touching_m - kDeep_m, touching_m + 1e-2 - 2e-5 * i);
    tick();
  }
  const double before_N = device.force_N;
  device.height_m -= kJump_m;
  AnswerTime answer;
  std::vector<double> after_N;
  for (int i = 0; i < kLongest_ticks; ++i) {
    tick();
    after_N.push_back(device.force_N - before_N);
  }
  while (answer.loop_ticks + 1 < kLongest_ticks &&
         after_N[static_cast<std::size_t>(answer.loop_ticks)] < 0.5 * after_N.back())
    ++answer.loop_ticks;
  answer.device_ticks = profile.delay_ticks;
  answer.total_s = 1e-9 * static_cast<double>(haptics::kTickPeriod_ns) * (answer.loop_ticks + answer.device_ticks);
  return answer;
}

}  // namespace myotact::measure

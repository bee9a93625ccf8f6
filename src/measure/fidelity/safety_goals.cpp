#include "measure/fidelity/safety_goals.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <limits>
#include <random>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "device/shared_motor.h"
#include "measure/fidelity/virtual_touch.h"
#include "realtime/periodic_loop.h"
#include "realtime/watchdog.h"

namespace myotact::measure {

namespace {

constexpr std::uint64_t kTick_ns = 1'000'000;

// ---- faults at random

/// A device in a hand that wanders through the tissue, with faults by the number of the tick.
class FaultyDevice : public device::Device {
 public:
  const std::string& name() const override { return name_; }
  const device::DeviceProfile& profile() const override { return profile_; }
  void open() override {}
  void close() noexcept override {}
  bool connected() const noexcept override { return connected_; }
  messages::DeviceState read(std::uint64_t) noexcept override { return state_; }
  void write(const messages::DeviceCommand& command) noexcept override { sent_N_ = to_vec3(command.force_world_N); }

  messages::DeviceState state_;
  bool connected_ = true;
  Vec3 sent_N_ = Vec3::Zero();

 private:
  std::string name_ = "faulty";
  device::DeviceProfile profile_;
};

struct Outcome {
  double over_limit_N = -1e9;  // largest force less the limit
  int slowest_ticks = 0;       // from a fault of device, number or stop to zero force
  double largest_N = 0.0;
  int faults = 0;
};

/// Everything that can be wrong, one after the other, 3 % of the ticks each way, between spells of peace in which the
/// force comes back.
class Misfortune {
 public:
  Misfortune() : touch_({true, false, false}, Vec3(0.0, 0.0, 0.02), {}, {}, settings()), loop_(device_, settings()) {
    device_.state_.stylus_position_world_m = {0.0, 0.0, 0.02};
    loop_.prepare(now_ns_);
  }

  Outcome run(int ticks) {
    for (int i = 0; i < ticks; ++i) tick(i);
    return outcome_;
  }

 private:
  static haptics::HapticSettings settings() {
    haptics::HapticSettings settings;
    settings.gate.ramp_s = 0.02;  // so that there is force to take away most of the time
    return settings;
  }
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

  void move_hand(int i) {
    const double t_s = 1e-3 * i;
    // Out of the tissue for a moment in every cycle, where the gate opens; never faster than the cut-off.
    position_m_ = Vec3(0.03 * std::sin(2.1 * t_s), 0.03 * std::sin(1.3 * t_s), 3e-3 * std::sin(9.0 * t_s));
    device_.state_.stylus_position_world_m = to_array(position_m_);
    device_.state_.stylus_velocity_world_m_s = {};
    device_.state_.buttons = 0;
    device_.connected_ = true;
  }

  /// True: a fault after which the force must be zero.
  bool harm() {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    const int kind = static_cast<int>(10.0 * unit());
    std::array<double, 3>& place = device_.state_.stylus_position_world_m;
    const auto axis = static_cast<std::size_t>(3.0 * unit());
    switch (kind) {
      case 0:
        place[axis] = kNaN;
        return true;
      case 1:
        place[axis] = (unit() < 0.5 ? -1.0 : 1.0) * std::pow(10.0, 300.0 * unit());
        return true;
      case 2:
        place[axis] += 3e-3;
        return true;  // 3 m/s
      case 3:
        device_.connected_ = false;
        return true;
      case 4:
        device_.state_.buttons = messages::kStopButton;
        return true;
      case 5:
        loop_.stop_forces(true);
        return true;
      case 6:
        device_.state_.stylus_velocity_world_m_s[axis] = kNaN;
        return true;
      case 7:
        device_.state_.stylus_velocity_world_m_s[axis] = 1e9 * (unit() - 0.5);
        return false;
      case 8:
        now_ns_ -= std::min(now_ns_, static_cast<std::uint64_t>(1e9 * unit()));
        return false;
      default:
        corrupts_model_ = true;
        return false;
    }
  }

  void publish() {
    messages::LocalModel& model = loop_.models().back();
    model = touch_.model;
    model.sequence = ++sequence_;
    model.published_at_ns = now_ns_;
    model.dt_ns = 10 * kTick_ns;
    if (corrupts_model_) {
      model.triangles[static_cast<std::size_t>(200.0 * unit())].vertices[1] = 100 + static_cast<int>(1000.0 * unit());
      model.current_world_m[5][0] = unit() < 0.5 ? 1e300 : std::numeric_limits<double>::infinity();
    }
    corrupts_model_ = false;
    loop_.models().publish();
  }

  void tick(int i) {
    now_ns_ += kTick_ns;
    move_hand(i);
    const bool quiet = i % 1000 < 600;
    if (quiet && i % 1000 == 0) loop_.stop_forces(false);
    const bool must_stop = !quiet && unit() < 0.3 && harm();
    if (i % 10 == 0 && unit() < 0.98) publish();
    loop_.tick(now_ns_);
    for (haptics::HapticTick kept; loop_.ticks().pop(kept);) {
    }
    const double force_N = device_.sent_N_.norm();
    outcome_.largest_N = std::max(outcome_.largest_N, force_N);
    outcome_.over_limit_N = std::max(outcome_.over_limit_N, std::isfinite(force_N) ? force_N - limit_N_ : 1e9);
    if (must_stop) ++outcome_.faults;
    waited_ = must_stop ? 1 : waited_ > 0 ? waited_ + 1 : 0;
    if (force_N != 0.0) outcome_.slowest_ticks = std::max(outcome_.slowest_ticks, waited_);
    if (force_N == 0.0) waited_ = 0;
  }

  VirtualTouch touch_;  // for its model
  FaultyDevice device_;
  haptics::HapticLoop loop_;
  std::mt19937_64 random_{20};
  double limit_N_ = haptics::GateSettings{}.force_limit * device::DeviceProfile{}.peak_force_N;
  std::uint64_t now_ns_ = 10'000'000'000, sequence_ = 0;
  Vec3 position_m_ = Vec3::Zero();
  bool corrupts_model_ = false;
  int waited_ = 0;
  Outcome outcome_;
};

// ---- single misfortunes

void press(VirtualTouch& touch) {
  for (int i = 0; i < 1500; ++i) {
    touch.device.set_hand_target({{0.0, 0.0, i < 1100 ? 5e-3 : -2e-3}, {}, 0});
    touch.tick();
  }
}

/// Force that is left 100 ms after the last model while the simulation hangs for 200 ms.
double left_after_stall_N() {
  VirtualTouch touch({}, Vec3(0.0, 0.0, 5e-3), {}, {}, {});
  press(touch);
  double left_N = 0.0;
  for (int i = 1; i <= 200; ++i) {
    touch.device.set_hand_target({{0.0, 0.0, -2e-3}, {}, 0});
    touch.tick(false);
    if (i >= 100) left_N = std::max(left_N, touch.force_N().norm());
  }
  return left_N;
}

/// Ticks with force after the device began to move at 3 m/s, sideways out of a press.
int ticks_of_a_yank() {
  VirtualTouch model({}, Vec3(0.0, 0.0, 5e-3), {}, {}, {});
  FaultyDevice device;
  haptics::HapticLoop loop(device, {});
  device.state_.stylus_position_world_m = {0.0, 0.0, 5e-3};
  loop.prepare(kTick_ns);
  int with_force = 0;
  for (std::uint64_t i = 2; i < 1600; ++i) {
    if (i % 10 == 0) {
      loop.models().back() = model.model;
      loop.models().back().sequence = i;
      loop.models().back().published_at_ns = i * kTick_ns;
      loop.models().back().dt_ns = 10 * kTick_ns;
      loop.models().publish();
    }
    std::array<double, 3>& place = device.state_.stylus_position_world_m;
    if (i > 1200 && place[2] > 2e-3) place[2] -= 5e-5;
    if (i > 1580) place[0] += 3e-3;
    loop.tick(i * kTick_ns);
    if (i == 1580 && device.sent_N_.norm() < 0.5) return 1000;  // nothing to take away: the figure would mean nothing
    if (i > 1580 && device.sent_N_.norm() > 0.0) ++with_force;
  }
  return with_force;
}

/// Milliseconds from kill -9 of a program that pushes with 2 N to zero force of its motors.
double killed_ms() {
  device::SharedMotor motor;
  const pid_t program = ::fork();
  if (program == 0) {
    realtime::Watchdog watchdog(motor);
    while (true) {
      motor.set_force(Vec3(0.0, 0.0, 2.0));
      watchdog.beat();
      ::usleep(1000);
    }
  }
  if (program < 0) return 1e9;
  while (motor.force_world_N().z() == 0.0) ::usleep(1000);
  ::usleep(100'000);
  const std::uint64_t start_ns = realtime::steady_now_ns();
  ::kill(program, SIGKILL);
  const auto since_ms = [&] { return 1e-6 * static_cast<double>(realtime::steady_now_ns() - start_ns); };
  while (motor.force_world_N().z() != 0.0 && since_ms() < 5000.0) ::usleep(200);
  const double took_ms = since_ms();
  ::waitpid(program, nullptr, 0);
  return took_ms;
}

}  // namespace

GoalFigures measure_safety(Effort effort) {
  const int ticks = effort == Effort::Full ? 1'000'000 : 100'000;
  const Outcome random = Misfortune().run(ticks);
  GoalFigures result;
  result.figures = {
      {"largest force over the limit, faults at random", random.over_limit_N, "N", 1e-12},
      {"ticks with force after a fault of device, number or stop", static_cast<double>(random.slowest_ticks), "", 2.0},
      {"such faults", static_cast<double>(random.faults), "", 0.02 * ticks, true},
      {"largest force between them", random.largest_N, "N", 1.0, true},
      {"ticks with force in a yank at 3 m/s", static_cast<double>(ticks_of_a_yank()), "", 2.0},
      {"force 100 to 200 ms into a stall of the simulation", left_after_stall_N(), "N", 0.0},
      {"zero force after kill -9", killed_ms(), "ms", 100.0, false, true}};
  result.note = fmt::format("{} ticks with faults of device, numbers, clock, models and stops", ticks);
  return result;
}

}  // namespace myotact::measure

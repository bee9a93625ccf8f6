#include "app/device_check.h"

#include <array>
#include <chrono>
#include <ostream>
#include <string>

#include <fmt/format.h>

#include "app/interruption.h"
#include "haptics/faults.h"
#include "haptics/haptic_loop.h"
#include "haptics/haptic_thread.h"
#include "realtime/periodic_loop.h"

namespace myotact::app {

namespace {

/// A spring from the stylus to a point 10 mm away pulls with half a newton: a weight of 50 g, felt and easily held.
constexpr double kPull_N_m = 50.0, kAway_m = 0.01;
constexpr double kMovesItsWay_m =
    2e-4;  // several counts of the coarsest encoder; the pull gives 1.4 mm in a relaxed hand
constexpr std::chrono::milliseconds kPeriod(10);  // of the models that hold the pull: as often as a simulation's steps
constexpr std::chrono::milliseconds kRamp(1500);  // the gate's ramp of one second, and some rest
constexpr const char* kAxes[] = {"right", "up", "towards you"};

/// A device with its loop and its thread, and what was seen of it.
class Bench {
 public:
  Bench(device::Device& device, realtime::Watchdog* watchdog) : loop_(device, {}), thread_(loop_, watchdog) {
    loop_.prepare(realtime::steady_now_ns());
    thread_.start();
  }

  /// For that long: pulls as told, and looks.
  void run(std::chrono::milliseconds duration) {
    for (auto left = duration; left > left.zero() && interruption() == 0; left -= kPeriod) {
      publish();
      std::this_thread::sleep_for(kPeriod);
      look();
    }
  }
  /// The line that the person enters; nothing: a signal came, or there is nobody.
  std::optional<std::string> wait_for_line(LineInput& answers) {
    while (interruption() == 0) {
      publish();
      auto line = answers.next(kPeriod);
      look();
      if (answers.ended()) return std::nullopt;
      if (line) return line;
    }
    return std::nullopt;
  }
  void pull_to(const Vec3& anchor_m) {
    anchor_m_ = anchor_m;
    pulls_ = true;
  }
  void let_go() { pulls_ = false; }

  Vec3 position_m() const { return position_m_; }
  double largest_N() const { return largest_N_; }
  void forget_force() { largest_N_ = 0.0; }
  std::uint32_t faults() const { return faults_; }
  std::string range() const;
  std::string rate() const;

 private:
  void publish() {
    messages::LocalModel& model = loop_.models().back();
    model = {};
    model.sequence = ++sequence_;
    model.published_at_ns = realtime::steady_now_ns();
    model.dt_ns = static_cast<std::uint64_t>(std::chrono::nanoseconds(kPeriod).count());
    if (pulls_) model.tether = {kPull_N_m, to_array(anchor_m_), {}};
    loop_.models().publish();
  }
  void look() {
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

  haptics::HapticLoop loop_;
  haptics::HapticThread thread_;
  std::uint64_t sequence_ = 0;
  bool pulls_ = false, seen_ = false;
  Vec3 anchor_m_ = Vec3::Zero(), position_m_ = Vec3::Zero();
  Vec3 lowest_m_ = Vec3::Zero(), highest_m_ = Vec3::Zero();
  std::uint32_t buttons_ = 0, faults_ = 0;
  double largest_N_ = 0.0;
};

std::string Bench::range() const {
  std::string text = "   reached [mm]:";
  for (int k = 0; k < 3; ++k)
    text += fmt::format("  {} {:.1f} .. {:.1f}", kAxes[k], 1e3 * lowest_m_[k], 1e3 * highest_m_[k]);
  text += "\n   buttons seen:";
  for (int button = 0; button < 32; ++button)
    if ((buttons_ >> button & 1u) != 0) text += fmt::format(" {}", button + 1);
  return text + (buttons_ == 0 ? " none\n" : "\n");
}

std::string Bench::rate() const {
  const realtime::DurationSummary periods = thread_.periods().summary();
  const double median_us = 1e-3 * static_cast<double>(periods.p50_ns);
  return fmt::format(
      "3. Rate: period {:.0f} us (median), {:.0f} us (99 %), {:.0f} us (longest); {} of {} ticks missed\n", median_us,
      1e-3 * static_cast<double>(periods.p99_ns), 1e-3 * static_cast<double>(periods.max_ns), thread_.missed_count(),
      thread_.tick_count());
}

bool push_along(Bench& bench, int axis, std::ostream& out) {
  const Vec3 way = Vec3::Unit(axis), start_m = bench.position_m();
  bench.forget_force();
  bench.pull_to(start_m + kAway_m * way);
  bench.run(kRamp);
  const double gave_way_m = way.dot(bench.position_m() - start_m);
  bench.let_go();
  bench.run(kRamp / 3);
  const bool is_right = gave_way_m > kMovesItsWay_m;
  out << fmt::format("   {}: pushed with {:.2f} N, moved {:.1f} mm that way: {}\n", kAxes[axis], bench.largest_N(),
                     1e3 * gave_way_m, is_right ? "as it should" : "NOT as it should");
  return is_right;
}

}  // namespace

bool check_device(device::Device& device, realtime::Watchdog* watchdog, LineInput& answers, std::ostream& out) {
  Bench bench(device, watchdog);
  bench.run(kRamp);
  out << "1. Reach: move the stylus to every end of its reach and press each button, then press Enter.\n" << std::flush;
  bench.wait_for_line(answers);
  out << bench.range();
  out << "2. Force: the device will push with half a newton to the right, up and towards you, a second each.\n"
         "   Hold it loosely. Type yes to allow it: "
      << std::flush;
  const bool allowed = bench.wait_for_line(answers) == "yes";
  bool is_right = true;
  out << (allowed ? "\n" : "\n   no force was sent\n");
  for (int axis = 0; axis < 3 && allowed && interruption() == 0; ++axis)
    is_right = push_along(bench, axis, out) && is_right;
  out << bench.rate();
  for (const std::string& fault : haptics::describe_faults(bench.faults())) out << "   " << fault << '\n';
  out << std::flush;
  return is_right && interruption() == 0;
}

}  // namespace myotact::app

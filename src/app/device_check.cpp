#include "app/device_check.h"

#include <chrono>
#include <ostream>
#include <string>

#include <fmt/format.h>

#include "app/device_bench.h"
#include "app/interruption.h"
#include "haptics/faults.h"

namespace myotact::app {

namespace {

constexpr double kPush_N = 0.5;                               // a weight of 50 g, felt and easily held
constexpr double kAway_m = kPush_N / DeviceBench::kPull_N_m;  // of the spring's end
constexpr double kMovesItsWay_m =
    2e-4;  // several counts of the coarsest encoder; the pull gives 1.4 mm in a relaxed hand
constexpr std::chrono::milliseconds kRamp(1500);  // the gate's ramp of one second, and some rest

bool push_along(DeviceBench& bench, int axis, std::ostream& out) {
  const Vec3 way = Vec3::Unit(axis), start_m = bench.position_m();
  bench.forget_force();
  bench.pull_to(start_m + kAway_m * way);
  bench.run(kRamp);
  const double gave_way_m = way.dot(bench.position_m() - start_m);
  bench.let_go();
  bench.run(kRamp / 3);
  const bool is_right = gave_way_m > kMovesItsWay_m;
  if (bench.is_stopped()) {
    out << fmt::format("   {}: a button of the device stopped the forces\n", kDeviceAxes[axis]);
    return false;
  }
  out << fmt::format("   {}: pushed with {:.2f} N, moved {:.1f} mm that way: {}\n", kDeviceAxes[axis],
                     bench.largest_N(), 1e3 * gave_way_m, is_right ? "as it should" : "NOT as it should");
  return is_right;
}

/// A push along each axis, after an explicit yes.
bool check_force(DeviceBench& bench, LineInput& answers, std::ostream& out) {
  out << "2. Force: the device will push with half a newton to the right, up and towards you, a second each.\n"
         "   Hold it loosely. Type yes to allow it: "
      << std::flush;
  const bool allowed = bench.wait_for_line(answers) == "yes";
  if (allowed) bench.enable_again();
  out << (allowed ? "\n" : "\n   no force was sent\n");
  bool is_right = true;
  for (int axis = 0; axis < 3 && allowed && interruption() == 0; ++axis) {
    is_right = push_along(bench, axis, out) && is_right;
  }
  return is_right;
}

}  // namespace

bool check_device(device::Device& device, device::HardwareDevice* on_table, realtime::Watchdog* watchdog,
                  LineInput& answers, std::ostream& out) {
  DeviceBench bench(device, on_table, watchdog, kPush_N);
  if (!bench.wait_until_ready(out)) return false;
  bench.run(kRamp);
  out << "1. Reach: move the stylus to every end of its reach and press each button, then press Enter.\n" << std::flush;
  bench.wait_for_line(answers);
  out << bench.range();
  bool is_right = true;
  if (device.profile().shows_force_only) {
    out << "2. Force: it has no motors.\n";
  } else {
    is_right = check_force(bench, answers, out);
  }
  out << bench.rate();
  for (const std::string& fault : haptics::describe_faults(bench.faults())) out << "   " << fault << '\n';
  out << std::flush;
  return is_right && interruption() == 0;
}

}  // namespace myotact::app

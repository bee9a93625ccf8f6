#include "app/device_calibration.h"

#include <cmath>
#include <ostream>
#include <string>

#include <fmt/format.h>

#include "app/device_bench.h"
#include "app/interruption.h"
#include "core/text.h"
#include "device/placed_device.h"

namespace myotact::app {

namespace {

/// A balance for kitchens or anglers shows a weight of 200 g to a few per cent, and no motor is warmed by it.
constexpr double kWeighed_N = 2.0;
constexpr double kGrams_N = 1e3 / 9.81;

/// The scale with which a device that showed `measured_N` for `wanted_N` would have shown what was wanted; nothing
/// where that is outside the range or no number.
std::optional<double> corrected(const ForceScale& scale, double wanted_N, double measured_N) {
  const double found = scale.value * wanted_N / measured_N;
  if (!std::isfinite(found) || found < scale.lowest || found > scale.highest) return std::nullopt;
  return found;
}

std::optional<double> weigh(DeviceBench& bench, const ForceScale& scale, LineInput& answers, std::ostream& out) {
  const double pull_N = bench.most_N();
  out << fmt::format(
             "The force scale is {:.0f} now. To weigh it: hook a spring balance to the grip, hold the balance above "
             "the\n"
             "device with the grip in the middle of its reach, and set the balance to zero. The device will then pull\n"
             "down with {:.1f} N (about {:.0f} g). Type yes to allow it: ",
             scale.value, pull_N, pull_N * kGrams_N)
      << std::flush;
  if (bench.wait_for_line(answers) != "yes") {
    out << "\nno force was sent, the scale stays\n";
    return std::nullopt;
  }
  bench.enable_again();
  bench.pull_with(-pull_N * Vec3::UnitY());
  out << "\nEnter what the balance shows, in newtons (grams times 0.00981): " << std::flush;
  const std::string answer = bench.wait_for_line(answers).value_or("");
  bench.let_go();
  const auto measured_N = parse_number(answer);
  const auto found = measured_N ? corrected(scale, pull_N, *measured_N) : std::nullopt;
  if (!found) {
    out << fmt::format("\n\"{}\" is no force between {:.2f} and {:.1f} N, the scale stays {:.0f}\n", answer,
                       pull_N * scale.value / scale.highest, pull_N * scale.value / scale.lowest, scale.value);
  }
  return found;
}

}  // namespace

Calibration calibrate_device(device::HardwareDevice& device, const std::optional<ForceScale>& scale, LineInput& answers,
                             std::ostream& out) {
  device::PlacedDevice placed(device, {});
  DeviceBench bench(placed, &device, nullptr, kWeighed_N);
  if (!bench.wait_until_ready(out)) return {};
  out << device.name() << " is calibrated and ready.\n" << std::flush;
  if (!scale) return {true, {}};
  return {true, weigh(bench, *scale, answers, out)};
}

}  // namespace myotact::app

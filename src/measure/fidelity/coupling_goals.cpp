#include "measure/fidelity/coupling_goals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "measure/fidelity/point_tissue.h"

namespace myotact::measure {

namespace {

constexpr double kTick_s = 1e-3;
constexpr std::array kRates_hz = {62.5, 100.0, 200.0};

/// Device and hand of the comparison of schemes in tests/bench/results/2026-11-22-coupling.md: no friction of its own
/// that would hide a limit cycle.
device::DeviceProfile smooth_device() {
  device::DeviceProfile profile;
  profile.peak_force_N = 20.0;
  profile.continuous_force_N = 20.0;  // warm motors are not the question
  profile.max_stiffness_N_m = 1e5;
  profile.inertia_kg = 0.1;
  profile.viscous_Ns_m = 0.2;
  profile.coulomb_N = 0.0;
  profile.resolution_m = 20e-6;
  return profile;
}
constexpr device::HandProfile kLooseHand = {0.1, 3.0, 150.0};

haptics::HapticSettings coupled_by(double stiffness_N_m) {
  haptics::HapticSettings settings;
  settings.contact.stiffness_N_m = stiffness_N_m;
  settings.limit_stiffness = false;  // what it supports is the question
  settings.gate.ramp_s = 0.1;
  return settings;
}

/// A hand that comes down in half a second, then presses with about `force_N`, the whole along `direction`.
Vec3 pressing_m(const PointPress& press, const device::HandProfile& hand, const Vec3& direction, double force_N,
                double stiffness_N_m) {
  const double depth_m = force_N * (1.0 / hand.stiffness_N_m + 1.0 / stiffness_N_m);
  const double part = std::clamp((press.time_s() - 0.3) / 0.5, 0.0, 1.0);
  return press.touching_m() - (part * depth_m - (1.0 - part) * 2e-3) * direction;
}

struct Press {
  double jitter_N = 0.0;                                 // over the second half
  Vec3 force_N = Vec3::Zero(), device_m = Vec3::Zero();  // means of the second half
};

/// By a loose hand.
Press press(const PointTissue& tissue, double stiffness_N_m, const device::DeviceProfile& profile, double force_N,
            double seconds) {
  PointPress press(tissue, coupled_by(stiffness_N_m), profile, kLooseHand);
  std::array<Jitter, 3> jitter;
  Press result;
  const long counted = std::lround(0.5 * seconds / kTick_s);
  for (long tick = 0; tick < 2 * counted; ++tick) {
    press.tick(pressing_m(press, kLooseHand, tissue.normal, force_N, tissue.stiffness_N_m));
    if (tick < counted) continue;
    for (std::size_t k = 0; k < 3; ++k) jitter[k].add(press.force_N()[static_cast<Eigen::Index>(k)]);
    result.force_N += press.force_N() / static_cast<double>(counted);
    result.device_m += press.device_m() / static_cast<double>(counted);
  }
  result.jitter_N = std::hypot(jitter[0].rms(), jitter[1].rms(), jitter[2].rms());
  return result;
}

/// Slope of force over device position between two presses, along the normal.
double felt_stiffness_N_m(const PointTissue& tissue, double coupling_N_m, double seconds) {
  const auto at_force = [&](double force_N) { return press(tissue, coupling_N_m, smooth_device(), force_N, seconds); };
  const Press light = at_force(0.5), firm = at_force(2.0);
  return (firm.force_N - light.force_N).dot(tissue.normal) / -(firm.device_m - light.device_m).dot(tissue.normal);
}

const Vec3 kLevel = Vec3::UnitZ();
const Vec3 kTilted = Vec3(2.0, -1.0, 2.0) / 3.0;

}  // namespace

GoalFigures measure_felt_stiffness(Effort effort) {
  const double seconds = effort == Effort::Full ? 8.0 : 4.0;
  struct Case {
    double device_N_m, tissue_N_m;
    std::vector<double> rates_hz;
  };
  const std::vector<double> all(kRates_hz.begin(), kRates_hz.end());
  const std::array cases = {Case{4000.0, 100.0, all},    Case{4000.0, 300.0, all},    Case{4000.0, 600.0, all},
                            Case{4000.0, 1000.0, all},   Case{4000.0, 1500.0, all},   Case{4000.0, 2000.0, all},
                            Case{800.0, 100.0, {100.0}}, Case{800.0, 300.0, {100.0}}, Case{800.0, 550.0, {100.0}}};
  GoalFigures result;
  for (const Case& c : cases) {
    double worst = 0.0;
    for (const double rate_hz : c.rates_hz) {
      const PointTissue tissue{.stiffness_N_m = c.tissue_N_m, .dt_s = 1.0 / rate_hz, .normal = kTilted};
      worst = std::max(worst, std::abs(felt_stiffness_N_m(tissue, c.device_N_m, seconds) / c.tissue_N_m - 1.0));
    }
    result.figures.push_back({fmt::format("{} N/m through a device of {} N/m, error", c.tissue_N_m, c.device_N_m),
                              100.0 * worst, "%", c.tissue_N_m < 2000.0 ? 5.0 : 10.0});
  }
  const PointTissue firm{.stiffness_N_m = 1500.0};
  result.note = fmt::format(
      "slope of force over device position from 0.5 to 2 N, one step late; {} N/m: worst of 62.5, 100 and 200 Hz, 800 "
      "N/m: "
      "100 Hz. Tissue that stands firmer in a step than the device may render reads softer: 1500 N/m through 800 N/m "
      "as "
      "{:.0f} N/m",
      cases[0].device_N_m, felt_stiffness_N_m(firm, 800.0, seconds));
  return result;
}

GoalFigures measure_multirate_stability(Effort effort) {
  const bool full = effort == Effort::Full;
  constexpr std::array kGoals_N_m = {3000.0, 5000.0, 7000.0};
  constexpr double kCalm_N = 0.05;
  constexpr double kStiffest_N_m = 12'000.0;
  const auto calm = [&](double dt_s, double coupling_N_m) {
    for (const int late : {1, 0}) {
      for (const Vec3& normal : {kLevel, kTilted}) {
        const PointTissue tissue{.dt_s = dt_s, .late_steps = late, .normal = normal};
        if (press(tissue, coupling_N_m, smooth_device(), 1.5, full ? 10.0 : 4.0).jitter_N > kCalm_N) return false;
      }
    }
    return true;
  };
  GoalFigures result;
  for (std::size_t r = 0; r < kRates_hz.size(); ++r) {
    double largest_N_m = 0.0;
    for (double k = full ? 400.0 : 800.0; k <= kStiffest_N_m && calm(1.0 / kRates_hz[r], k); k *= full ? 1.08 : 1.5)
      largest_N_m = k;
    result.figures.push_back(
        {fmt::format("coupling that stays calm at {} Hz", kRates_hz[r]), largest_N_m, "N/m", kGoals_N_m[r], true});
  }
  result.note = fmt::format(
      "tissue of 300 N/m and 20 g, results on time and one step late, level and tilted; jitter below 50 mN; looked for "
      "up to {} N/m",
      kStiffest_N_m);
  return result;
}

GoalFigures measure_press_jitter(Effort effort) {
  const double seconds = effort == Effort::Full ? 20.0 : 6.0;
  device::DeviceProfile least_friction = smooth_device();
  least_friction.coulomb_N = 0.05;  // the least of the range for desktop devices (assets/devices/)
  GoalFigures result;
  double without_friction_N = 0.0;
  for (const double tissue_N_m : {300.0, 1500.0}) {
    for (const double rate_hz : kRates_hz) {
      const PointTissue tissue{.stiffness_N_m = tissue_N_m, .dt_s = 1.0 / rate_hz, .normal = kTilted};
      const double jitter_N = press(tissue, 800.0, least_friction, 1.0, seconds).jitter_N;
      result.figures.push_back(
          {fmt::format("tissue of {} N/m, {} Hz, above 20 Hz", tissue_N_m, rate_hz), 1e3 * jitter_N, "mN", 10.0});
      without_friction_N = std::max(without_friction_N, press(tissue, 800.0, smooth_device(), 1.0, seconds).jitter_N);
    }
  }
  result.note = fmt::format(
      "800 N/m, one step late, device with 0.05 N of friction and an encoder of 20 um; without any friction, where "
      "nothing "
      "stops the encoder's steps of {:.0f} mN, up to {:.0f} mN",
      1e3 * 800.0 * least_friction.resolution_m, 1e3 * without_friction_N);
  return result;
}

namespace {

/// Worst share, over the seconds of a motion, by which what the hand gets differs from what the tissue gets.
double impulse_mismatch(const PointTissue& tissue, double friction, double seconds) {
  haptics::HapticSettings settings = coupled_by(800.0);
  settings.contact.static_friction = settings.contact.dynamic_friction = friction;
  PointPress press(tissue, settings, smooth_device(), {});
  const Vec3 along = tissue.normal.unitOrthogonal();
  const auto steps_a_second = std::lround(1.0 / tissue.dt_s);
  double worst = 0.0;
  Vec3 hand_Ns = Vec3::Zero(), tissue_Ns = Vec3::Zero();
  const auto ticks_a_second = std::lround(1.0 / kTick_s);
  const long ticks_a_step = ticks_a_second / steps_a_second;
  for (long tick = 1; tick <= std::lround(seconds / kTick_s); ++tick) {
    const double t_s = static_cast<double>(tick) * kTick_s;
    // In and out and to and fro, whole periods a second; in the air for a part of it.
    const double depth_m = 6e-3 * std::sin(2.0 * std::numbers::pi * 2.0 * t_s) + 3e-3;
    const double aside_m = 5e-3 * std::sin(2.0 * std::numbers::pi * 3.0 * t_s);
    press.tick(press.touching_m() - depth_m * tissue.normal + aside_m * along);
    hand_Ns += kTick_s * press.force_N();
    if (tick % ticks_a_step == 0) tissue_Ns += tissue.dt_s * press.tissue_force_N();
    if (tick % ticks_a_second != 0) continue;
    if (tick > ticks_a_second) worst = std::max(worst, (hand_Ns + tissue_Ns).norm() / tissue_Ns.norm());
    hand_Ns = tissue_Ns = Vec3::Zero();
  }
  return worst;
}

}  // namespace

GoalFigures measure_impulse_balance(Effort effort) {
  const double seconds = effort == Effort::Full ? 60.0 : 6.0;
  GoalFigures result;
  for (const double tissue_N_m : {300.0, 1500.0}) {
    double worst = 0.0;
    for (const double rate_hz : {100.0, 200.0}) {
      for (const double friction : {0.0, 0.3}) {
        const PointTissue tissue{.stiffness_N_m = tissue_N_m, .dt_s = 1.0 / rate_hz, .normal = kTilted};
        worst = std::max(worst, impulse_mismatch(tissue, friction, seconds));
      }
    }
    result.figures.push_back(
        {fmt::format("tissue of {} N/m, difference a second", tissue_N_m), 100.0 * worst, "%", 2.0});
  }
  result.note =
      "pokes at 2 Hz and strokes at 3 Hz, in the air between, with and without friction, 100 and 200 Hz, one step late";
  return result;
}

}  // namespace myotact::measure

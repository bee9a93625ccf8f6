#include "measure/fidelity/drag_goals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "haptics/haptic_loop.h"
#include "haptics/haptic_thread.h"
#include "measure/fidelity/guided_device.h"
#include "simulation/line/hill_muscle.h"

namespace myotact::measure {

namespace {

constexpr double kTick_s = 1e-3;
constexpr std::uint64_t kStep_ns = 10'000'000;

constexpr double kHalf_m = 0.1;       // of the strand, between its fixed ends on the x axis
constexpr double kDrag_m = 0.05;      // sideways
constexpr double kForceScale = 0.02;  // muscle tensions as a desktop stylus gives them: 2 N and less

/// Tension of a strand at a length, at rest, and its slope.
struct Strand {
  std::string name;
  std::function<double(double)> tension_N, stiffness_N_m;
};

std::vector<Strand> strands() {
  const simulation::HillMuscle hill{60.0, 0.08, 0.2, 0.115, simulation::Tendon::Elastic};
  const auto at_length = [hill](double length_m) { return simulation::hill_equilibrium(hill, length_m, 0.5); };
  return {{"linear", [](double l_m) { return 20.0 + 600.0 * (l_m - 2.0 * kHalf_m); }, [](double) { return 600.0; }},
          {"Hill muscle with an elastic tendon", [at_length](double l_m) { return at_length(l_m).force_N; },
           [at_length](double l_m) { return at_length(l_m).stiffness_N_m; }}};
}

double length_m(const Vec3& tool_m) {
  return (tool_m - kHalf_m * Vec3::UnitX()).norm() + (tool_m + kHalf_m * Vec3::UnitX()).norm();
}

/// Force of the strand on the hand: its tension along both halves.
double strand_force_N(const Strand& strand, double aside_m) {
  return 2.0 * strand.tension_N(length_m(Vec3(0, 0, aside_m))) * aside_m / std::hypot(kHalf_m, aside_m);
}

messages::LocalModel strand_model(const Strand& strand, const Vec3& tool_m) {
  messages::LocalModel model;
  model.dt_ns = kStep_ns;
  model.coverage_radius_m = 0.25;
  messages::LocalLine& line = model.line;
  line.muscle = 0;
  line.fraction = 0.5;
  line.proximal_point_world_m = {-kHalf_m, 0.0, 0.0};
  line.distal_point_world_m = {kHalf_m, 0.0, 0.0};
  line.length_m = length_m(tool_m);
  line.tension_N = strand.tension_N(line.length_m);
  line.stiffness_N_m = std::max(0.0, strand.stiffness_N_m(line.length_m));
  return model;
}

struct Drag {
  /// One a tick, after the hand has closed: sent (over the force scale), of the drag before ports and gate, true.
  std::vector<double> sent_N, alone_N, true_N;
};

/// The hand swings the strand to 50 mm and back. The strand's own step of 10 ms reads the hand at its beginning and is
/// published at its end: one step late.
Drag drag(const Strand& strand, double frequency_hz, double seconds) {
  GuidedDevice device(20.0);
  haptics::HapticSettings settings;
  settings.gate.ramp_s = 0.1;
  settings.force_scale = kForceScale;
  haptics::HapticLoop loop(device, settings);
  std::uint64_t now_ns = haptics::kTickPeriod_ns;
  loop.prepare(now_ns);
  haptics::MuscleLineDrag alone(settings.line);
  messages::LocalLine newest;
  Drag result;
  Vec3 seen_m = Vec3::Zero();
  const long settled = 600;
  for (long tick = 1; tick <= settled + std::lround(seconds / kTick_s); ++tick) {
    now_ns += haptics::kTickPeriod_ns;
    const double t_s = std::max(0.0, static_cast<double>(tick - settled) * kTick_s);
    const double aside_m = 0.5 * kDrag_m * (1.0 - std::cos(2.0 * std::numbers::pi * frequency_hz * t_s));
    device.position_m = {0.0, 0.0, aside_m};
    device.buttons = tick > settled / 2 ? messages::kGrabButton : 0;
    if (now_ns % kStep_ns == 0) {
      messages::LocalModel& model = loop.models().back();
      model = strand_model(strand, seen_m);
      model.sequence = now_ns / kStep_ns;
      model.published_at_ns = now_ns;
      newest = model.line;
      loop.models().publish();
      seen_m = device.position_m;
    }
    loop.tick(now_ns);
    const messages::DeviceState& hand = loop.last_tick().device;
    const Vec3 force_N = alone.tick(
        newest, {to_vec3(hand.stylus_position_world_m), to_vec3(hand.stylus_velocity_world_m_s), hand.buttons != 0},
        kTick_s);
    if (tick <= settled) continue;
    result.alone_N.push_back(-force_N.z());
    result.sent_N.push_back(-loop.tool_state().force_world_N[2] / kForceScale);
    result.true_N.push_back(strand_force_N(strand, aside_m));
  }
  return result;
}

/// Root of the mean square difference over that of the truth, with the truth `lag` ticks earlier.
double rms_share(const std::vector<double>& given_N, const Drag& drag, std::size_t lag) {
  double difference_N2 = 0.0, size_N2 = 0.0;
  for (std::size_t i = lag; i < given_N.size(); ++i) {
    difference_N2 += std::pow(given_N[i] - drag.true_N[i - lag], 2);
    size_N2 += std::pow(drag.true_N[i - lag], 2);
  }
  return std::sqrt(difference_N2 / size_N2);
}

}  // namespace

GoalFigures measure_line_drag(Effort effort) {
  const double seconds = effort == Effort::Full ? 20.0 : 4.0;
  GoalFigures result;
  double worst_alone = 0.0;
  for (const Strand& strand : strands()) {
    double worst = 0.0;
    std::size_t worst_lag = 0;
    for (const double frequency_hz : {0.25, 0.5, 1.0, 2.0}) {
      const Drag dragged = drag(strand, frequency_hz, seconds);
      worst = std::max(worst, rms_share(dragged.sent_N, dragged, 0));
      worst_alone = std::max(worst_alone, rms_share(dragged.alone_N, dragged, 0));
      std::size_t lag = 0;
      for (std::size_t ticks = 1; ticks <= 20; ++ticks)
        if (rms_share(dragged.sent_N, dragged, ticks) < rms_share(dragged.sent_N, dragged, lag)) lag = ticks;
      worst_lag = std::max(worst_lag, lag);
    }
    result.figures.push_back({fmt::format("{}: force sent, difference", strand.name), 100.0 * worst, "% RMS", 3.0});
    result.figures.push_back(
        {fmt::format("{}: force sent, lag", strand.name), static_cast<double>(worst_lag), "ticks", 2.0});
  }
  result.note = fmt::format(
      "0.25 to 2 Hz, {:.0f} mm sideways, strand of {:.0f} mm stepped at 100 Hz and published one step late, force "
      "scale {}; "
      "before observers of energy and gate the force differs by up to {:.1f} % RMS",
      1e3 * kDrag_m, 2e3 * kHalf_m, kForceScale, 100.0 * worst_alone);
  return result;
}

}  // namespace myotact::measure

#include "measure/fidelity/loop_goals.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include <fmt/format.h>

#include "device/simulated_device.h"
#include "haptics/haptic_thread.h"
#include "realtime/periodic_loop.h"

namespace myotact::measure {

namespace {

constexpr std::uint64_t kStep_ns = 10'000'000;

/// Models of nothing near the tool, as a simulation of 100 Hz sends them, until the time is over.
void publish_models(haptics::HapticLoop& loop, double seconds) {
  realtime::PeriodicLoop beat(kStep_ns);
  beat.start();
  const auto steps = static_cast<std::uint64_t>(seconds * 1e9 / static_cast<double>(kStep_ns));
  for (std::uint64_t step = 1; step <= steps; ++step) {
    beat.wait();
    messages::LocalModel& model = loop.models().back();
    model = {};
    model.sequence = step;
    model.published_at_ns = realtime::steady_now_ns();
    model.dt_ns = kStep_ns;
    model.coverage_radius_m = 0.25;
    loop.models().publish();
  }
}

}  // namespace

GoalFigures measure_loop_period(Effort effort) {
  const double seconds = effort == Effort::Full ? 600.0 : 3.0;
  device::SimulatedDevice device("simulated", Vec3::Zero());
  haptics::HapticLoop loop(device, {});
  loop.prepare(realtime::steady_now_ns());
  haptics::HapticThread thread(loop);
  thread.start();
  publish_models(loop, seconds);
  thread.stop();
  const realtime::DurationSummary period = thread.periods().summary();
  const double late_us = 1e-3 * (static_cast<double>(period.p999_ns) - static_cast<double>(haptics::kTickPeriod_ns));
  const double missed = static_cast<double>(thread.missed_count());
  const double share = 100.0 * missed / std::max(1.0, static_cast<double>(thread.tick_count()) + missed);
  GoalFigures result;
  result.figures = {{"period of a tick over 1 ms, 99.9 %", late_us, "us", 200.0, false, true},
                    {"ticks missed", share, "%", 0.01, false, true}};
  result.note = fmt::format("{} s on the wall clock{}{}", seconds,
                            thread.refused().empty() ? "" : "; ordinary priority: ", thread.refused());
  return result;
}

}  // namespace myotact::measure

#include "measure/probe/probe.h"

#include <iostream>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "app/interruption.h"
#include "app/options.h"
#include "core/error.h"
#include "core/file.h"
#include "core/text.h"

namespace myotact::app {

namespace {

/// Above, a tick of 1 ms cannot render it stably on any listed device (assets/devices/: 5000 N/m at most).
constexpr double kLargestStiffness_N_m = 10'000.0;

void require_range(const char* option, double value, double low, double high, const char* unit) {
  if (value >= low && value <= high) return;  // false for what is not a number
  throw Error(ExitStatus::Usage,
              fmt::format("{}: is {}; must be in {} .. {} {}", option, to_text(value), low, high, unit));
}

haptics::ContactSettings contact_of(const Options& options) {
  require_range("--radius", options.radius_m, 0.0, 5e-3, "m");
  require_range("--stiffness", options.stiffness_N_m, 1.0, kLargestStiffness_N_m, "N/m");
  require_range("--mu", options.friction, 0.0, 2.0, "(friction coefficient)");
  require_range("--rate", options.rate_hz, 10.0, 100'000.0, "Hz");
  haptics::ContactSettings contact;
  contact.radius_m = options.radius_m;
  contact.stiffness_N_m = options.stiffness_N_m;
  contact.static_friction = contact.dynamic_friction = options.friction;
  contact.damping_Ns_m = 0.0;  // forces out are those of the spring alone: stiffness times depth
  return contact;
}

}  // namespace

int probe(const Options& options) {
  watch_for_interruption();
  measure::ProbeInput input;
  input.contact = contact_of(options);
  input.rate_hz = options.rate_hz;
  input.path = measure::load_path(options.path);
  std::vector<std::string> notes;
  const geometry::TriangleMesh surface = measure::load_probe_surface(options.file, notes);
  for (const std::string& note : notes) spdlog::warn("{}", note);
  std::optional<measure::ProbeFrames> frames;
  if (options.frames) frames.emplace(*options.frames);
  input.surface = &surface;
  input.frames = frames ? &*frames : nullptr;
  make_writable_folder(options.out);
  const measure::ProbeAnswer answer = measure::run_probe(input, [] { return interruption() == 0; });
  if (answer.summary.limited > 0) {
    spdlog::warn("the force was limited to {} N in {} of {} rows: the path goes deeper than the stiffness allows",
                 measure::kLargestProbeForce_N, answer.summary.limited, answer.summary.rows);
  }
  write_file(options.out / "probe.csv", answer.csv);
  std::cout << (options.json ? measure::probe_json(answer.summary) : measure::probe_text(answer.summary)) << std::flush;
  if (const int status = interruption(); status != 0) return status;
  return static_cast<int>(ExitStatus::Done);
}

}  // namespace myotact::app

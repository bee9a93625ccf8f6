#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "haptics/proxy/contact_settings.h"
#include "measure/probe/probe_frames.h"
#include "measure/probe/probe_path.h"
#include "realtime/period_histogram.h"

namespace myotact::measure {

/// Above the strongest device that a hand holds (Virtuose 6D: 35 N): what comes out can go to any device's gate.
inline constexpr double kLargestProbeForce_N = 50.0;

struct ProbeInput {
  const geometry::TriangleMesh* surface = nullptr;  // not owned
  const ProbeFrames* frames = nullptr;              // not owned; null: the surface rests
  ProbePath path;
  haptics::ContactSettings contact;
  double rate_hz = 1000.0;
};

struct ProbeSummary {
  std::uint64_t rows = 0;
  std::uint64_t in_contact = 0;
  std::uint64_t rescues = 0;
  std::uint64_t inside = 0;
  std::uint64_t limited = 0;  // rows whose force was cut to kLargestProbeForce_N
  double largest_force_N = 0.0;
  realtime::DurationSummary tick;
};

struct ProbeAnswer {
  ProbeSummary summary;
  std::string csv;  // a table, one row a tick; `rescues` counts those of the row's tick
};

/// Drives the proxy along the path, a tick at a time on a virtual clock: the same answer every time but for `tick_us`.
/// `go_on` is asked every tick; false ends the run there. Throws Error BadData for a frame that cannot be used.
ProbeAnswer run_probe(const ProbeInput& input, const std::function<bool()>& go_on);

/// The summary as lines of text, or as JSON.
std::string probe_text(const ProbeSummary& summary);
std::string probe_json(const ProbeSummary& summary);

}  // namespace myotact::measure

#include "app/timing_report.h"

#include <ostream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace myotact::app {

namespace {

nlohmann::json percentiles_us(const realtime::DurationSummary& summary) {
  const auto us = [](std::uint64_t ns) { return static_cast<double>(ns) * 1e-3; };
  return {{"count", summary.count},
          {"p50_us", us(summary.p50_ns)},
          {"p99_us", us(summary.p99_ns)},
          {"p99.9_us", us(summary.p999_ns)},
          {"max_us", us(summary.max_ns)}};
}

void print(const nlohmann::json& value, const std::string& name, std::ostream& out) {
  if (value.is_object()) {
    for (const auto& item : value.items())
      print(item.value(), name.empty() ? item.key() : name + "." + item.key(), out);
  } else if (!value.is_array()) {
    out << fmt::format("{:<32} {}\n", name, value.dump());
  }
}

}  // namespace

nlohmann::json timing_json(const scene::FreeTiming& timing, const scene::Scene& scene) {
  nlohmann::json json = {{"simulation_hz", static_cast<double>(timing.steps) / timing.wall_s},
                         {"haptic_hz", static_cast<double>(timing.ticks) / timing.wall_s},
                         {"missed_ticks", timing.missed_ticks},
                         {"time_factor", timing.simulated_s / timing.wall_s},
                         {"step", percentiles_us(timing.step)},
                         {"tick", percentiles_us(timing.tick)},
                         {"tick_period", percentiles_us(timing.tick_period)},
                         {"not_permitted", timing.refused}};
  for (std::size_t t = 0; t < timing.tool_ticks.size() && scene.tools.size() > 1; ++t) {
    json[scene.tools[t].hand + "_tick"] = percentiles_us(timing.tool_ticks[t]);
  }
  return json;
}

void print_summary(const nlohmann::json& report, std::ostream& out) {
  print(report, "", out);
  if (report.contains("stiffness")) {
    out << "co-contraction   K Schur   K perturbed   K lines [N m/rad]   net torque [N m]\n";
    for (const auto& row : report["stiffness"]) {
      out << fmt::format("{:>14.2f} {:>9.3f} {:>13.3f} {:>9.3f} {:>28.5f}{}{}\n", row["common"].get<double>(),
                         row["K_schur_Nm_rad"].get<double>(), row["K_perturbed_Nm_rad"].get<double>(),
                         row["K_line_Nm_rad"].get<double>(), row["net_torque_Nm"].get<double>(),
                         row["converged"] == 1 ? "" : "  not converged",
                         row.contains("mark") ? "  " + row["mark"].get<std::string>() : "");
    }
  }
  out << std::flush;
}

}  // namespace myotact::app

#include "prepare/report/surface_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace myotact::prepare {

namespace {

nlohmann::ordered_json json_of(const SurfaceReport& r) {
  nlohmann::ordered_json json = {{"key", r.key},
                                 {"kind", r.muscle ? "muscle" : "bone"},
                                 {"input_triangles", r.input_triangles},
                                 {"repairs", nlohmann::ordered_json::array()},
                                 {"moved_m", r.moved_m},
                                 {"skin_triangles", r.skin_triangles},
                                 {"volume_m3", r.volume_m3},
                                 {"notes", r.notes}};
  for (const RepairStep& step : r.repairs) {
    json["repairs"].push_back({{"what", step.what}, {"count", step.count}, {"place_m", to_array(step.place_m)}});
  }
  if (!r.muscle) return json;
  json.update({{"tets", r.tets.tets},
               {"smallest_dihedral_deg", r.tets.smallest_dihedral_deg},
               {"first_percentile_dihedral_deg", r.tets.first_percentile_dihedral_deg},
               {"shortest_edge_m", r.tets.shortest_edge_m},
               {"cage_attempts", r.cage_attempts},
               {"cage_volume_error", r.cage_volume_error},
               {"cage_deviation_m", r.cage_deviation_m},
               {"cage_edge_m", r.cage_edge_m},
               {"mean_ratio", r.tets.mean_ratio},
               {"parted_loss_m3", r.parted_loss_m3},
               {"overlap_p95_m", r.overlap_p95_m},
               {"overlap_largest_m", r.overlap_largest_m},
               {"origin_area_m2", r.origin_area_m2},
               {"insertion_area_m2", r.insertion_area_m2},
               {"origin_gap_m", r.origin_gap_m},
               {"insertion_gap_m", r.insertion_gap_m},
               {"filled_tets", r.filled_tets},
               {"fibre_angle_deg", r.fibre_angle_deg},
               {"path_m", r.path_m},
               {"belly_m", r.belly_m},
               {"largest_section_m2", r.largest_section_m2},
               {"levers_m", nlohmann::ordered_json::object()}});
  for (const auto& [joint, moment_arm_m] : r.moment_arms_m) json["levers_m"][joint] = moment_arm_m;
  return json;
}

std::string moment_arms_text(const SurfaceReport& r) {
  std::string text;
  for (const auto& [joint, moment_arm_m] : r.moment_arms_m)
    text += fmt::format(" {} {:+.1f}", joint, 1e3 * moment_arm_m);
  return text;
}

}  // namespace

std::string report_table(const std::vector<SurfaceReport>& reports) {
  std::string text = fmt::format("{:<30} {:>6} {:>5} {:>6} {:>5} {:>4} {:>5} {:>5} {:>5} {:>6} {:>9} {:>4} {:>8}  {}\n",
                                 "surface", "tri in", "skin", "cm3", "lost", "tets", "min", "1 %", "ratio", "dV %",
                                 "gap o/i", "fill", "belly", "moment arms, mm");
  for (const SurfaceReport& r : reports) {
    text += fmt::format("{:<30} {:>6} {:>5} {:>6.1f} ", r.key, r.input_triangles, r.skin_triangles, 1e6 * r.volume_m3);
    if (r.muscle) {
      text +=
          fmt::format("{:>5.1f} {:>4} {:>5.1f} {:>5.1f} {:>5.2f} {:>6.2f} {:>4.1f}/{:<4.1f} {:>4} {:>3.0f}/{:<4.0f} ",
                      1e6 * r.parted_loss_m3, r.tets.tets, r.tets.smallest_dihedral_deg,
                      r.tets.first_percentile_dihedral_deg, r.tets.mean_ratio, 100.0 * r.cage_volume_error,
                      1e3 * r.origin_gap_m, 1e3 * r.insertion_gap_m, r.filled_tets, 1e3 * r.belly_m, 1e3 * r.path_m);
      text += moment_arms_text(r);
    }
    for (const RepairStep& step : r.repairs) text += "  [" + step_text(step) + "]";
    for (const std::string& note : r.notes) text += "  [" + note + "]";
    text += "\n";
  }
  return text;
}

std::string report_json_lines(const std::vector<SurfaceReport>& reports) {
  std::string text;
  for (const SurfaceReport& r : reports) text += json_of(r).dump() + "\n";
  return text;
}

}  // namespace myotact::prepare

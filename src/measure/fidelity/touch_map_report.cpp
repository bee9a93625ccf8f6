#include "measure/fidelity/touch_map_report.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/at.h"
#include "core/csv.h"
#include "core/text.h"

namespace myotact::measure {

namespace {

nlohmann::json vector_json(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

nlohmann::json place_json(const TouchMap& map, const TouchedPlace& touched) {
  return {{"muscle", map.muscles[at(touched.place.muscle)]},
          {"position_world_m", vector_json(touched.place.position_m)},
          {"normal_world", vector_json(touched.place.normal)},
          {"felt_peak_N", touched.felt_peak_N},
          {"error_rms_share", touched.error_share},
          {"gain", touched.gain},
          {"held_swing_N", touched.held_swing_N},
          {"largest_step_N", touched.largest_step_N},
          {"verdict", grade_text(worst_grade(grade(touched)))}};
}

/// "-" for what is not known.
std::string percent_text(double share) {
  return std::isfinite(share) ? fmt::format("{:.1f}", 100.0 * share) : "-";
}

}  // namespace

std::vector<MuscleTouch> by_muscle(const TouchMap& map) {
  std::vector<MuscleTouch> rows;
  for (int m = 0; m < static_cast<int>(map.muscles.size()); ++m) {
    MuscleTouch row{m, places_of(map, Grade::Good, m), places_of(map, Grade::Fair, m), places_of(map, Grade::Poor, m),
                    places_of(map, Grade::Unknown, m)};
    std::vector<double> errors;
    for (const TouchedPlace& touched : map.places) {
      if (touched.place.muscle != m) continue;
      row.worst_swing_N = std::max(row.worst_swing_N, touched.held_swing_N);
      if (std::isfinite(touched.error_share)) errors.push_back(touched.error_share);
    }
    std::sort(errors.begin(), errors.end());
    row.median_error_share = row.worst_error_share = std::numeric_limits<double>::quiet_NaN();
    if (!errors.empty()) {
      row.median_error_share = 0.5 * (errors[(errors.size() - 1) / 2] + errors[errors.size() / 2]);
      row.worst_error_share = errors.back();
    }
    rows.push_back(row);
  }
  return rows;
}

std::string verdict_text(const TouchMap& map) {
  const int good = places_of(map, Grade::Good), all = static_cast<int>(map.places.size());
  return fmt::format("good at {} of {} places ({:.0f} %), fair at {}, poor at {}, nothing felt at {}", good, all,
                     all == 0 ? 0.0 : 100.0 * good / all, places_of(map, Grade::Fair), places_of(map, Grade::Poor),
                     places_of(map, Grade::Unknown));
}

std::string touch_map_text(const TouchMap& map) {
  std::string text = fmt::format("{}: {}\n", map.scene, verdict_text(map));
  if (!map.complete) text += "interrupted: the places after these were not touched\n";
  text += fmt::format("\n  {:<42} {:>5} {:>5} {:>5} {:>9} {:>9} {:>12}\n", "", "good", "fair", "poor", "median %",
                      "worst %", "swing mN");
  for (const MuscleTouch& row : by_muscle(map)) {
    const std::string& name = map.muscles[at(row.muscle)];
    if (row.good + row.fair + row.poor + row.unknown == 0)
      text += fmt::format("  {:<42} lies under others\n", name);
    else
      text += fmt::format("  {:<42} {:>5} {:>5} {:>5} {:>9} {:>9} {:>12.1f}\n", name, row.good, row.fair, row.poor,
                          percent_text(row.median_error_share), percent_text(row.worst_error_share),
                          1e3 * row.worst_swing_N);
  }
  return text;
}

std::string touch_map_json(const TouchMap& map) {
  nlohmann::json json = {{"scene", map.scene},
                         {"device", map.device},
                         {"complete", map.complete},
                         {"asked_a_muscle", map.asked},
                         {"good", places_of(map, Grade::Good)},
                         {"fair", places_of(map, Grade::Fair)},
                         {"poor", places_of(map, Grade::Poor)},
                         {"nothing_felt", places_of(map, Grade::Unknown)},
                         {"places", nlohmann::json::array()}};
  for (const TouchedPlace& touched : map.places) json["places"].push_back(place_json(map, touched));
  return json.dump(2) + "\n";
}

std::string touch_map_csv(const TouchMap& map) {
  std::string csv =
      "muscle,x_m,y_m,z_m,normal_x,normal_y,normal_z,felt_peak_N,error_rms_share,gain,held_swing_N,largest_step_N,"
      "verdict\n";
  for (const TouchedPlace& touched : map.places) {
    csv += csv_field(map.muscles[at(touched.place.muscle)]);
    for (const Vec3* vector : {&touched.place.position_m, &touched.place.normal})
      for (int k = 0; k < 3; ++k) csv += "," + to_text((*vector)[k]);
    for (const double value :
         {touched.felt_peak_N, touched.error_share, touched.gain, touched.held_swing_N, touched.largest_step_N})
      csv += "," + to_text(value);
    csv += fmt::format(",{}\n", grade_text(worst_grade(grade(touched))));
  }
  return csv;
}

}  // namespace myotact::measure

#include "measure/fidelity/planted_faults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string_view>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"

namespace myotact::measure {

namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;

struct PlantKey {
  const char* name;
  double unit;  // SI over that of the key
  double lowest, highest;
  double PlantedFaults::*value;
};
constexpr std::array kKeys = {PlantKey{"delay_ms", 1e-3, 0.0, 50.0, &PlantedFaults::delay_s},
                              PlantKey{"scale", 1.0, 0.5, 2.0, &PlantedFaults::scale},
                              PlantKey{"rotate_deg", kDegree_rad, -30.0, 30.0, &PlantedFaults::rotate_rad},
                              PlantKey{"noise_mN", 1e-3, 0.0, 1000.0, &PlantedFaults::noise_N}};

void read_pair(std::string_view pair, PlantedFaults& faults) {
  const std::size_t equals = std::min(pair.find('='), pair.size());
  const auto key =
      std::find_if(kKeys.begin(), kKeys.end(), [&](const PlantKey& k) { return pair.substr(0, equals) == k.name; });
  if (key == kKeys.end()) {
    throw Error(ExitStatus::Usage, fmt::format("--plant {}: must be one of delay_ms=, scale=, rotate_deg=, noise_mN=, "
                                               "for example --plant delay_ms=5,scale=0.9",
                                               pair));
  }
  const auto number = parse_number(pair.substr(std::min(equals + 1, pair.size())));
  if (!number || !(*number >= key->lowest && *number <= key->highest)) {
    throw Error(ExitStatus::Usage,
                fmt::format("--plant {}: must be a number in {} .. {}", pair, key->lowest, key->highest));
  }
  faults.*key->value = *number * key->unit;
}

/// Across the mean of the forces; up and down where that may be.
Vec3 axis_across(const std::vector<Vec3>& force_N) {
  Vec3 sum_N = Vec3::Zero();
  for (const Vec3& force : force_N) sum_N += force;
  const Vec3 along = sum_N.normalized();  // zero stays zero
  const Vec3 up = Vec3::UnitZ() - along.z() * along;
  return up.norm() > 0.1 ? Vec3(up.normalized()) : Vec3(along.unitOrthogonal());
}

/// Normal numbers by Box and Muller: the library's distribution is not the same everywhere.
class Noise {
 public:
  double next() {
    const double radius = std::sqrt(-2.0 * std::log(unit())), angle_rad = 2.0 * std::numbers::pi * unit();
    return radius * std::cos(angle_rad);
  }

 private:
  double unit() { return (static_cast<double>(random_() >> 11) + 0.5) * 0x1p-53; }
  std::mt19937_64 random_{20};
};

}  // namespace

PlantedFaults parse_planted_faults(const std::string& text) {
  PlantedFaults faults;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    read_pair(std::string_view(text).substr(start, end - start), faults);
    start = end + 1;
  }
  return faults;
}

std::vector<Vec3> plant(const PlantedFaults& faults, const std::vector<Vec3>& force_N) {
  const Mat3 rotation = Eigen::AngleAxisd(faults.rotate_rad, axis_across(force_N)).toRotationMatrix();
  const double axis_N = faults.noise_N / std::sqrt(3.0);
  Noise noise;
  std::vector<Vec3> planted;
  planted.reserve(force_N.size());
  for (std::size_t i = 0; i < force_N.size(); ++i) {
    const Vec3 late_N = force_at(force_N, static_cast<double>(i) - 1e3 * faults.delay_s);
    planted.emplace_back(faults.scale * (rotation * late_N));
    if (axis_N > 0.0) planted.back() += axis_N * Vec3(noise.next(), noise.next(), noise.next());
  }
  return planted;
}

PlantedFaults found_faults(const ForceComparison& before, const ForceComparison& after) {
  const auto rotation_of = [](const ForceComparison& found) {
    return Eigen::AngleAxisd(found.rotation_angle_rad(), found.rotation_rad.normalized()).toRotationMatrix();
  };
  PlantedFaults found;
  found.delay_s = after.lag_s - before.lag_s;
  found.scale = after.gain / before.gain;
  found.rotate_rad = Eigen::AngleAxisd(Mat3(rotation_of(after) * rotation_of(before).transpose())).angle();
  const double scaled_N = found.scale * before.noise_rms_N;  // the noise there was is scaled with the force
  found.noise_N = std::sqrt(std::max(0.0, after.noise_rms_N * after.noise_rms_N - scaled_N * scaled_N));
  return found;
}

bool PlantedReport::all_found() const {
  constexpr double kTenth = 0.1;
  const auto within = [](double found, double was) { return std::abs(found - was) <= kTenth * std::abs(was) + 1e-9; };
  const auto near = [&](double found, double was, double floor) {
    return was == 0.0 ? std::abs(found) <= floor : within(found, was);
  };
  // Floors for what was not planted: a tenth of the smallest fault that the tests plant.
  return near(alone.delay_s, planted.delay_s, 5e-4) && near(1.0 - alone.scale, 1.0 - planted.scale, 0.01) &&
         near(alone.rotate_rad, std::abs(planted.rotate_rad), 0.5 * kDegree_rad) &&
         near(alone.noise_N, planted.noise_N, 2e-3);
}

PlantedReport report_planted(const ForceSeries& series, const PlantedFaults& faults) {
  const std::vector<Vec3> planted_N = plant(faults, series.commanded_N);
  ForceSeries planted = series;
  planted.commanded_N = planted_N;
  ForceSeries same = series;  // beside itself
  same.true_N = series.commanded_N;
  ForceSeries alone = same;
  alone.commanded_N = planted_N;
  return {faults, found_faults(compare_forces(same), compare_forces(alone)),
          found_faults(compare_forces(series), compare_forces(planted))};
}

}  // namespace myotact::measure

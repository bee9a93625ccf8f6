#include "view/render/pressure_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace myotact::view {

double pressure_Pa(const messages::ToolFrame& tool) {
  if (!tool.in_contact || tool.radius_m <= 0.0) return 0.0;
  const auto& f = tool.force_world_N;
  return std::hypot(f[0], f[1], f[2]) / (std::numbers::pi * tool.radius_m * tool.radius_m);
}

PressureMap::PressureMap(const anatomy::Specimen& specimen) {
  for (const anatomy::Muscle& muscle : specimen.muscles) peaks_Pa_.emplace_back(muscle.skin.positions_m.size());
}

void PressureMap::clear() {
  for (auto& peaks : peaks_Pa_) std::fill(peaks.begin(), peaks.end(), 0.0f);
  empty_ = true;
}

void PressureMap::add(const messages::SceneFrame& frame) {
  constexpr double kSpread = 2.0;  // of the spot over the tool's radius: skins have a vertex every few millimetres
  for (const messages::ToolFrame& tool : frame.tools) {
    const auto m = static_cast<std::size_t>(tool.touched_muscle);
    const double peak_Pa = pressure_Pa(tool);
    if (tool.touched_muscle < 0 || m >= peaks_Pa_.size() || m >= frame.skins_world_m.size() || peak_Pa <= 0.0) continue;
    const double spot_m2 = kSpread * kSpread * tool.radius_m * tool.radius_m;
    const auto& skin = frame.skins_world_m[m];
    for (std::size_t v = 0; v < skin.size() && v < peaks_Pa_[m].size(); ++v) {
      double distance_m2 = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double d = static_cast<double>(skin[v][k]) - tool.proxy_world_m[k];
        distance_m2 += d * d;
      }
      if (distance_m2 >= spot_m2) continue;
      peaks_Pa_[m][v] = std::max(peaks_Pa_[m][v], static_cast<float>(peak_Pa * (1.0 - distance_m2 / spot_m2)));
      empty_ = false;
    }
  }
}

}  // namespace myotact::view

#pragma once

#include <string>
#include <vector>

#include "fit_texture/recorded_signal.h"
#include "haptics/effects/texture_set.h"

namespace myotact::fit_texture {

/// What to fit. One force and one speed: the whole recording is taken as made so. More: the recording must hold columns
/// of both, and every piece of 0.1 s goes to the node that is nearest in proportion.
struct FitSettings {
  std::vector<double> force_N, speed_m_s;  // rising, > 0
  int order = 8;                           // of the process, 1 .. 30
  double gain = 1.0;                       // on the force, for recordings that are too strong
};

/// The grid of models that the recording's vibration is nearest to, at the texture's own rate. `name` of the file is
/// for errors: BadData when the rate is out of range, there is too little of it for a node, it is silent, or it is
/// stronger than a texture may be; Usage when columns are needed that it does not have.
haptics::VibrationGrid fit_vibration(const RecordedSignal& recording, const FitSettings& settings,
                                     const std::string& name);

/// A texture file (assets/textures/README.md) that holds the grid.
std::string texture_text(const haptics::VibrationGrid& grid, const std::string& tissue, const std::string& note);

}  // namespace myotact::fit_texture

#pragma once

#include <vector>

#include "anatomy/specimen.h"
#include "messages/scene_frame.h"

namespace myotact::view {

/// Pressure under a tool [Pa]: its force over the cross-section of its sphere. An estimate: the true contact is smaller
/// while the tool hardly sinks in, and larger when it is deep.
double pressure_Pa(const messages::ToolFrame& tool);

/// Where the muscles have been pressed, and how hard at most: a value a skin vertex.
class PressureMap {
 public:
  explicit PressureMap(const anatomy::Specimen& specimen);

  /// Once a picture: what the tools touch now.
  void add(const messages::SceneFrame& frame);
  void clear();

  /// Muscles x skin vertices [Pa].
  const std::vector<std::vector<float>>& peaks_Pa() const { return peaks_Pa_; }
  bool empty() const { return empty_; }

 private:
  std::vector<std::vector<float>> peaks_Pa_;
  bool empty_ = true;
};

}  // namespace myotact::view

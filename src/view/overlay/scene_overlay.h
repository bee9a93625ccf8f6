#pragma once

#include <string>
#include <vector>

#include "anatomy/specimen.h"
#include "messages/scene_frame.h"
#include "view/look/part.h"
#include "view/overlay/label_placing.h"
#include "view/render/muscle_colour.h"
#include "view/ui/layout.h"

struct ImDrawList;

namespace myotact::view {

/// A length for a scale bar: 1, 2 or 5 times a power of ten, the largest that is not longer [metres].
double round_length_m(double longest_m);

/// What the overlay is written over.
struct OverlaidScene {
  const anatomy::Specimen& specimen;
  const messages::SceneFrame& frame;
  const ViewState& view;
  const std::vector<bool>& superficial;  // as for opacity_of()
  Part hovered;
  glm::vec3 background{1.0f};  // text is dark on a light one
  bool tools_lag = false;      // some may, behind hands that feel nothing: the legend explains what joins the two
  bool legend = true;
};

/// What is written over the scene: names with leader lines, the legend of the colours, a scale bar. Between ImGui's
/// NewFrame and Render.
class SceneOverlay {
 public:
  /// With `view.labels` all parts that are seen are named, else what is selected or hovered, and nothing while names
  /// are hidden.
  void draw(const OverlaidScene& scene, const Area& area, ImDrawList& list);

 private:
  // In the last picture.
  std::vector<PlacedLabel> placed_;
  std::vector<LabelWish> wishes_;
};

}  // namespace myotact::view

#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "anatomy/specimen.h"
#include "messages/scene_frame.h"
#include "view/look/view_state.h"

namespace myotact::view {

/// What is laid over a muscle's own look: a tint through which its strands and tendons show, and stripes across it as a
/// second cue for those who cannot distinguish the colours.
struct MuscleTint {
  glm::vec3 colour{0.0f};
  float stripe_m = 0.0f;  // from stripe to stripe along the muscle; 0: none
  float share = 0.0f;     // of the tint, 0 .. 1
};

/// What the colours mean.
struct Legend {
  struct Entry {
    const char* key = "";  // of its text
    MuscleTint tint;
    bool thread = false;  // in place of a colour: what joins hand and tool
  };
  const char* title_key = "";
  const char* unit_key = "";  // empty: without
  double lowest = 0.0, highest = 0.0;
  std::vector<glm::vec3> scale;  // evenly spaced colours from lowest to highest, or empty
  std::vector<Entry> entries;    // named colours
};

/// A muscle's own look, on the average: of no activation, no tension, so that what is at work stands out.
inline constexpr glm::vec3 kIdleMuscle{0.596f, 0.243f, 0.204f};

/// Atlases paint origins red and insertions blue; these are Okabe and Ito's.
inline constexpr glm::vec3 kOriginColour{0.84f, 0.37f, 0.00f}, kInsertionColour{0.00f, 0.45f, 0.70f};

/// One tint a muscle. `joint`: whose stiffness is shared out. Values that the frame lacks count as none.
std::vector<MuscleTint> tint_muscles(const anatomy::Specimen& specimen, const messages::SceneFrame& frame,
                                     MuscleColour colour, int joint);

/// Of the colours of muscles, and of origins and insertions where these are shown.
Legend legend_of(const anatomy::Specimen& specimen, const ViewState& view);

/// Largest of the map of pressures [Pa].
inline constexpr float kPressureRange_Pa = 20e3f;

}  // namespace myotact::view

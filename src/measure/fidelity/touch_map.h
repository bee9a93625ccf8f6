#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "device/device.h"
#include "measure/fidelity/scene_fidelity.h"
#include "measure/fidelity/touch_places.h"
#include "messages/scene_frame.h"

namespace myotact::measure {

// How true touch is all over a limb: at random places of every muscle the hand presses 4 mm deep, holds for a second,
// strokes 5 mm as the muscle runs and 5 mm across, and lifts off; each time from the scene's start.

struct TouchMapRequest {
  std::string device = "simulated";
  device::DeviceProfile profile;
  int places = 6;  // of every muscle
  std::uint64_t seed = 1;
};

/// What was felt at one place.
struct TouchedPlace {
  TouchPlace place;
  double felt_peak_N = 0.0;
  double error_share = 0.0;     // RMS of commanded less true over RMS of true; NaN: nothing was felt
  double gain = 0.0;            // as ForceComparison; NaN likewise
  double held_swing_N = 0.0;    // RMS over 20 Hz while the hand holds still
  double largest_step_N = 0.0;  // change of the commanded force from one tick to the next
};

struct TouchMap {
  std::string scene, title, device;
  std::vector<std::string> muscles;  // names, as in the specimen
  int asked = 0;                     // places of every muscle
  std::vector<TouchedPlace> places;  // by muscle; fewer when stopped
  bool complete = false;
  messages::SceneFrame frame;  // the limb at the scene's start, where the places are
};

/// On scene.settings.workers threads with a simulation each; what a place gives does not depend on their number nor on
/// the other places. Texture and the snap of lines are left out. Throws Error BadData where no muscle can be touched.
TouchMap map_touch(const scene::Scene& scene, const TouchMapRequest& request, const RunWatch& watch);

/// Error and swing beside their bounds; empty where nothing was felt.
std::vector<GradedFigure> grade(const TouchedPlace& place);

/// Places of one grade: of one muscle, or with -1 of all.
int places_of(const TouchMap& map, Grade grade, int muscle = -1);

}  // namespace myotact::measure

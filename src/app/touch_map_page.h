#pragma once

#include <string>
#include <vector>

#include "anatomy/specimen.h"
#include "measure/fidelity/touch_map.h"
#include "view/pictures/offscreen.h"

namespace myotact::app {

/// The limb from one side with a ball at each place that looks that way, in the colour of its verdict.
struct TouchPicture {
  std::string side;  // as view::camera_of() has it
  view::Image image;
};
/// From lateral, medial, cranial and caudal. Throws Error Unavailable without any OpenGL.
std::vector<TouchPicture> touch_pictures(const anatomy::Specimen& specimen, const measure::TouchMap& map);

/// One self-contained HTML page for a person: the verdict, the pictures (none: a sentence instead), a row a muscle and
/// the places that are not good.
std::string touch_map_page(const measure::TouchMap& map, const std::vector<TouchPicture>& pictures);

}  // namespace myotact::app

#pragma once

#include <span>
#include <string>

#include "anatomy/specimen.h"
#include "messages/scene_frame.h"
#include "view/look/show_options.h"
#include "view/look/view_state.h"
#include "view/pictures/offscreen.h"

namespace myotact::view {

/// Small pictures of a limb in several states on one: a row a state, a column a side. All are framed on the box round
/// the limb in all states, so that what moved is seen. The same bytes each time on one machine.
struct ContactSheet {
  std::span<const messages::SceneFrame> rows;
  std::span<const std::string> columns;  // camera_of()
  PictureSize cell;
};

/// `look`: all but the camera. Throws as OffscreenRenderer and camera_of(); Usage without a row or a column, or when
/// the whole would be wider or higher than 16384 pixels.
Image draw_contact_sheet(const anatomy::Specimen& specimen, const ContactSheet& sheet, const ViewState& look,
                         const SceneExtras& extras = {});

}  // namespace myotact::view

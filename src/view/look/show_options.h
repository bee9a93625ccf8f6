#pragma once

#include <span>
#include <string>

#include "anatomy/specimen.h"
#include "view/look/view_state.h"

namespace myotact::view {

/// Applies what was asked for on a command line, in its order, each "what=value":
///
///   muscles=KEYS  bones=KEYS       only these are drawn; several with commas; all, none
///   faded=KEYS                     these shine through
///   select=KEY                     outlined; with attachments=on only its own
///   layers=LAYERS                  only these: superficial, deep, bones; all, none
///   colour=WHAT                    kind, activation, tension, stretch, volume_error, stiffness_share, pressure
///   names=STYLE                    english, latin, both
///   section=SIDE:SHARE             cuts away what lies towards cranial, caudal, left, right, dorsal or ventral of the
///                                  place that is SHARE, 0 .. 1, of the way there through the limb
///   labels lines fibres attachments=on or off
///
/// Throws Error Usage naming the wrong word, what is known and the nearest of it.
void apply_show_options(std::span<const std::string> options, const anatomy::Specimen& specimen, ViewState& view);

/// From a standard view's name, or azimuth,elevation in degrees ("90,15": azimuth 0 is cranial, 90 left), with the
/// whole box in the picture. Throws as above.
Camera camera_of(const std::string& view, const anatomy::Specimen& specimen, const ViewBox& box, float aspect);

struct PictureSize {
  int width = 900, height = 1200;  // pixels
};
/// "900x1200". Throws as above.
PictureSize picture_size_of(const std::string& text);

}  // namespace myotact::view

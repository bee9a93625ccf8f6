#pragma once

#include <string>
#include <vector>

#include "anatomy/specimen.h"
#include "view/look/camera.h"

namespace myotact::view {

/// What the colour of a muscle means.
enum class MuscleColour { Kind, Activation, Tension, Stretch, VolumeError, StiffnessShare, Pressure };

/// In which language bones and muscles are called.
enum class NameStyle { English, Latin, Both };

struct PartLook {
  bool hidden = false;
  bool faded = false;  // shines through, and the tool's eye passes it

  bool operator==(const PartLook&) const = default;
};

/// Opacity of whole layers, 0 (not drawn) .. 1.
struct LayerLook {
  float superficial = 1.0f, deep = 1.0f, bones = 1.0f;

  bool operator==(const LayerLook&) const = default;
};

/// Cuts away what lies on the far side of a plane across one axis of the world.
struct SectionPlane {
  bool on = false;
  bool flipped = false;  // keeps the other side
  int axis = 1;          // 0 cranial, 1 left, 2 up
  float share = 0.5f;    // place along the limb's box, 0 .. 1

  bool operator==(const SectionPlane&) const = default;
};

/// How the scene is looked at: everything that a picture depends on besides the frame. A value: undo, bookmarks and
/// pictures without a window copy and compare it.
struct ViewState {
  Camera camera;
  std::vector<PartLook> bones, muscles;  // as in the specimen
  LayerLook layers;
  MuscleColour colour = MuscleColour::Activation;
  NameStyle names = NameStyle::English;
  SectionPlane section;
  bool labels = false;
  bool names_hidden = false;  // of all parts, wherever they would be named: something is to be recognised
  bool lines = true;
  bool fibres = false;
  bool attachments = false;          // areas of origin and insertion, of the selected muscle or of all
  std::vector<int> plotted_muscles;  // whose tension is among the plots, in the order of asking
  int selected_muscle = -1;          // of these two at most one
  int selected_bone = -1;

  bool operator==(const ViewState&) const = default;
};

}  // namespace myotact::view

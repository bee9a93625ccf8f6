#pragma once

namespace myotact::view {

/// A part of the window [pixels of the window, from its top left corner].
struct Area {
  float x = 0.0f, y = 0.0f, width = 0.0f, height = 0.0f;

  bool empty() const { return width <= 0.0f || height <= 0.0f; }
};

/// Where what is drawn:
///
///   +-------------------- toolbar -------------------+
///   | find  |                              |  tasks  |
///   |       |            scene             |         |
///   |       |                              |         |
///   |       +---------- timeline ----------+         |
///   +--------------------- status -------------------+
///
/// In a window that is too small for all, panels give way to the scene: an empty area is not drawn.
struct Layout {
  Area toolbar, find, scene, timeline, tasks, status;
};

/// The largest height of the font [pixels] with which toolbar and tasks are drawn in such a window: larger letters
/// would hide the very control that makes them smaller.
float largest_em(float width, float height);

/// Which panels the person wants beside the limb; the others are folded.
struct SidePanels {
  bool find = true, tasks = true;
};

/// `em`: height of the font [pixels].
Layout layout_of(float width, float height, float em, const SidePanels& sides = {});

}  // namespace myotact::view

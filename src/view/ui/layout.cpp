#include "view/ui/layout.h"

#include <algorithm>

namespace myotact::view {

namespace {

// In heights of the font.
constexpr float kToolbar = 2.6f, kTwoRows = 4.4f, kFind = 16.0f, kTasks = 25.0f, kTimeline = 3.2f, kStatus = 1.9f;
constexpr float kNarrowestScene = 20.0f, kLowestScene = 16.0f;
constexpr float kWideToolbar = 83.0f;  // in which its controls stand in one row in any language; else in two

}  // namespace

float largest_em(float width, float height) {
  return std::min(width / (kTasks + kNarrowestScene), height / (kTwoRows + kTimeline + kStatus + kLowestScene));
}

Layout layout_of(float width, float height, float em, const SidePanels& sides) {
  Layout layout;
  layout.scene = {0.0f, 0.0f, width, height};
  const float toolbar = width >= kWideToolbar * em ? kToolbar : kTwoRows;
  const float rows = (toolbar + kTimeline + kStatus) * em;
  if (height >= rows + kLowestScene * em) {
    layout.toolbar = {0.0f, 0.0f, width, toolbar * em};
    layout.status = {0.0f, height - kStatus * em, width, kStatus * em};
    layout.scene.y = layout.toolbar.height;
    layout.scene.height = height - layout.toolbar.height - layout.status.height;
  }
  if (sides.tasks && width >= (kTasks + kNarrowestScene) * em) {
    layout.tasks = {width - kTasks * em, layout.scene.y, kTasks * em, layout.scene.height};
    layout.scene.width -= layout.tasks.width;
  }
  const float beside = (sides.tasks ? kTasks : 0.0f) + kNarrowestScene;
  if (sides.find && width >= (kFind + beside) * em) {
    layout.find = {0.0f, layout.scene.y, kFind * em, layout.scene.height};
    layout.scene.x = layout.find.width;
    layout.scene.width -= layout.find.width;
  }
  if (!layout.toolbar.empty()) {
    layout.scene.height -= kTimeline * em;
    layout.timeline = {layout.scene.x, layout.scene.y + layout.scene.height, layout.scene.width, kTimeline * em};
  }
  return layout;
}

}  // namespace myotact::view

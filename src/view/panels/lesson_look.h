#pragma once

#include "learn/lesson.h"
#include "view/look/part.h"
#include "view/look/view_state.h"
#include "view/panels/panel.h"
#include "view/state/scene_controls.h"

namespace myotact::view {

/// Shows and sets what a step of a lesson asks for, as a person could by hand, so that undo brings back what was. The
/// side from which it is seen is left to the window.
void show_step(const learn::Step& step, ViewState& view, SceneControls& scene);
/// Whether a name on the screen, or what is shown of a muscle beside it, would be the answer.
bool hides_names(const learn::Task& task);
/// What the mouse has to be for the task.
PointerMode pointer_mode_for(const learn::Task& task);
/// Everything drawn and named again, as after a lesson.
void end_lesson_look(ViewState& view);

/// The same part as the view knows it.
Part part_of(const learn::Part& part);

}  // namespace myotact::view

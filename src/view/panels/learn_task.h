#pragma once

#include <string>

#include "learn/lesson_run.h"
#include "view/panels/panel.h"

namespace myotact::view {

/// What the present step of a lesson asks for, how far it is, and what came of the last answer. `typed`: an answer
/// under way. Between ImGui's NewFrame and Render.
void draw_task(PanelContext& context, learn::LessonRun& run, std::string& typed);

/// How far something is, 0 .. 1, with its text beneath: letters on the bar's own colour are hard to read.
void draw_share(const char* key, double share, const std::string& text);

}  // namespace myotact::view

#pragma once

#include "scene/scene_file.h"
#include "view/panels/panel.h"

namespace myotact::app {

/// What a window gets to know of a scene, whoever simulates it: name, title, note, joint, presets and what else can be
/// opened.
view::SceneFacts facts_of(const scene::Scene& scene);

/// What is in force when it begins.
messages::ControlState start_of(const scene::Scene& scene);

}  // namespace myotact::app

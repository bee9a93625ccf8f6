#pragma once

#include "net/web_files.h"
#include "scene/scene_file.h"

namespace myotact::app {

/// What a browser gets of a class about this scene: the page itself (web/dist, built from web/), texts in every
/// language, facts about the scene's parts, how light falls on them, and lessons. Throws Error NoInput where the page
/// has not been built.
net::WebFiles class_page(const scene::Scene& scene);

}  // namespace myotact::app

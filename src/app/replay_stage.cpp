#include "app/replay_stage.h"

#include <algorithm>

#include "app/picture.h"

namespace myotact::app {

ReplayStage::ReplayStage(const Options& options)
    : loaded_(scene::load_recording(*options.recording, scene_overrides_of(options))), session_(loaded_) {}

view::WindowSettings ReplayStage::window_settings(const Options& options) const {
  view::WindowSettings settings;
  view::SceneFacts& facts = settings.facts;
  facts.scenes = scene::built_in_scenes();
  facts.name = loaded_.scene.name;
  const bool built_in = std::find(facts.scenes.begin(), facts.scenes.end(), facts.name) != facts.scenes.end();
  facts.file = built_in ? facts.name : options.scene;  // to go back to
  facts.title = "Myotact: " + options.recording->filename().string();
  facts.joint = watched_joint(loaded_.scene);
  facts.replay_s = session_.length_s();
  return settings;
}

}  // namespace myotact::app

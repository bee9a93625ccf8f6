#include "app/scene_facts.h"

#include "app/picture.h"

namespace myotact::app {

view::SceneFacts facts_of(const scene::Scene& scene) {
  view::SceneFacts facts;
  facts.name = scene.name;
  facts.title = "Myotact: " + scene.title;
  facts.note = scene.note;
  facts.joint = watched_joint(scene);
  facts.scenes = scene::built_in_scenes();
  if (!scene.co_contraction) return facts;
  for (const auto& preset : scene.co_contraction->presets) {
    facts.presets.push_back({preset.name, preset.common, preset.difference});
  }
  return facts;
}

messages::ControlState start_of(const scene::Scene& scene) {
  messages::ControlState start;
  start.gravity = scene.settings.gravity_m_s2.norm() > 0.0;
  if (scene.co_contraction) {
    start.common = scene.co_contraction->common;
    start.difference = scene.co_contraction->difference;
    start.hold_posture = scene.co_contraction->hold_posture;
  }
  return start;
}

}  // namespace myotact::app

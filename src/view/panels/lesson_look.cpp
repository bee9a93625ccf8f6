#include "view/panels/lesson_look.h"

#include <algorithm>

namespace myotact::view {

namespace {

void show_only(const std::optional<std::vector<int>>& shown, std::vector<PartLook>& looks) {
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const bool is_shown = !shown || std::find(shown->begin(), shown->end(), static_cast<int>(i)) != shown->end();
    looks[i] = {!is_shown, false};
  }
}

MuscleColour colour_of(const std::string& name) {
  static const std::vector<std::pair<std::string, MuscleColour>> kColours = {{"kind", MuscleColour::Kind},
                                                                             {"activation", MuscleColour::Activation},
                                                                             {"tension", MuscleColour::Tension},
                                                                             {"stretch", MuscleColour::Stretch},
                                                                             {"pressure", MuscleColour::Pressure}};
  const auto found = std::find_if(kColours.begin(), kColours.end(), [&](const auto& c) { return c.first == name; });
  return found == kColours.end() ? MuscleColour::Kind : found->second;
}

/// What the task is about, where to find it is not the task.
learn::Part marked_part(const learn::Task& task) {
  if (const auto* name = std::get_if<learn::NameTask>(&task)) return name->part;
  if (const auto* press = std::get_if<learn::PressTask>(&task)) return {press->muscle, -1};
  if (const auto* predict = std::get_if<learn::PredictTask>(&task)) return {predict->muscle, -1};
  return {};
}

void set_scene(const learn::Setting& set, SceneControls& scene) {
  const auto ask = [&](const messages::Order& order) { scene.push(order, messages::Commander::Lesson); };
  const messages::ControlState now = scene.state();
  if (set.common || set.difference) {
    ask(messages::CoContract{set.common.value_or(now.common), set.difference.value_or(now.difference)});
  }
  if (set.flexors && set.extensors) ask(messages::SetLevels{*set.flexors, *set.extensors});
  if (set.hold_posture) ask(messages::HoldPosture{*set.hold_posture});
  if (set.gravity) ask(messages::SetGravity{*set.gravity});
}

}  // namespace

void show_step(const learn::Step& step, ViewState& view, SceneControls& scene) {
  show_only(step.show.muscles, view.muscles);
  show_only(step.show.bones, view.bones);
  for (const learn::Part& part : step.show.faded) {
    auto& looks = part.muscle >= 0 ? view.muscles : view.bones;
    looks[static_cast<std::size_t>(std::max(part.muscle, part.bone))].faded = true;
  }
  view.layers = {};
  view.section.on = false;
  view.colour = colour_of(step.show.colour);
  view.names_hidden = hides_names(step.task);
  view.labels = step.show.labels && !view.names_hidden;
  const learn::Part marked = marked_part(step.task);
  view.selected_muscle = marked.muscle;
  view.selected_bone = marked.bone;
  set_scene(step.set, scene);
}

bool hides_names(const learn::Task& task) {
  return std::holds_alternative<learn::FindTask>(task) || std::holds_alternative<learn::NameTask>(task) ||
         std::holds_alternative<learn::PredictTask>(task) || std::holds_alternative<learn::IdentifyTask>(task);
}

PointerMode pointer_mode_for(const learn::Task& task) {
  if (std::holds_alternative<learn::PredictTask>(task)) return PointerMode::Pull;
  const bool touches = std::holds_alternative<learn::TouchTask>(task) ||
                       std::holds_alternative<learn::PressTask>(task) ||
                       std::holds_alternative<learn::IdentifyTask>(task);
  return touches ? PointerMode::Touch : PointerMode::Look;
}

void end_lesson_look(ViewState& view) {
  show_only(std::nullopt, view.muscles);
  show_only(std::nullopt, view.bones);
  view.colour = MuscleColour::Activation;
  view.names_hidden = false;
  view.selected_muscle = view.selected_bone = -1;
}

Part part_of(const learn::Part& part) {
  return part.muscle >= 0 ? Part{PartKind::Muscle, part.muscle} : Part{PartKind::Bone, part.bone};
}

}  // namespace myotact::view

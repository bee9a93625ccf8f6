#include "scene/script.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.h"
#include "scene/shove_test.h"

namespace myotact::scene {

namespace {

template <class Part>
int require_part(const JsonValue& name, const std::vector<Part>& parts, const char* kind) {
  const std::string key = name.string();
  std::vector<std::string> keys;
  for (const Part& part : parts) keys.push_back(part.key);
  const auto found = std::find(keys.begin(), keys.end(), key);
  if (found == keys.end()) {
    throw name.error(
        fmt::format("the specimen has no {} \"{}\"; the nearest is \"{}\"", kind, key, nearest_word(key, keys)));
  }
  return static_cast<int>(found - keys.begin());
}

Vec3 direction(const JsonValue& value) {
  const Vec3 vector = value.vec3();
  if (!(vector.norm() > 1e-9)) throw value.error("is no direction; must be longer than 1e-9");
  return vector.normalized();
}

constexpr double kDeepestPress_m = 0.03;  // deeper is beyond any muscle of a dog's limb

Action read_touch(JsonObject& action, const anatomy::Specimen& specimen) {
  TouchMuscle touch;
  touch.muscle = require_muscle(action.at("muscle"), specimen);
  touch.at = action.at("at").number_between(0.0, 1.0);
  touch.from = direction(action.at("from"));
  if (const auto depth = action.find("depth_m")) touch.depth_m = depth->number_between(0.0, kDeepestPress_m);
  return touch;
}

Action read_slide(JsonObject& action, const anatomy::Specimen&) {
  SlideOnMuscle slide;
  slide.to = action.at("to").number_between(0.0, 1.0);
  if (const auto depth = action.find("depth_m")) slide.depth_m = depth->number_between(0.0, kDeepestPress_m);
  return slide;
}

Action read_grab(JsonObject& action, const anatomy::Specimen& specimen) {
  GrabLine grab;
  grab.muscle = require_muscle(action.at("muscle"), specimen);
  grab.at = action.at("at").number_between(0.0, 1.0);
  grab.from = direction(action.at("from"));
  grab.drag_m = action.at("drag_m").vec3();
  return grab;
}

Action read_grab_bone(JsonObject& action, const anatomy::Specimen& specimen) {
  GrabBone grab;
  grab.bone = require_bone(action.at("bone"), specimen);
  grab.from = direction(action.at("from"));
  grab.drag_m = action.at("drag_m").vec3();
  return grab;
}

Action read_activate(JsonObject& action, const anatomy::Specimen& specimen) {
  return Activate{require_muscle(action.at("muscle"), specimen), action.at("to").number_between(0.0, 1.0)};
}

Action read_co_contract(JsonObject& action, const anatomy::Specimen&) {
  CoContract set;
  set.common = action.at("common").number_between(0.0, 1.0);
  if (const auto difference = action.find("difference")) set.difference = difference->number_between(-1.0, 1.0);
  return set;
}

Action read_shove(JsonObject& action, const anatomy::Specimen& specimen) {
  constexpr double kLargestShove_Nm = 50.0;  // above what a dog's elbow can hold (31 N m estimated)
  return Shove{require_joint(action.at("joint"), specimen),
               action.at("torque_Nm").number_between(-kLargestShove_Nm, kLargestShove_Nm)};
}

Action read_what(const std::string& what, JsonObject& action, const anatomy::Specimen& specimen) {
  if (what == "move") return MoveHand{action.at("to_m").vec3()};
  if (what == "touch") return read_touch(action, specimen);
  if (what == "slide") return read_slide(action, specimen);
  if (what == "grab_line") return read_grab(action, specimen);
  if (what == "grab_bone") return read_grab_bone(action, specimen);
  if (what == "release") return ReleaseHand{};
  if (what == "activate") return read_activate(action, specimen);
  if (what == "co_contract") return read_co_contract(action, specimen);
  if (what == "hold_posture") return HoldPosture{action.at("on").boolean()};
  if (what == "shove") return read_shove(action, specimen);
  if (what == "shove_test") return TestShove{require_joint(action.at("joint"), specimen)};
  return TakePicture{action.at("view").one_of({"lateral", "medial", "cranial", "caudal", "dorsal", "palmar"})};
}

std::size_t read_hand(const JsonValue& value, const std::vector<std::string>& hands) {
  const std::string hand = value.one_of({"left", "right"});
  const auto found = std::find(hands.begin(), hands.end(), hand);
  if (found == hands.end()) throw value.error("the scene has no tool for the " + hand + " hand; add one to /tools");
  return static_cast<std::size_t>(found - hands.begin());
}

ScriptAction read_action(const JsonValue& value, const anatomy::Specimen& specimen,
                         const std::vector<std::string>& hands) {
  static const std::vector<std::string> kActions = {"move",         "touch",   "slide",      "grab_line",
                                                    "grab_bone",    "release", "activate",   "co_contract",
                                                    "hold_posture", "shove",   "shove_test", "picture"};
  constexpr double kLongestRun_s = 86400.0;
  JsonObject object(value);
  ScriptAction action;
  action.start_s = object.at("t_s").number_between(0.0, kLongestRun_s);
  if (const auto duration = object.find("duration_s")) action.duration_s = duration->number_between(0.0, kLongestRun_s);
  action.what = read_what(object.at("do").one_of(kActions), object, specimen);
  if (std::holds_alternative<TestShove>(action.what)) action.duration_s = kShoveTest_s;
  if (moves_hand(action.what)) {
    if (const auto hand = object.find("hand")) action.tool = read_hand(*hand, hands);
  }
  object.finish();
  return action;
}

/// A hand with two commands at once would silently obey only the later one.
void require_free_hand(const JsonValue& element, const std::vector<ScriptAction>& script, std::size_t hand_count) {
  constexpr double kSameTime_s = 1e-9;  // of sums of decimal fractions
  const ScriptAction& action = script.back();
  for (std::size_t i = 0; i + 1 < script.size(); ++i) {
    const ScriptAction& before = script[i];
    const bool overlaps = moves_hand(action.what) && moves_hand(before.what) && before.tool == action.tool &&
                          before.end_s() > action.start_s + kSameTime_s;
    if (!overlaps) continue;
    throw element.error(fmt::format("starts at {} s, before the {}hand's action {} ends at {} s; let it start then{}",
                                    action.start_s, hand_count > 1 ? "same " : "", i, before.end_s(),
                                    hand_count > 1 ? ", or give it to the other hand" : ""));
  }
}

}  // namespace

int require_muscle(const JsonValue& name, const anatomy::Specimen& specimen) {
  return require_part(name, specimen.muscles, "muscle");
}

int require_bone(const JsonValue& name, const anatomy::Specimen& specimen) {
  return require_part(name, specimen.bones, "bone");
}

int require_joint(const JsonValue& name, const anatomy::Specimen& specimen) {
  return require_part(name, specimen.joints, "joint");
}

bool moves_hand(const Action& action) {
  return std::holds_alternative<MoveHand>(action) || std::holds_alternative<TouchMuscle>(action) ||
         std::holds_alternative<SlideOnMuscle>(action) || std::holds_alternative<GrabLine>(action) ||
         std::holds_alternative<GrabBone>(action) || std::holds_alternative<ReleaseHand>(action);
}

std::vector<ScriptAction> read_script(const JsonValue& list, const anatomy::Specimen& specimen,
                                      const std::vector<std::string>& hands) {
  std::vector<ScriptAction> script;
  for (const JsonValue& element : list.elements()) {
    script.push_back(read_action(element, specimen, hands));
    if (script.size() > 1 && script.back().start_s < script[script.size() - 2].start_s) {
      throw element.error("starts before the action above it; order the script by t_s");
    }
    require_free_hand(element, script, hands.size());
  }
  return script;
}

}  // namespace myotact::scene

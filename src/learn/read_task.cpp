#include "learn/read_task.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.h"

namespace myotact::learn {

namespace {

constexpr double kLongestHold_s = 60.0;

template <class Item>
void add_keys(const std::vector<Item>& items, std::vector<std::string>& keys) {
  for (const Item& item : items) keys.push_back(item.key);
}

/// Place of the name in `keys`.
int require_key(const JsonValue& name, const std::vector<std::string>& keys, const char* kind) {
  const std::string key = name.string();
  const auto found = std::find(keys.begin(), keys.end(), key);
  if (found == keys.end()) {
    throw name.error(fmt::format("the specimen has no {} \"{}\"; the nearest is \"{}\"", kind, key.substr(0, 60),
                                 nearest_word(key, keys)));
  }
  return static_cast<int>(found - keys.begin());
}

std::vector<std::string> joint_keys(const anatomy::Specimen& specimen) {
  std::vector<std::string> keys;
  for (const anatomy::Joint& joint : specimen.joints) {
    if (!joint.axes.empty()) keys.push_back(joint.key);
  }
  return keys;
}

/// One that rotates.
int require_joint(const JsonValue& name, const anatomy::Specimen& specimen) {
  const std::vector<std::string> keys = joint_keys(specimen);
  const std::string& key = keys[static_cast<std::size_t>(require_key(name, keys, "joint that rotates"))];
  return anatomy::find_joint(specimen, key);
}

std::vector<Part> read_options(const JsonValue& list, const Part& right, const anatomy::Specimen& specimen) {
  constexpr std::size_t kFewest = 2, kMost = 12;
  std::vector<Part> options;
  for (const JsonValue& element : list.elements()) {
    const Part option = require_part(element, specimen);
    if (std::find(options.begin(), options.end(), option) != options.end()) {
      throw element.error("is an option already; name each once");
    }
    options.push_back(option);
  }
  if (options.size() < kFewest || options.size() > kMost) {
    throw list.error(fmt::format("has {} options; must have {} to {}", options.size(), kFewest, kMost));
  }
  if (std::find(options.begin(), options.end(), right) == options.end()) {
    throw list.error(fmt::format("lacks the right answer; add \"{}\"", key_of(specimen, right)));
  }
  return options;
}

Task read_name(JsonObject& task, const anatomy::Specimen& specimen) {
  NameTask name;
  name.part = require_part(task.at("part"), specimen);
  if (const auto options = task.find("options")) name.options = read_options(*options, name.part, specimen);
  if (const auto accept = task.find("accept")) name.accept = accept->strings();
  return name;
}

Task read_press(JsonObject& task, const anatomy::Specimen& specimen) {
  // A student's device supports a few newtons; below a twentieth of one its friction hides the difference.
  constexpr double kLeast_N = 0.05, kMost_N = 20.0;
  PressTask press;
  press.muscle = require_muscle(task.at("muscle"), specimen);
  const auto band = task.at("band_N").elements(2);
  press.low_N = band[0].number_between(kLeast_N, kMost_N);
  press.high_N = band[1].number_between(kLeast_N, kMost_N);
  if (!(press.low_N < press.high_N)) {
    throw task.at("band_N").error("must be [lowest, highest], the first below the second");
  }
  if (const auto hold = task.find("hold_s")) press.hold_s = hold->number_between(0.1, kLongestHold_s);
  return press;
}

Task read_predict(JsonObject& task, const anatomy::Specimen& specimen) {
  // A fifth of a degree: a pull of 3 mm rotates a relaxed elbow by more, noise by a tenth of it.
  constexpr double kTurn_rad = 0.0035, kLeast_rad = 1e-4, kMost_rad = 0.5;
  PredictTask predict;
  predict.muscle = require_muscle(task.at("muscle"), specimen);
  predict.joint = require_joint(task.at("joint"), specimen);
  const bool flexes = task.at("motion").one_of({"flexion", "extension"}) == "flexion";
  predict.motion = flexes ? Motion::Flexion : Motion::Extension;
  const auto turn = task.find("turn_rad");
  predict.turn_rad = turn ? turn->number_between(kLeast_rad, kMost_rad) : kTurn_rad;
  return predict;
}

Task read_stiffen(JsonObject& task, const anatomy::Specimen& specimen) {
  constexpr double kWithin_rad = 0.0349;  // 2 degrees, which is not visible on a drawn limb
  StiffenTask stiffen;
  const JsonValue joint = task.at("joint");
  stiffen.joint = require_joint(joint, specimen);
  const auto& groups = specimen.groups;
  const auto opposed = [&](const anatomy::MuscleGroup& group) {
    return group.joint == stiffen.joint && !group.flexors.empty() && !group.extensors.empty();
  };
  if (std::none_of(groups.begin(), groups.end(), opposed)) {
    throw joint.error("has no opposing muscles in this specimen; name a joint with flexors and extensors");
  }
  stiffen.factor = task.at("factor").number_between(1.1, 100.0);
  const auto within = task.find("within_rad");
  stiffen.within_rad = within ? within->number_between(1e-3, 0.5) : kWithin_rad;
  if (const auto hold = task.find("hold_s")) stiffen.hold_s = hold->number_between(0.1, kLongestHold_s);
  return stiffen;
}

Task read_identify(JsonObject& task, const anatomy::Specimen& specimen) {
  IdentifyTask identify;
  identify.part = require_part(task.at("part"), specimen);
  identify.options = read_options(task.at("options"), identify.part, specimen);
  return identify;
}

Task read_kind(const std::string& kind, JsonObject& task, const anatomy::Specimen& specimen) {
  if (kind == "find") return FindTask{require_part(task.at("part"), specimen)};
  if (kind == "touch") return TouchTask{require_part(task.at("part"), specimen)};
  if (kind == "name") return read_name(task, specimen);
  if (kind == "press") return read_press(task, specimen);
  if (kind == "predict") return read_predict(task, specimen);
  if (kind == "stiffen") return read_stiffen(task, specimen);
  if (kind == "identify") return read_identify(task, specimen);
  return ReadTask{};
}

}  // namespace

int require_muscle(const JsonValue& name, const anatomy::Specimen& specimen) {
  std::vector<std::string> keys;
  add_keys(specimen.muscles, keys);
  return require_key(name, keys, "muscle");
}

int require_bone(const JsonValue& name, const anatomy::Specimen& specimen) {
  std::vector<std::string> keys;
  add_keys(specimen.bones, keys);
  return require_key(name, keys, "bone");
}

Part require_part(const JsonValue& name, const anatomy::Specimen& specimen) {
  std::vector<std::string> keys;
  add_keys(specimen.muscles, keys);
  add_keys(specimen.bones, keys);
  const int place = require_key(name, keys, "muscle or bone");
  const int muscles = static_cast<int>(specimen.muscles.size());
  return place < muscles ? Part{place, -1} : Part{-1, place - muscles};
}

Task read_task(const JsonValue& value, const anatomy::Specimen& specimen) {
  JsonObject object(value);
  const std::string kind =
      object.at("kind").one_of({"read", "find", "touch", "name", "press", "predict", "stiffen", "identify"});
  Task task = read_kind(kind, object, specimen);
  object.finish();
  return task;
}

}  // namespace myotact::learn

#include "view/session/saved_view.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "view/look/part_actions.h"

namespace myotact::view {

namespace {

// Words of the files, in the order of the enumerations.
const std::vector<std::string> kColours = {"kind",         "activation",      "tension", "stretch",
                                           "volume_error", "stiffness_share", "pressure"};
const std::vector<std::string> kNames = {"english", "latin", "both"};
const std::vector<std::string> kAxes = {"x", "y", "z"};

// Wider than what any limb needs, narrow enough that a camera can be reckoned with.
constexpr double kFarthest_m = 1e3, kNearest_m = 1e-3;
constexpr double kMostTurn_rad = 10.0;

int place_of(const std::vector<std::string>& words, const std::string& word) {
  return static_cast<int>(std::find(words.begin(), words.end(), word) - words.begin());
}

template <typename Word>
std::string word_of(const std::vector<std::string>& words, Word value) {
  return words.at(static_cast<std::size_t>(value));
}

/// No part where the specimen has none of that key.
Part part_of(const anatomy::Specimen& specimen, const std::string& key) {
  const auto is_it = [&](const auto& part) { return part.key == key; };
  const auto muscle = std::find_if(specimen.muscles.begin(), specimen.muscles.end(), is_it);
  if (muscle != specimen.muscles.end()) return {PartKind::Muscle, static_cast<int>(muscle - specimen.muscles.begin())};
  const auto bone = std::find_if(specimen.bones.begin(), specimen.bones.end(), is_it);
  return bone == specimen.bones.end() ? Part{} : Part{PartKind::Bone, static_cast<int>(bone - specimen.bones.begin())};
}

template <typename Parts>
std::vector<std::string> keys_where(const Parts& parts, const std::vector<PartLook>& looks, bool PartLook::*what) {
  std::vector<std::string> keys;
  for (std::size_t i = 0; i < std::min(parts.size(), looks.size()); ++i) {
    if (looks[i].*what) keys.push_back(parts[i].key);
  }
  return keys;
}

std::vector<std::string> keys_where(const anatomy::Specimen& specimen, const ViewState& view, bool PartLook::*what) {
  std::vector<std::string> keys = keys_where(specimen.muscles, view.muscles, what);
  for (const std::string& bone : keys_where(specimen.bones, view.bones, what)) keys.push_back(bone);
  return keys;
}

float share_of(JsonObject& object, const char* key, float otherwise) {
  const auto share = object.find(key);
  return share ? static_cast<float>(share->number_between(0.0, 1.0)) : otherwise;
}

std::vector<std::string> strings_of(JsonObject& object, const char* key) {
  const auto strings = object.find(key);
  return strings ? strings->strings() : std::vector<std::string>{};
}

Camera parse_camera(const JsonValue& json) {
  JsonObject object(json);
  Camera camera;
  const auto target = object.at("target_m").elements(3);
  for (std::size_t i = 0; i < 3; ++i) {
    camera.target_world_m[static_cast<int>(i)] =
        static_cast<float>(target[i].number_between(-kFarthest_m, kFarthest_m));
  }
  constexpr double kSteepest = static_cast<double>(Camera::kSteepest_rad);
  const auto between = [&](const char* key, double lowest, double highest) {
    return static_cast<float>(object.at(key).number_between(lowest, highest));
  };
  camera.azimuth_rad = between("azimuth_rad", -kMostTurn_rad, kMostTurn_rad);
  camera.elevation_rad = between("elevation_rad", -kSteepest, kSteepest);
  camera.distance_m = between("distance_m", kNearest_m, kFarthest_m);
  object.finish();
  return camera;
}

SectionPlane parse_section(const JsonValue& json) {
  JsonObject object(json);
  SectionPlane section;
  section.on = object.boolean_or("on", section.on);
  section.flipped = object.boolean_or("flipped", section.flipped);
  if (const auto axis = object.find("axis")) section.axis = place_of(kAxes, axis->one_of(kAxes));
  section.share = share_of(object, "share", section.share);
  object.finish();
  return section;
}

LayerLook parse_layers(const JsonValue& json) {
  JsonObject object(json);
  LayerLook layers;
  layers.superficial = share_of(object, "superficial", layers.superficial);
  layers.deep = share_of(object, "deep", layers.deep);
  layers.bones = share_of(object, "bones", layers.bones);
  object.finish();
  return layers;
}

}  // namespace

SavedView saved_view(const ViewState& view, const anatomy::Specimen& specimen) {
  // All members by name: a new one does not compile until it is saved, or left out on purpose, as what a lesson hides.
  const auto& [camera, bones, muscles, layers, colour, names, section, labels, names_hidden, lines, fibres, attachments,
               plotted_muscles, selected_muscle, selected_bone] = view;
  SavedView saved;
  saved.look = {camera, {}, {}, layers, colour, names, section, labels, false, lines, fibres, attachments, {}, -1, -1};
  saved.hidden = keys_where(specimen, view, &PartLook::hidden);
  saved.faded = keys_where(specimen, view, &PartLook::faded);
  for (const int muscle : plotted_muscles) saved.plotted.push_back(key_of(specimen, {PartKind::Muscle, muscle}));
  if (const Part part = selected_part(view)) saved.selected = key_of(specimen, part);
  return saved;
}

std::vector<std::string> show(const SavedView& saved, const anatomy::Specimen& specimen, ViewState& view) {
  std::vector<std::string> missing;
  const auto for_part = [&](const std::string& key, const auto& use) {
    if (const Part part = part_of(specimen, key)) return use(part);
    if (std::find(missing.begin(), missing.end(), key) == missing.end()) missing.push_back(key);
  };
  const bool names_hidden = view.names_hidden;
  view = saved.look;
  view.names_hidden = names_hidden;
  view.labels = view.labels && !names_hidden;
  view.bones.assign(specimen.bones.size(), {});
  view.muscles.assign(specimen.muscles.size(), {});
  for (const auto& key : saved.hidden) for_part(key, [&](const Part& part) { look_of(view, part).hidden = true; });
  for (const auto& key : saved.faded) for_part(key, [&](const Part& part) { look_of(view, part).faded = true; });
  for (const auto& key : saved.plotted) {
    for_part(key, [&](const Part& part) {
      if (part.kind == PartKind::Muscle && !is_plotted(view, part.index)) toggle_plot(view, part.index);
    });
  }
  if (!saved.selected.empty()) for_part(saved.selected, [&](const Part& part) { select(view, part); });
  return missing;
}

nlohmann::json json_of(const SavedView& saved) {
  const ViewState& look = saved.look;
  const glm::vec3& target = look.camera.target_world_m;
  return {
      {"camera",
       {{"target_m", {target.x, target.y, target.z}},
        {"azimuth_rad", look.camera.azimuth_rad},
        {"elevation_rad", look.camera.elevation_rad},
        {"distance_m", look.camera.distance_m}}},
      {"hidden", saved.hidden},
      {"faded", saved.faded},
      {"plotted", saved.plotted},
      {"selected", saved.selected},
      {"layers", {{"superficial", look.layers.superficial}, {"deep", look.layers.deep}, {"bones", look.layers.bones}}},
      {"section",
       {{"on", look.section.on},
        {"flipped", look.section.flipped},
        {"axis", word_of(kAxes, look.section.axis)},
        {"share", look.section.share}}},
      {"colour", word_of(kColours, look.colour)},
      {"names", word_of(kNames, look.names)},
      {"labels", look.labels},
      {"lines", look.lines},
      {"fibres", look.fibres},
      {"attachments", look.attachments}};
}

SavedView parse_view(const JsonValue& json) {
  JsonObject object(json);
  SavedView saved;
  ViewState& look = saved.look;
  look.camera = parse_camera(object.at("camera"));
  saved.hidden = strings_of(object, "hidden");
  saved.faded = strings_of(object, "faded");
  saved.plotted = strings_of(object, "plotted");
  saved.selected = object.string_or("selected", "");
  if (const auto layers = object.find("layers")) look.layers = parse_layers(*layers);
  if (const auto section = object.find("section")) look.section = parse_section(*section);
  const auto word = [&](const char* key, const std::vector<std::string>& words, int otherwise) {
    const auto value = object.find(key);
    return value ? place_of(words, value->one_of(words)) : otherwise;
  };
  look.colour = static_cast<MuscleColour>(word("colour", kColours, static_cast<int>(look.colour)));
  look.names = static_cast<NameStyle>(word("names", kNames, static_cast<int>(look.names)));
  look.labels = object.boolean_or("labels", look.labels);
  look.lines = object.boolean_or("lines", look.lines);
  look.fibres = object.boolean_or("fibres", look.fibres);
  look.attachments = object.boolean_or("attachments", look.attachments);
  object.finish();
  return saved;
}

}  // namespace myotact::view

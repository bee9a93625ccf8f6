#include "scene/scene_file.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "anatomy/find_line_defects.h"
#include "anatomy/hinge_chains.h"
#include "anatomy/read_line.h"
#include "core/data_folder.h"
#include "core/error.h"
#include "core/file.h"
#include "core/json_reader.h"
#include "core/text.h"
#include "device/profile_file.h"
#include "scene/fascia_file.h"
#include "scene/muscle_settings.h"
#include "scene/tether_file.h"
#include "scene/texture_file.h"
#include "scene/tool_choice.h"
#include "simulation/line/line_model.h"
#include "simulation/skeleton/skeleton.h"

namespace myotact::scene {

namespace {

// Radii of tools: a blunt needle's and a ballpoint's, a thumb's.
constexpr double kFinestPoint_m = 0.3e-3, kThickestPoint_m = 1e-3, kThickestBall_m = 1e-2;

/// Of a joint's spring, and of its damper: a thousand times a dog's.
constexpr double kStiffestJoint_Nm_rad = 1e4;

std::filesystem::path scenes_folder() {
  return data_folder() / "assets" / "scenes";
}

/// Returns the scene as text, for recordings.
std::string apply_overrides(nlohmann::json& scene, const Overrides& overrides) {
  override_values(scene, overrides);
  try {
    return scene.dump();
  } catch (const nlohmann::json::exception&) {  // the file itself was checked when it was parsed
    throw Error(ExitStatus::Usage, "--set: a key or a value is no UTF-8 text; rename what it names");
  }
}

/// False also for a path that cannot even be examined, such as one that is too long.
bool is_there(const std::filesystem::path& path) {
  std::error_code failure;
  return std::filesystem::exists(path, failure);
}

/// A specimen is named by its folder in meshes/, by a path, or by a path beside the scene file.
std::filesystem::path find_specimen(const JsonValue& name, const std::filesystem::path& scene_file) {
  const std::filesystem::path given = name.string();
  for (const auto& candidate : {data_folder() / "meshes" / given, scene_file.parent_path() / given, given}) {
    if (!given.empty() && is_there(candidate / "specimen.json")) return candidate;
  }
  throw Error(
      ExitStatus::NoInput,
      fmt::format("{}: /specimen: \"{}\" is no specimen folder (specimen.json is missing); name one of meshes/ or "
                  "make one with myotact-prepare",
                  scene_file.string(), given.string()));
}

void read_joints(const JsonValue& value, Scene& scene) {
  JsonObject joints(value);
  for (const auto& [key, entry] : joints.entries()) {
    const int joint = require_joint(JsonValue(nlohmann::json(key), value.file(), entry.pointer()), scene.specimen);
    auto& setting = scene.joints[static_cast<std::size_t>(joint)];
    auto& own = scene.specimen.joints[static_cast<std::size_t>(joint)];
    JsonObject fields(entry);
    if (const auto stiffness = fields.find("stiffness_Nm_rad")) {
      own.stiffness_Nm_rad = stiffness->number_between(0.0, kStiffestJoint_Nm_rad);
    }
    if (const auto damping = fields.find("damping_Nms_rad")) {
      own.damping_Nms_rad = damping->number_between(0.0, kStiffestJoint_Nm_rad);
    }
    if (const auto angle = fields.find("q_rad")) {
      const auto& range = own.range_rad;
      if (range.empty()) throw angle->error("this joint does not move; remove the key");
      setting.angle_rad = angle->number_between(range[0].first, range[0].second);
    }
    setting.locked = fields.boolean_or("locked", setting.locked);
    fields.finish();
  }
}

simulation::TissueModel tissue_model(const JsonValue& value) {
  const std::string name = value.one_of({"fem", "mass_spring", "line", "rigid"});
  if (name == "fem") return simulation::TissueModel::Fem;
  if (name == "mass_spring") return simulation::TissueModel::MassSpring;
  if (name == "line") return simulation::TissueModel::Line;
  return simulation::TissueModel::Rigid;
}

void read_tissue(const JsonValue& value, Scene& scene) {
  JsonObject tissue(value);
  if (const auto model = tissue.find("default")) {
    scene.settings.tissue.assign(scene.specimen.muscles.size(), tissue_model(*model));
  }
  if (const auto tendon = tissue.find("tendon")) {
    scene.settings.tendon =
        tendon->one_of({"elastic", "rigid"}) == "rigid" ? simulation::Tendon::Rigid : simulation::Tendon::Elastic;
  }
  if (const auto muscles = tissue.find("muscles")) {
    for (const auto& [key, entry] : JsonObject(*muscles).entries()) {
      const int muscle = require_muscle(JsonValue(nlohmann::json(key), value.file(), entry.pointer()), scene.specimen);
      scene.settings.tissue[static_cast<std::size_t>(muscle)] = tissue_model(entry);
    }
  }
  tissue.finish();
}

/// Lines by hand, each in place of the specimen's own line of its muscle.
void read_lines(const JsonValue& value, Scene& scene) {
  // Unlike the middle of a scanned muscle, a point that a person places has no reason to lie in a bone: what is left is
  // the roughness of the bones' surfaces.
  constexpr anatomy::LineRules kByHand{.deepest_via_m = 1e-3, .crosses_joint = true};
  std::vector<int> given;
  for (const JsonValue& entry : value.elements()) {
    anatomy::MuscleLine line = anatomy::read_line(entry, scene.specimen);
    if (std::find(given.begin(), given.end(), line.muscle) != given.end()) {
      throw entry.error("this muscle has a line already; leave one out");
    }
    given.push_back(line.muscle);
    const auto defects = anatomy::find_line_defects(line, scene.specimen, kByHand);
    if (!defects.empty()) throw entry.error(defects.front());
    *std::find_if(scene.specimen.lines.begin(), scene.specimen.lines.end(),
                  [&](const anatomy::MuscleLine& own) { return own.muscle == line.muscle; }) = std::move(line);
  }
}

void read_activations(const JsonValue& value, Scene& scene) {
  for (const auto& [key, entry] : JsonObject(value).entries()) {
    const int muscle = require_muscle(JsonValue(nlohmann::json(key), value.file(), entry.pointer()), scene.specimen);
    scene.activations[static_cast<std::size_t>(muscle)] = entry.number_between(0.0, 1.0);
  }
}

std::vector<int> read_side(JsonObject& fields, const char* key, const std::vector<int>& whole_group,
                           const anatomy::Specimen& specimen) {
  const auto list = fields.find(key);
  if (!list) return whole_group;
  std::vector<int> muscles;
  for (const JsonValue& name : list->elements()) muscles.push_back(require_muscle(name, specimen));
  if (muscles.empty()) throw list->error("is empty; name at least one muscle or leave the key out");
  return muscles;
}

/// Names the first muscle that cannot do its part: one that does not cross the joint, or pulls on both sides.
void check_sides(const CoContraction& set, const JsonValue& value, const anatomy::Specimen& specimen) {
  const simulation::Skeleton skeleton(specimen);
  const std::string& joint = specimen.joints[static_cast<std::size_t>(set.joint)].key;
  for (const std::vector<int>* side : {&set.flexors, &set.extensors}) {
    for (const int muscle : *side) {
      const std::string& key = specimen.muscles[static_cast<std::size_t>(muscle)].key;
      const auto line = std::find_if(specimen.lines.begin(), specimen.lines.end(),
                                     [&](const anatomy::MuscleLine& candidate) { return candidate.muscle == muscle; });
      if (line == specimen.lines.end() || !simulation::spans_joint(*line, skeleton, set.joint)) {
        throw value.error(fmt::format("\"{}\" does not cross the joint \"{}\"; leave it out", key, joint));
      }
      const bool on_both =
          side == &set.flexors && std::find(set.extensors.begin(), set.extensors.end(), muscle) != set.extensors.end();
      if (on_both) throw value.error(fmt::format("\"{}\" is on both sides; leave it out of one", key));
    }
  }
}

std::vector<CoContractionPreset> read_presets(const JsonValue& value) {
  std::vector<CoContractionPreset> presets;
  for (const JsonValue& item : value.elements()) {
    JsonObject fields(item);
    presets.push_back({fields.at("name").string(), fields.at("common").number_between(0.0, 1.0),
                       fields.at("difference").number_between(-1.0, 1.0)});
    fields.finish();
  }
  return presets;
}

CoContraction read_co_contraction(const JsonValue& value, const Scene& scene) {
  JsonObject fields(value);
  CoContraction set;
  const JsonValue joint = fields.at("joint");
  set.joint = require_joint(joint, scene.specimen);
  const auto group = std::find_if(scene.specimen.groups.begin(), scene.specimen.groups.end(),
                                  [&](const anatomy::MuscleGroup& candidate) { return candidate.joint == set.joint; });
  if (group == scene.specimen.groups.end()) throw joint.error("the specimen has no muscle group for this joint");
  if (scene.specimen.joints[static_cast<std::size_t>(set.joint)].axes.empty()) {
    throw joint.error("this joint does not rotate; name one that does");
  }
  set.flexors = read_side(fields, "flexors", group->flexors, scene.specimen);
  set.extensors = read_side(fields, "extensors", group->extensors, scene.specimen);
  if (const auto common = fields.find("common")) set.common = common->number_between(0.0, 1.0);
  if (const auto difference = fields.find("difference")) set.difference = difference->number_between(-1.0, 1.0);
  set.hold_posture = fields.boolean_or("hold_posture", false);
  if (const auto presets = fields.find("presets")) set.presets = read_presets(*presets);
  fields.finish();
  check_sides(set, value, scene.specimen);
  return set;
}

void read_friction(const JsonValue& value, ToolSettings& tool) {
  JsonObject friction(value);
  tool.static_friction = friction.at("static").number_between(0.0, 2.0);
  tool.dynamic_friction = friction.at("dynamic").number_between(0.0, tool.static_friction);
  if (const auto speed = friction.find("stribeck_m_s")) tool.stribeck_m_s = speed->number_between(1e-3, 0.2);
  if (const auto ratio = friction.find("along_over_across")) tool.along_over_across = ratio->number_between(0.2, 5.0);
  if (const auto viscous = friction.find("viscous_Ns_m")) tool.viscous_Ns_m = viscous->number_between(0.0, 20.0);
  friction.finish();
}

haptics::ForceMethod force_method(const JsonValue& value) {
  const std::string name = value.one_of({"proxy", "penetration", "plane", "pulling"});
  if (name == "penetration") return haptics::ForceMethod::Penetration;
  if (name == "plane") return haptics::ForceMethod::Plane;
  if (name == "pulling") return haptics::ForceMethod::Pulling;
  return haptics::ForceMethod::Proxy;
}

void read_shape(JsonObject& fields, ToolSettings& tool) {
  if (const auto shape = fields.find("shape")) {
    const std::string name = shape->one_of({"ball", "point", "clamp"});
    if (name == "point") tool.shape = messages::ToolShape::Point;
    if (name == "clamp") tool.shape = messages::ToolShape::Clamp;
  }
  const bool is_point = tool.shape == messages::ToolShape::Point;
  if (is_point) tool.radius_m = kPointRadius_m;
  if (const auto radius = fields.find("radius_m")) {
    tool.radius_m = is_point ? radius->number_between(kFinestPoint_m, kThickestPoint_m)
                             : radius->number_between(kThickestPoint_m, kThickestBall_m);
  }
}

std::string device_name(const JsonValue& value) {
  try {
    device::simulated_profile(value.string());
  } catch (const Error& error) {
    throw value.error(error.what());
  }
  return value.string();
}

ToolSettings read_tool(const JsonValue& value) {
  JsonObject fields(value);
  ToolSettings tool;
  tool.device = device_name(fields.at("device"));
  if (const auto hand = fields.find("hand")) tool.hand = hand->one_of({"left", "right"});
  if (const auto method = fields.find("method")) tool.method = force_method(*method);
  read_shape(fields, tool);
  if (const auto scale = fields.find("force_scale")) tool.force_scale = scale->number_between(0.0, 1.0);
  if (const auto limit = fields.find("force_limit")) tool.force_limit = limit->number_between(0.0, 1.0);
  if (const auto friction = fields.find("friction")) read_friction(*friction, tool);
  if (const auto stiffness = fields.find("stiffness_N_m")) tool.stiffness_N_m = stiffness->number_between(10.0, 5000.0);
  if (const auto snap = fields.find("line_snap_N")) tool.line_snap_N = snap->number_between(0.0, 1.0);
  if (const auto texture = fields.find("texture")) tool.texture = textures_asked_for(*texture);
  fields.finish();
  return tool;
}

void read_tools(const JsonValue& value, Scene& scene) {
  for (const JsonValue& tool : value.elements()) {
    scene.tools.push_back(read_tool(tool));
    if (scene.tools.size() > kMostTools) throw tool.error("is one more than a person has hands; name two at most");
  }
  if (scene.tools.size() == kMostTools && scene.tools[0].hand == scene.tools[1].hand) {
    throw value.error("both tools are for the " + scene.tools[0].hand + " hand; give one \"hand\": \"" +
                      (scene.tools[0].hand == "left" ? "right" : "left") + "\"");
  }
}

simulation::Contact read_contact(const JsonValue& value) {
  if (value.raw() == "bones") return simulation::Contact::Bones;
  if (!value.raw().is_boolean()) throw value.error("is " + value.raw().dump() + "; must be true, false or \"bones\"");
  return value.boolean() ? simulation::Contact::All : simulation::Contact::None;
}

void read_parts(JsonObject& root, Scene& scene) {
  if (const auto dt = root.find("dt_s")) scene.settings.dt_s = dt->number_between(1e-3, 0.05);
  if (const auto gravity = root.find("gravity_m_s2")) scene.settings.gravity_m_s2 = gravity->vec3();
  if (const auto lines = root.find("lines")) read_lines(*lines, scene);
  if (const auto joints = root.find("joints")) read_joints(*joints, scene);
  if (const auto contact = root.find("contact")) scene.settings.contact = read_contact(*contact);
  if (const auto fascia = root.find("fascia"); fascia && fascia->boolean())
    scene.settings.fascia = read_fascia(fascia_path());
  if (const auto tissue = root.find("tissue")) read_tissue(*tissue, scene);
  if (const auto muscles = root.find("muscles")) read_muscle_settings(*muscles, scene.specimen);
  if (const auto rest_stretch = root.find("rest_stretch")) read_rest_stretches(*rest_stretch, scene.specimen);
  if (const auto activations = root.find("activations")) read_activations(*activations, scene);
  if (const auto set = root.find("co_contraction")) scene.co_contraction = read_co_contraction(*set, scene);
  if (const auto tools = root.find("tools")) read_tools(*tools, scene);
  if (scene.tools.empty()) scene.tools.emplace_back();
  if (const auto original = root.find("original")) scene.settings.tether = read_tether(*original);
  if (const auto script = root.find("script")) scene.script = read_script(*script, scene.specimen, hands_of(scene));
}

}  // namespace

Scene parse_scene(const std::string& text, const std::filesystem::path& file, const Overrides& overrides) {
  nlohmann::json json = parse_json(text, file.string());
  if (!json.is_object()) throw bad_data(file.string(), "/", "must be an object in braces");
  const std::string source_text = apply_overrides(json, overrides);
  JsonObject root(JsonValue(json, file.string()));
  root.at("schema").integer_between(1, 1);
  Scene scene;
  scene.source_text = source_text;
  scene.name = root.at("name").string();
  scene.title = root.string_or("title", scene.name);
  scene.note = root.string_or("note", "");
  scene.specimen_folder = find_specimen(root.at("specimen"), file);
  scene.specimen = anatomy::with_hinge_chains(anatomy::load_specimen(scene.specimen_folder));
  scene.joints.resize(scene.specimen.joints.size());
  scene.activations.assign(scene.specimen.muscles.size(), 0.0);
  scene.settings.tissue.assign(scene.specimen.muscles.size(), simulation::TissueModel::Fem);
  read_parts(root, scene);
  root.finish();
  return scene;
}

std::vector<std::string> hands_of(const Scene& scene) {
  std::vector<std::string> hands;
  for (const ToolSettings& tool : scene.tools) hands.push_back(tool.hand);
  return hands;
}

void set_seed(Scene& scene, std::uint64_t seed) {
  for (ToolSettings& tool : scene.tools) tool.texture.seed = seed++;
}

std::vector<std::string> built_in_scenes() {
  std::vector<std::string> names;
  std::error_code missing;
  for (const auto& entry : std::filesystem::directory_iterator(scenes_folder(), missing)) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

Scene load_scene(const std::string& name_or_path, const Overrides& overrides) {
  const auto built_in = scenes_folder() / (name_or_path + ".json");
  const bool is_name = name_or_path.find('/') == std::string::npos && is_there(built_in);
  const std::filesystem::path file = is_name ? built_in : std::filesystem::path(name_or_path);
  if (!is_there(file)) {
    const auto names = built_in_scenes();
    throw Error(ExitStatus::NoInput, fmt::format("{}: no such scene file; built-in scenes: {} (nearest: \"{}\")",
                                                 name_or_path, join(names), nearest_word(name_or_path, names)));
  }
  return parse_scene(read_file(file), file, overrides);
}

}  // namespace myotact::scene

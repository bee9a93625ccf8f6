#include "prepare/recipe/anatomy_assets.h"

#include <fmt/format.h>

#include "core/json_reader.h"
#include "core/text.h"

namespace myotact::prepare {

namespace {

template <class Part>
int index_of(const JsonValue& name, const std::vector<Part>& parts, const char* kind) {
  std::vector<std::string> keys;
  for (const Part& part : parts) keys.push_back(part.key);
  const std::string key = name.string();
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i] == key) return static_cast<int>(i);
  }
  throw name.error(
      fmt::format("names the {} \"{}\" that is not there; the nearest is \"{}\"", kind, key, nearest_word(key, keys)));
}

anatomy::Body read_body(const JsonValue& value) {
  JsonObject fields(value);
  anatomy::Body body;
  body.key = fields.at("key").string();
  body.mass_kg = fields.at("mass_kg").number_between(1e-6, 1e3);
  body.com_m = fields.at("com_m").vec3();
  const auto inertia = fields.at("inertia_kg_m2").elements(6);
  for (std::size_t i = 0; i < 6; ++i) body.inertia_kg_m2[i] = inertia[i].number();
  body.estimated = fields.boolean_or("estimated", true);
  fields.finish();
  return body;
}

BoneData read_bone(const JsonValue& value, const AnatomyData& data) {
  JsonObject fields(value);
  BoneData bone{fields.at("key").string(), fields.at("name_la").string(), fields.at("name_en").string(),
                index_of(fields.at("body"), data.bodies, "body")};
  fields.finish();
  return bone;
}

anatomy::Joint read_joint(const JsonValue& value, const AnatomyData& data) {
  JsonObject fields(value);
  anatomy::Joint joint;
  joint.key = fields.at("key").string();
  joint.type =
      fields.at("type").one_of({"hinge", "weld"}) == "hinge" ? anatomy::JointType::Hinge : anatomy::JointType::Weld;
  joint.parent = index_of(fields.at("parent"), data.bodies, "body");
  joint.child = index_of(fields.at("child"), data.bodies, "body");
  joint.centre_m = fields.at("centre_m").vec3();
  for (const JsonValue& axis : fields.at("axes").elements()) joint.axes.push_back(axis.vec3().normalized());
  for (const JsonValue& range : fields.at("range_rad").elements()) {
    const auto ends = range.elements(2);
    joint.range_rad.emplace_back(ends[0].number(), ends[1].number());
  }
  joint.stiffness_Nm_rad = fields.number_or("stiffness_Nm_rad", 0.0);
  joint.damping_Nms_rad = fields.number_or("damping_Nms_rad", 0.0);
  joint.centre_uncertainty_m = fields.number_or("centre_uncertainty_m", 0.0);
  joint.axis_uncertainty_rad = fields.number_or("axis_uncertainty_rad", 0.0);
  fields.finish();
  return joint;
}

AttachmentSite read_site(const JsonValue& value, const AnatomyData& data) {
  JsonObject fields(value);
  AttachmentSite site;
  for (const JsonValue& bone : fields.at("bones").elements()) {
    index_of(bone, data.bones, "bone");
    site.bones.push_back(bone.string());
  }
  if (site.bones.empty()) throw value.error("names no bone; a muscle end must be fixed to one");
  site.point_m = fields.at("point_m").vec3();
  site.area_m2 = fields.at("area_m2").number_between(0.0, 1.0);
  fields.finish();
  return site;
}

MuscleData read_muscle(const JsonValue& value, const AnatomyData& data) {
  JsonObject fields(value);
  MuscleData muscle;
  anatomy::Muscle& m = muscle.mechanics;
  m.key = fields.at("key").string();
  m.name_la = fields.at("name_la").string();
  m.name_en = fields.at("name_en").string();
  m.material = "muscle";
  m.peak_force_N = fields.at("peak_force_N").number_between(1e-3, 1e5);
  m.optimal_fibre_m = fields.at("optimal_fibre_m").number_between(1e-4, 1.0);
  m.pennation_rad = fields.at("pennation_rad").number_between(0.0, 1.4);
  m.rest_stretch = fields.at("rest_stretch").number_between(0.3, 1.8);
  m.tendon_slack_m = fields.at("tendon_slack_m").number_between(0.0, 1.0);
  m.activation_tau_s = fields.at("activation_tau_s").number_between(1e-3, 1.0);
  m.deactivation_tau_s = fields.at("deactivation_tau_s").number_between(1e-3, 1.0);
  m.estimated = fields.at("estimated").strings();
  m.sources = fields.at("sources").strings();
  muscle.origin = read_site(fields.at("origin"), data);
  muscle.insertion = read_site(fields.at("insertion"), data);
  fields.finish();
  return muscle;
}

GroupData read_group(const JsonValue& value, const AnatomyData& data) {
  JsonObject fields(value);
  GroupData group{index_of(fields.at("joint"), data.joints, "joint"), fields.at("flexors").strings(),
                  fields.at("extensors").strings()};
  fields.finish();
  return group;
}

}  // namespace

AnatomyData read_anatomy(const std::filesystem::path& folder) {
  const auto file = folder / "forelimb_anatomy.json";
  const nlohmann::json json = read_json(file);
  JsonObject root(JsonValue(json, file.string()));
  root.at("schema").integer_between(1, 1);
  root.string_or("what", "");
  AnatomyData data;
  data.name = root.at("name").string();
  data.species = root.at("species").string();
  data.breed = root.at("breed").string();
  data.side = root.at("side").one_of({"left", "right"});
  data.source = root.at("source").string();
  data.licence = root.at("licence").string();
  for (const JsonValue& v : root.at("bodies").elements()) data.bodies.push_back(read_body(v));
  for (const JsonValue& v : root.at("bones").elements()) data.bones.push_back(read_bone(v, data));
  for (const JsonValue& v : root.at("joints").elements()) data.joints.push_back(read_joint(v, data));
  for (const JsonValue& v : root.at("muscles").elements()) data.muscles.push_back(read_muscle(v, data));
  for (const JsonValue& v : root.at("groups").elements()) data.groups.push_back(read_group(v, data));
  root.finish();
  return data;
}

}  // namespace myotact::prepare

#include "prepare/recipe/read_recipe.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "anatomy/read_body.h"
#include "core/json_reader.h"
#include "core/text.h"
#include "prepare/recipe/index_of.h"
#include "prepare/recipe/read_line.h"

namespace myotact::prepare {

namespace {

BoneData read_bone(const JsonValue& value, const AnatomyData& data) {
  JsonObject fields(value);
  BoneData bone{fields.at("key").string(),     fields.at("name_la").string(),
                fields.at("name_en").string(), index_of(fields.at("body"), data.bodies, "body"),
                fields.string_or("file", ""),  {}};
  if (const auto piece = fields.find("piece_m")) bone.piece_m = piece->vec3();
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
  if (const auto body = fields.find("body")) {
    site.body = index_of(*body, data.bodies, "body");
  } else {
    for (const JsonValue& bone : fields.at("bones").elements()) {
      index_of(bone, data.bones, "bone");
      site.bones.push_back(bone.string());
    }
    if (site.bones.empty()) throw value.error("names no bone; a muscle end must be fixed to one, or to a body");
  }
  site.point_m = fields.at("point_m").vec3();
  if (const auto area = fields.find("area_m2")) {
    site.area_m2 = area->number();
    if (!(site.area_m2 > 0.0 && site.area_m2 <= 1.0)) {
      throw area->error(
          fmt::format("is {} m2; must be > 0 and at most 1: a muscle hangs on nothing by an attachment "
                      "of no area. Leave it out if it is not known",
                      to_text(site.area_m2)));
    }
  }
  fields.finish();
  return site;
}

/// One site, or a list of them.
std::vector<AttachmentSite> read_sites(const JsonValue& value, const AnatomyData& data) {
  if (!value.raw().is_array()) return {read_site(value, data)};
  std::vector<AttachmentSite> sites;
  for (const JsonValue& site : value.elements()) sites.push_back(read_site(site, data));
  if (sites.empty()) throw value.error("is empty; a muscle needs an attachment at both ends");
  return sites;
}

PublishedMuscle read_published(const JsonValue& value) {
  JsonObject fields(value);
  const PublishedMuscle published{fields.at("mass_kg").number_between(1e-5, 10.0),
                                  fields.at("fascicle_m").number_between(1e-4, 1.0)};
  fields.finish();
  return published;
}

/// One, or a list of them.
std::vector<JsonValue> one_or_more(const JsonValue& value) {
  return value.raw().is_array() ? value.elements() : std::vector<JsonValue>{value};
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
  muscle.origins = read_sites(fields.at("origin"), data);
  muscle.insertions = read_sites(fields.at("insertion"), data);
  if (const auto published = fields.find("published")) muscle.published = read_published(*published);
  if (const auto crossing = fields.find("crossing")) {
    for (const JsonValue& v : one_or_more(*crossing)) muscle.crossings.push_back(read_crossing(v, data));
  }
  if (const auto wraps = fields.find("wraps")) {
    for (const JsonValue& v : wraps->elements()) muscle.wraps.push_back(read_wrap(v, data));
  }
  if (const auto line = fields.find("line")) muscle.line = read_line(*line, data);
  muscle.file = fields.string_or("file", "");
  fields.string_or("note", "");
  fields.finish();
  return muscle;
}

BandData read_band(const JsonValue& value, const AnatomyData& data) {
  JsonObject fields(value);
  BandData band;
  band.bone.key = fields.at("key").string();
  band.bone.name_la = fields.at("name_la").string();
  band.bone.name_en = fields.at("name_en").string();
  band.bone.body = index_of(fields.at("body"), data.bodies, "body");
  const auto ends = fields.at("points_m").elements(2);
  band.ends_m = {ends[0].vec3(), ends[1].vec3()};
  band.width_m = fields.at("width_m").number_between(1e-4, 0.2);
  band.thickness_m = fields.at("thickness_m").number_between(1e-4, 0.2);
  fields.at("why").string();
  fields.finish();
  return band;
}

LeftOut read_left_out(const JsonValue& value) {
  JsonObject fields(value);
  LeftOut left{fields.at("file").string(), fields.at("why").string()};
  fields.finish();
  return left;
}

/// A key that two parts share would make one overwrite the other's files.
template <class Part, class KeyOf>
void refuse_twins(const JsonValue& list, const std::vector<Part>& parts, KeyOf&& key_of) {
  const auto elements = list.elements();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (key_of(parts[i]) != key_of(parts[j])) continue;
      throw elements[i].error(
          fmt::format("has the key \"{}\", which entry {} has already; rename one", key_of(parts[i]), j));
    }
  }
}

GroupData read_group(const JsonValue& value, const AnatomyData& data) {
  JsonObject fields(value);
  GroupData group{index_of(fields.at("joint"), data.joints, "joint"), fields.at("flexors").strings(),
                  fields.at("extensors").strings()};
  fields.finish();
  return group;
}

}  // namespace

AnatomyData read_recipe(const std::filesystem::path& file) {
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
  if (const auto units = root.find("units")) data.units = units->one_of({"m", "cm", "mm", "in"});
  data.published_source = root.string_or("published_source", "");
  for (const JsonValue& v : root.at("bodies").elements()) data.bodies.push_back(anatomy::read_body(v));
  for (const JsonValue& v : root.at("bones").elements()) data.bones.push_back(read_bone(v, data));
  for (const JsonValue& v : root.at("joints").elements()) data.joints.push_back(read_joint(v, data));
  for (const JsonValue& v : root.at("muscles").elements()) data.muscles.push_back(read_muscle(v, data));
  for (const JsonValue& v : root.at("groups").elements()) data.groups.push_back(read_group(v, data));
  if (const auto built = root.find("built")) {
    for (const JsonValue& v : built->elements()) data.built.push_back(read_band(v, data));
  }
  data.shapes = root.string_or("shapes", "");
  if (data.shapes.find('/') != std::string::npos) {
    throw root.at("shapes").error("must be the name of a recipe beside this one, without a path");
  }
  if (const auto left = root.find("leave_out")) {
    for (const JsonValue& v : left->elements()) data.leave_out.push_back(read_left_out(v));
  }
  root.finish();
  refuse_twins(root.at("bodies"), data.bodies, [](const anatomy::Body& body) { return body.key; });
  refuse_twins(root.at("bones"), data.bones, [](const BoneData& bone) { return bone.key; });
  refuse_twins(root.at("muscles"), data.muscles, [](const MuscleData& muscle) { return muscle.mechanics.key; });
  return data;
}

}  // namespace myotact::prepare

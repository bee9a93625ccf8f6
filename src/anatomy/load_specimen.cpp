#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "anatomy/calibration_file.h"
#include "anatomy/read_body.h"
#include "anatomy/read_line.h"
#include "anatomy/read_reference.h"
#include "anatomy/specimen.h"
#include "core/error.h"
#include "core/file.h"
#include "core/json_reader.h"
#include "core/text.h"
#include "geometry/mesh_files.h"

namespace myotact::anatomy {

namespace {

constexpr double kLargestLength_m = 10.0;

/// What all readers of one specimen share.
struct Loader {
  std::filesystem::path folder;
  Specimen specimen;
  std::vector<std::string>* defects = nullptr;  // where they are collected; without, the first one is thrown
  std::vector<std::string> lost;                // keys of parts that could not be read

  /// Calls read(); collects what it throws, if that is wanted.
  template <class Read>
  bool attempt(Read&& read) {
    try {
      read();
      return true;
    } catch (const Error& defect) {
      if (!defects) throw;
      const bool known = std::find(defects->begin(), defects->end(), defect.what()) != defects->end();
      if (!known) defects->push_back(defect.what());
      return false;
    }
  }

  /// Whether a part speaks of one that was lost: what is wrong with it then is not its own fault.
  bool speaks_of_lost(const JsonValue& value) const {
    const std::string text = value.raw().dump();
    return std::any_of(lost.begin(), lost.end(),
                       [&](const std::string& key) { return text.find('"' + key + '"') != std::string::npos; });
  }

  /// A mesh file named in the specimen: a relative path that stays inside the folder.
  std::filesystem::path part(const JsonValue& name) const {
    const std::filesystem::path relative = name.string();
    if (relative.is_absolute() ||
        std::any_of(relative.begin(), relative.end(), [](const auto& p) { return p == ".."; })) {
      throw name.error("must be a path inside the specimen folder");
    }
    return folder / relative;
  }
};

template <class Part>
void refuse_twin(const JsonValue& value, const std::vector<Part>& parts) {
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    if (parts[i].key == parts.back().key) throw value.error(fmt::format("the key \"{}\" is used twice", parts[i].key));
  }
}

Bone read_bone(const JsonValue& value, const Loader& loader) {
  JsonObject fields(value);
  Bone bone;
  bone.key = fields.at("key").string();
  bone.name_la = fields.string_or("name_la", bone.key);
  bone.name_en = fields.string_or("name_en", bone.key);
  bone.body = reference(fields.at("body"), loader.specimen.bodies, "body");
  bone.surface = geometry::read_ply(loader.part(fields.at("file")));
  fields.finish();
  return bone;
}

Joint read_joint(const JsonValue& value, const Loader& loader) {
  JsonObject fields(value);
  Joint joint;
  joint.key = fields.at("key").string();
  const std::string type = fields.at("type").one_of({"hinge", "universal", "ball", "weld"});
  joint.type = type == "hinge"       ? JointType::Hinge
               : type == "universal" ? JointType::Universal
               : type == "ball"      ? JointType::Ball
                                     : JointType::Weld;
  joint.parent = reference(fields.at("parent"), loader.specimen.bodies, "body");
  joint.child = reference(fields.at("child"), loader.specimen.bodies, "body");
  joint.centre_m = fields.at("centre_m").vec3();
  for (const JsonValue& axis : fields.at("axes").elements()) joint.axes.push_back(axis.vec3());
  for (const JsonValue& range : fields.at("range_rad").elements()) {
    const auto ends = range.elements(2);
    joint.range_rad.emplace_back(ends[0].number_between(-6.3, 6.3), ends[1].number_between(-6.3, 6.3));
  }
  joint.stiffness_Nm_rad = fields.number_or("stiffness_Nm_rad", 0.0);
  joint.damping_Nms_rad = fields.number_or("damping_Nms_rad", 0.0);
  joint.centre_uncertainty_m = fields.number_or("centre_uncertainty_m", 0.0);
  joint.axis_uncertainty_rad = fields.number_or("axis_uncertainty_rad", 0.0);
  if (joint.stiffness_Nm_rad < 0.0 || joint.damping_Nms_rad < 0.0) {
    throw value.error("stiffness_Nm_rad and damping_Nms_rad must be >= 0");
  }
  fields.finish();
  return joint;
}

std::vector<TissueRegion> regions_of(const geometry::TetFile& file, const JsonValue& place) {
  std::vector<TissueRegion> regions;
  for (const int region : file.regions) {
    if (region < 0 || region > 2) throw place.error(fmt::format("a tet has region {}; must be 0, 1 or 2", region));
    regions.push_back(static_cast<TissueRegion>(region));
  }
  return regions;
}

void read_mechanics(JsonObject& fields, Muscle& muscle) {
  muscle.peak_force_N = fields.at("peak_force_N").number();
  muscle.optimal_fibre_m = fields.at("optimal_fibre_m").number_between(0.0, kLargestLength_m);
  muscle.pennation_rad = fields.at("pennation_rad").number();
  muscle.rest_stretch = fields.number_or("rest_stretch", muscle.rest_stretch);
  muscle.tendon_slack_m = fields.number_or("tendon_slack_m", 0.0);
  muscle.activation_tau_s = fields.number_or("activation_tau_s", muscle.activation_tau_s);
  muscle.deactivation_tau_s = fields.number_or("deactivation_tau_s", muscle.deactivation_tau_s);
  if (const auto estimated = fields.find("estimated")) muscle.estimated = estimated->strings();
  if (const auto sources = fields.find("sources")) muscle.sources = sources->strings();
}

Muscle read_muscle(const JsonValue& value, const Loader& loader) {
  JsonObject fields(value);
  Muscle muscle;
  muscle.key = fields.at("key").string();
  muscle.name_la = fields.string_or("name_la", muscle.key);
  muscle.name_en = fields.string_or("name_en", muscle.key);
  muscle.material = fields.string_or("material", "muscle");
  read_mechanics(fields, muscle);
  const JsonValue tets = fields.at("tets");
  geometry::TetFile file = geometry::read_vtk(loader.part(tets));
  muscle.regions = regions_of(file, tets);
  muscle.tets = std::move(file.mesh);
  muscle.fibres = std::move(file.fibres);
  muscle.sections_m2 = std::move(file.sections_m2);
  muscle.attachments = std::move(file.attachments);
  muscle.skin = geometry::read_ply(loader.part(fields.at("skin")));
  fields.finish();
  return muscle;
}

MuscleGroup read_group(const JsonValue& value, const Loader& loader) {
  JsonObject fields(value);
  MuscleGroup group;
  group.joint = reference(fields.at("joint"), loader.specimen.joints, "joint");
  for (const JsonValue& name : fields.at("flexors").elements()) {
    group.flexors.push_back(reference(name, loader.specimen.muscles, "muscle"));
  }
  for (const JsonValue& name : fields.at("extensors").elements()) {
    group.extensors.push_back(reference(name, loader.specimen.muscles, "muscle"));
  }
  fields.finish();
  return group;
}

Overlap read_overlap(const JsonValue& value) {
  JsonObject fields(value);
  Overlap overlap{fields.at("a").string(), fields.at("b").string(), fields.at("depth_m").number(),
                  fields.at("volume_m3").number()};
  fields.finish();
  return overlap;
}

/// A file that changed since the specimen was made no longer fits the numbers beside it.
void check_sum(const std::string& name, const JsonValue& sum, const Loader& loader) {
  const nlohmann::json name_json = name;
  if (sha256(read_file(loader.part(JsonValue(name_json, sum.file(), sum.pointer())))) != sum.string()) {
    throw sum.error(fmt::format("{} has another SHA-256 than recorded; prepare the specimen again", name));
  }
}

void check_sums(const JsonValue& files, Loader& loader) {
  JsonObject object(files);
  for (const auto& [name, sum] : object.entries()) {
    loader.attempt([&, &name = name, &sum = sum] { check_sum(name, sum, loader); });
  }
}

/// Takes the place of a body that cannot be read, so that what refers to it can be looked at.
Body stand_in(const JsonValue& value) {
  Body body;
  if (const auto key = value.raw().find("key"); key != value.raw().end() && key->is_string()) body.key = *key;
  body.mass_kg = 1.0;
  body.inertia_kg_m2 = {1.0, 1.0, 1.0, 0.0, 0.0, 0.0};
  return body;
}

void read_lists(JsonObject& root, Loader& loader) {
  Specimen& s = loader.specimen;
  const auto each = [&](const char* key, auto& list, auto&& reader) {
    for (const JsonValue& value : root.at(key).elements()) {
      if (loader.speaks_of_lost(value)) continue;
      loader.attempt([&] { list.push_back(reader(value)); });
    }
  };
  const auto each_keyed = [&](const char* key, auto& list, auto&& reader) {
    for (const JsonValue& value : root.at(key).elements()) {
      const bool read = loader.attempt([&] {
        list.push_back(reader(value));
        refuse_twin(value, list);
      });
      const auto named = value.raw().find("key");
      if (!read && named != value.raw().end() && named->is_string()) loader.lost.push_back(*named);
    }
  };
  each_keyed("bodies", s.bodies, [&](const JsonValue& v) {
    Body body;
    if (!loader.attempt([&] { body = read_body(v); })) body = stand_in(v);
    return body;
  });
  each_keyed("bones", s.bones, [&](const JsonValue& v) { return read_bone(v, loader); });
  each_keyed("joints", s.joints, [&](const JsonValue& v) { return read_joint(v, loader); });
  each_keyed("muscles", s.muscles, [&](const JsonValue& v) { return read_muscle(v, loader); });
  each("lines", s.lines, [&](const JsonValue& v) { return read_line(v, s); });
  each("groups", s.groups, [&](const JsonValue& v) { return read_group(v, loader); });
  if (root.find("overlaps")) each("overlaps", s.overlaps, read_overlap);
}

void read_specimen(JsonObject& root, Loader& loader) {
  root.at("schema").integer_between(1, 1);
  if (const auto files = root.find("files")) check_sums(*files, loader);
  Specimen& specimen = loader.specimen;
  specimen.name = root.at("name").string();
  specimen.species = root.string_or("species", "");
  specimen.breed = root.string_or("breed", "");
  specimen.side = root.at("side").one_of({"left", "right"});
  specimen.source = root.string_or("source", "");
  specimen.licence = root.string_or("licence", "");
  specimen.created_by = root.string_or("created_by", "");
  read_lists(root, loader);
  root.finish();
}

std::filesystem::path specimen_file(const std::filesystem::path& folder) {
  const auto file = folder / "specimen.json";
  std::error_code failure;  // a path that cannot even be examined is no specimen either
  if (std::filesystem::exists(file, failure)) return file;
  throw Error(ExitStatus::NoInput, folder.string() +
                                       ": is no specimen folder: specimen.json is missing; make one "
                                       "with myotact-prepare");
}

}  // namespace

Specimen parse_specimen(const std::string& text, const std::filesystem::path& folder) {
  const std::string file = (folder / "specimen.json").string();
  const nlohmann::json json = parse_json(text, file);
  JsonObject root(JsonValue(json, file));
  Loader loader{folder, {}, nullptr, {}};
  read_specimen(root, loader);
  if (const std::string defect = find_defect(loader.specimen); !defect.empty()) throw bad_data(file, "", defect);
  return std::move(loader.specimen);
}

Specimen load_specimen(const std::filesystem::path& folder) {
  Specimen specimen = parse_specimen(read_file(specimen_file(folder)), folder);
  read_calibration(folder, specimen);
  return specimen;
}

SpecimenSurvey survey_specimen(const std::filesystem::path& folder) {
  const std::string file = specimen_file(folder).string();
  SpecimenSurvey survey;
  Loader loader{folder, {}, &survey.defects, {}};
  loader.attempt([&] {
    const nlohmann::json json = parse_json(read_file(file), file);
    JsonObject root(JsonValue(json, file));
    read_specimen(root, loader);
    read_calibration(folder, loader.specimen);
  });
  for (const std::string& defect : find_defects(loader.specimen)) survey.defects.push_back(file + ": " + defect);
  survey.specimen = std::move(loader.specimen);
  return survey;
}

}  // namespace myotact::anatomy

#include "prepare/recipe/recipe_text.h"

#include "anatomy/specimen_json.h"
#include "core/at.h"

namespace myotact::prepare {

namespace {

using anatomy::Json;
using anatomy::json_of;

Json json_of(const BoneData& bone, const AnatomyData& anatomy) {
  Json json = {{"key", bone.key},
               {"name_la", bone.name_la},
               {"name_en", bone.name_en},
               {"body", anatomy.bodies[at(bone.body)].key}};
  if (!bone.file.empty()) json["file"] = bone.file;
  if (bone.piece_m) json["piece_m"] = json_of(*bone.piece_m);
  return json;
}

Json json_of(const std::vector<AttachmentSite>& sites, const AnatomyData& anatomy) {
  Json list = Json::array();
  for (const AttachmentSite& site : sites) {
    Json json;
    if (site.body >= 0)
      json["body"] = anatomy.bodies[at(site.body)].key;
    else
      json["bones"] = site.bones;
    json["point_m"] = json_of(site.point_m);
    if (site.area_m2 > 0.0) json["area_m2"] = site.area_m2;
    list.push_back(std::move(json));
  }
  return list.size() == 1 ? list.front() : list;
}

Json json_of(const MuscleData& muscle, const AnatomyData& anatomy) {
  const anatomy::Muscle& mechanics = muscle.mechanics;
  Json json = {{"key", mechanics.key}, {"name_la", mechanics.name_la}, {"name_en", mechanics.name_en}};
  json.update(anatomy::json_of_mechanics(mechanics));
  json["origin"] = json_of(muscle.origins, anatomy);
  json["insertion"] = json_of(muscle.insertions, anatomy);
  if (!muscle.file.empty()) json["file"] = muscle.file;
  if (muscle.line.empty()) return json;
  json["line"] = Json::array();
  for (const anatomy::LinePoint& point : muscle.line) {
    json["line"].push_back({{"body", anatomy.bodies[at(point.body)].key}, {"position_m", json_of(point.position_m)}});
  }
  return json;
}

}  // namespace

std::string recipe_text(const AnatomyData& anatomy) {
  Json json = {{"schema", 1},
               {"what", "guessed from the surfaces alone: edit it and prepare them again with --recipe"},
               {"name", anatomy.name},
               {"species", anatomy.species},
               {"breed", anatomy.breed},
               {"side", anatomy.side},
               {"source", anatomy.source},
               {"licence", anatomy.licence}};
  if (!anatomy.units.empty()) json["units"] = anatomy.units;
  for (const char* list : {"bodies", "bones", "joints", "muscles", "groups"}) json[list] = Json::array();
  for (const anatomy::Body& body : anatomy.bodies) json["bodies"].push_back(json_of(body));
  for (const BoneData& bone : anatomy.bones) json["bones"].push_back(json_of(bone, anatomy));
  for (const anatomy::Joint& joint : anatomy.joints) json["joints"].push_back(json_of(joint, anatomy.bodies));
  for (const MuscleData& muscle : anatomy.muscles) json["muscles"].push_back(json_of(muscle, anatomy));
  for (const GroupData& group : anatomy.groups) {
    json["groups"].push_back(
        {{"joint", anatomy.joints[at(group.joint)].key}, {"flexors", group.flexors}, {"extensors", group.extensors}});
  }
  return json.dump(1) + "\n";
}

}  // namespace myotact::prepare

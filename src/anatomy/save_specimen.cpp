#include "anatomy/specimen.h"
#include "anatomy/specimen_json.h"
#include "core/error.h"
#include "core/file.h"
#include "core/folder.h"
#include "geometry/mesh_files.h"

namespace myotact::anatomy {

namespace {

using anatomy::json_of;  // beside those below

Json json_of(const Muscle& muscle) {
  Json json = {{"key", muscle.key},
               {"name_la", muscle.name_la},
               {"name_en", muscle.name_en},
               {"tets", "muscles/" + muscle.key + ".vtk"},
               {"skin", "skins/" + muscle.key + ".ply"},
               {"material", muscle.material}};
  json.update(json_of_mechanics(muscle));
  return json;
}

Json json_of(const LineWrap& wrap, const Specimen& specimen) {
  static constexpr const char* kShapes[] = {"cylinder", "sphere", "ellipsoid"};
  Json json = {{"body", specimen.bodies[static_cast<std::size_t>(wrap.body)].key},
               {"shape", kShapes[static_cast<int>(wrap.shape)]},
               {"after", wrap.after},
               {"centre_m", json_of(wrap.centre_m)}};
  if (wrap.shape == geometry::WrapShape::Cylinder) json["axis"] = json_of(Vec3(wrap.axes.row(2)));
  if (wrap.shape == geometry::WrapShape::Ellipsoid) {
    json["radii_m"] = json_of(wrap.radii_m);
    json["axes"] = Json::array();
    for (int row = 0; row < 3; ++row) json["axes"].push_back(json_of(Vec3(wrap.axes.row(row))));
  } else {
    json["radius_m"] = wrap.radii_m[0];
  }
  json["side"] = json_of(wrap.side);
  return json;
}

Json json_of(const MuscleLine& line, const Specimen& specimen) {
  static constexpr const char* kKinds[] = {"origin", "via", "insertion"};
  Json points = Json::array();
  for (const LinePoint& point : line.points) {
    points.push_back({{"body", specimen.bodies[static_cast<std::size_t>(point.body)].key},
                      {"position_m", json_of(point.position_m)},
                      {"kind", kKinds[static_cast<int>(point.kind)]}});
  }
  Json wraps = Json::array();
  for (const LineWrap& wrap : line.wraps) wraps.push_back(json_of(wrap, specimen));
  return {
      {"muscle", specimen.muscles[static_cast<std::size_t>(line.muscle)].key}, {"points", points}, {"wraps", wraps}};
}

Json keys_of(const std::vector<int>& muscles, const Specimen& specimen) {
  Json keys = Json::array();
  for (const int m : muscles) keys.push_back(specimen.muscles[static_cast<std::size_t>(m)].key);
  return keys;
}

Json json_of_lists(const Specimen& s) {
  Json json;
  json["bones"] = json["bodies"] = json["joints"] = json["muscles"] = json["lines"] = json["groups"] =
      json["overlaps"] = Json::array();
  for (const Bone& bone : s.bones) {
    json["bones"].push_back({{"key", bone.key},
                             {"name_la", bone.name_la},
                             {"name_en", bone.name_en},
                             {"file", "bones/" + bone.key + ".ply"},
                             {"body", s.bodies[static_cast<std::size_t>(bone.body)].key}});
  }
  for (const Body& body : s.bodies) json["bodies"].push_back(json_of(body));
  for (const Joint& joint : s.joints) json["joints"].push_back(json_of(joint, s.bodies));
  for (const Muscle& muscle : s.muscles) json["muscles"].push_back(json_of(muscle));
  for (const MuscleLine& line : s.lines) json["lines"].push_back(json_of(line, s));
  for (const MuscleGroup& group : s.groups) {
    json["groups"].push_back({{"joint", s.joints[static_cast<std::size_t>(group.joint)].key},
                              {"flexors", keys_of(group.flexors, s)},
                              {"extensors", keys_of(group.extensors, s)}});
  }
  for (const Overlap& o : s.overlaps) {
    json["overlaps"].push_back({{"a", o.a}, {"b", o.b}, {"depth_m", o.depth_m}, {"volume_m3", o.volume_m3}});
  }
  return json;
}

/// Writes everything into `folder`, which is there and empty.
void write_parts(const Specimen& specimen, const std::filesystem::path& folder) {
  for (const char* part : {"bones", "skins", "muscles"}) make_writable_folder(folder / part);
  std::vector<std::string> files;
  for (const Bone& bone : specimen.bones) {
    files.push_back("bones/" + bone.key + ".ply");
    geometry::write_ply(bone.surface, folder / files.back());
  }
  for (const Muscle& muscle : specimen.muscles) {
    files.push_back("skins/" + muscle.key + ".ply");
    geometry::write_ply(muscle.skin, folder / files.back());
    std::vector<int> regions;
    for (const TissueRegion region : muscle.regions) regions.push_back(static_cast<int>(region));
    files.push_back("muscles/" + muscle.key + ".vtk");
    geometry::write_vtk({muscle.tets, muscle.fibres, muscle.sections_m2, regions, muscle.attachments},
                        folder / files.back());
  }
  Json json = {{"schema", 1},
               {"name", specimen.name},
               {"species", specimen.species},
               {"breed", specimen.breed},
               {"side", specimen.side},
               {"source", specimen.source},
               {"licence", specimen.licence},
               {"created_by", specimen.created_by}};
  json.update(json_of_lists(specimen));
  json["files"] = Json::object();
  for (const std::string& file : files) json["files"][file] = sha256(read_file(folder / file));
  write_file(folder / "specimen.json", json.dump(1) + "\n");
}

}  // namespace

void save_specimen(const Specimen& specimen, const std::filesystem::path& folder, const CompanionFiles& companions) {
  if (const std::string defect = find_defect(specimen); !defect.empty()) throw bad_data(folder.string(), "", defect);
  write_folder(folder, "specimen.json", [&](const std::filesystem::path& fresh) {
    write_parts(specimen, fresh);
    for (const auto& [name, bytes] : companions) write_file(fresh / name, bytes);
  });
}

}  // namespace myotact::anatomy

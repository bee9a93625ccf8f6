#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "anatomy/hinge_chains.h"
#include "core/at.h"
#include "core/file.h"
#include "core/text.h"
#include "exchange/opensim.h"
#include "exchange/opensim_convert.h"
#include "geometry/mesh_files.h"
#include "simulation/line/line_model.h"

namespace myotact::exchange::opensim {
namespace {

/// Adds the stiffness and damping of springs that rest at the file pose to their joints.
void add_springs(const RawModel& raw, Placed& placed) {
  for (const Spring& spring : raw.springs) {
    const auto taken = std::find_if(placed.coordinates.begin(), placed.coordinates.end(),
                                    [&](const CoordinateTaken& c) { return c.coordinate == spring.coordinate; });
    if (taken == placed.coordinates.end()) {
      spring.element.tell("left out: the specimen has no motion along " + spring.coordinate.substr(0, 80));
      continue;
    }
    constexpr double kSamePlace = 1e-6;
    if (spring.stiffness < 0.0 || spring.viscosity < 0.0 || std::abs(spring.rest - taken->file_pose) > kSamePlace) {
      spring.element.tell("left out: a joint's spring pulls towards the file pose, and neither pushes nor drives");
      continue;
    }
    const int index = anatomy::find_joint(placed.specimen, taken->joint);
    anatomy::Joint& joint = placed.specimen.joints[at(index)];
    const double squared = taken->factor * taken->factor;
    joint.stiffness_Nm_rad = std::max(joint.stiffness_Nm_rad, spring.stiffness / squared);
    joint.damping_Nms_rad = std::max(joint.damping_Nms_rad, spring.viscosity / squared);
  }
}

/// The surface, or the reason why there is none.
std::string read_bone(const Mesh& mesh, const std::filesystem::path& folder, geometry::TriangleMesh& surface) {
  const std::filesystem::path name = mesh.file;
  const bool inside =
      !name.is_absolute() && std::none_of(name.begin(), name.end(), [](const auto& p) { return p == ".."; });
  if (!inside || name.empty()) return "its file is not beside the model";
  for (const auto& place : {folder / name, folder / "Geometry" / name}) {
    std::error_code failure;
    if (!std::filesystem::is_regular_file(place, failure)) continue;
    try {
      surface = geometry::read_surface(place).mesh;
    } catch (const Error& error) {
      return error.what();
    }
    const bool closed = !surface.triangles.empty() && geometry::bad_edge_count(surface) == 0;
    return closed ? "" : "the surface is not closed; mend it, or prepare it with myotact-prepare";
  }
  return "its file is not there, neither beside the model nor in Geometry beside it";
}

void add_bones(const RawModel& raw, const std::filesystem::path& folder, Placed& placed) {
  std::vector<std::string> keys;
  for (const Mesh& mesh : raw.meshes) {
    anatomy::Bone bone;
    const std::string problem = folder.empty() ? "surfaces are not read here" : read_bone(mesh, folder, bone.surface);
    if (!problem.empty()) {
      mesh.element.leave("left out: " + problem);
      continue;
    }
    const Pose X_LM = placed.X_LB[at(mesh.body)] * mesh.X_BM;
    bool near = true;
    for (Vec3& x : bone.surface.positions_m) {
      x = X_LM * x.cwiseProduct(mesh.scale);
      near = near && x.norm() < 10.0;
    }
    if (!near) {
      mesh.element.leave("left out: it reaches beyond 10 m; are its units metres?");
      continue;
    }
    bone.key = key_of(std::filesystem::path(mesh.file).stem().string(), keys);
    bone.name_la = bone.name_en = bone.key;
    bone.body = mesh.body;
    placed.specimen.bones.push_back(std::move(bone));
  }
}

/// The ground is a body of the specimen only where something is fixed to it or moves against it.
void drop_ground(anatomy::Specimen& specimen) {
  const auto on_ground = [](const auto& part) { return part.body == 0; };
  for (const anatomy::Joint& joint : specimen.joints) {
    if (joint.parent == 0 && joint.type != anatomy::JointType::Weld) return;
  }
  for (const anatomy::MuscleLine& line : specimen.lines) {
    if (std::any_of(line.points.begin(), line.points.end(), on_ground)) return;
    if (std::any_of(line.wraps.begin(), line.wraps.end(), on_ground)) return;
  }
  if (std::any_of(specimen.bones.begin(), specimen.bones.end(), on_ground)) return;
  std::erase_if(specimen.joints, [](const anatomy::Joint& joint) { return joint.parent == 0; });
  specimen.bodies.erase(specimen.bodies.begin());
  for (anatomy::Joint& joint : specimen.joints) --joint.parent, --joint.child;
  for (anatomy::Bone& bone : specimen.bones) --bone.body;
  for (anatomy::MuscleLine& line : specimen.lines) {
    for (anatomy::LinePoint& point : line.points) --point.body;
    for (anatomy::LineWrap& wrap : line.wraps) --wrap.body;
  }
  for (anatomy::Muscle& muscle : specimen.muscles) {
    for (int& body : muscle.attachments) {
      if (body >= 0) --body;
    }
  }
}

/// The joint with most muscles on the weaker of its sides; of several, that with most on both.
int joint_to_show(const anatomy::Specimen& specimen) {
  int best = -1;
  std::pair<std::size_t, std::size_t> most{0, 0};
  for (const anatomy::MuscleGroup& group : specimen.groups) {
    const std::size_t flexors = group.flexors.size(), extensors = group.extensors.size();
    const std::pair here{std::min(flexors, extensors), flexors + extensors};
    if (here.first == 0 || here <= most) continue;
    most = here;
    best = group.joint;
  }
  return best;
}

std::string scene_of_lines(const anatomy::Specimen& specimen, int joint,
                           const std::vector<CoordinateTaken>& coordinates) {
  using Json = nlohmann::ordered_json;
  Json joints = Json::object();
  const anatomy::Specimen chains = anatomy::with_hinge_chains(specimen);
  for (std::size_t j = 0; j < chains.joints.size(); ++j) {
    if (chains.joints[j].axes.empty()) continue;
    joints[chains.joints[j].key] = {{"q_rad", 0.0}, {"locked", static_cast<int>(j) != joint}};
  }
  for (const CoordinateTaken& c : coordinates) {  // the model's own start
    const std::string key = c.axis == 0 ? c.joint : fmt::format("{}.{}", c.joint, c.axis + 1);
    const int index = anatomy::find_joint(chains, key);
    if (index < 0) continue;
    const auto& [lowest, highest] = chains.joints[at(index)].range_rad[0];
    joints[key]["q_rad"] = std::clamp(c.factor * (c.default_rad - c.file_pose), lowest, highest);
  }
  Json scene = {{"schema", 1},  {"name", "imported"}, {"title", specimen.name},          {"specimen", "."},
                {"dt_s", 0.01}, {"joints", joints},   {"tissue", {{"default", "line"}}}, {"contact", false}};
  if (joint >= 0) {
    scene["co_contraction"] = {
        {"joint", specimen.joints[at(joint)].key}, {"common", 0}, {"difference", 0}, {"hold_posture", false}};
  }
  scene["tools"] = Json::array({{{"device", "simulated"}, {"hand", "right"}, {"radius_m", 0.003}}});
  return scene.dump(1) + "\n";
}

std::string stem_of(const std::string& file) {
  return std::filesystem::path(file).stem().string();
}

void name_specimen(const RawModel& raw, anatomy::Specimen& specimen) {
  specimen.name = raw.name.empty() ? stem_of(raw.file) : raw.name;
  specimen.species = specimen.breed = "unknown";
  specimen.side = lower(raw.name).ends_with("_r") ? "right" : "left";
  specimen.source = "OpenSim model " + specimen.name + (raw.credits.empty() ? "" : ": " + raw.credits);
  specimen.licence = "see source";
  specimen.created_by = "myotact import";
}

/// At the pose in which more muscles can work: that of all coordinates at 0, if both are as good.
Placed place_muscles(const RawModel& raw) {
  Placed at_zero = place_skeleton(raw, file_pose(raw, false));
  Placed at_defaults = at_zero;
  if (add_muscles(raw, false, at_zero) > 0) {
    at_defaults = place_skeleton(raw, file_pose(raw, true));
    if (add_muscles(raw, false, at_defaults); at_defaults.specimen.muscles.size() <= at_zero.specimen.muscles.size()) {
      at_defaults = place_skeleton(raw, file_pose(raw, false));
    } else {
      at_defaults = place_skeleton(raw, file_pose(raw, true));
    }
  }
  add_muscles(raw, true, at_defaults);
  return at_defaults;
}

}  // namespace

void add_groups(anatomy::Specimen& specimen) {
  constexpr double kLeastArm_m = 1e-3;  // less is neither side's work
  const anatomy::Specimen chains = anatomy::with_hinge_chains(specimen);
  simulation::Skeleton skeleton(chains);
  simulation::LineGeometry geometry;
  for (std::size_t j = 0; j < specimen.joints.size(); ++j) {
    if (specimen.joints[j].axes.empty()) continue;
    std::vector<double> q(chains.joints.size(), 0.0);
    q[j] = 0.5 * (chains.joints[j].range_rad[0].first + chains.joints[j].range_rad[0].second);
    skeleton.set_pose(q);
    anatomy::MuscleGroup group;
    group.joint = static_cast<int>(j);
    for (const anatomy::MuscleLine& line : specimen.lines) {
      if (!simulation::spans_joint(line, skeleton, group.joint)) continue;
      simulation::measure_line(line, skeleton, geometry);
      const double arm_m = -geometry.slope_m_rad[group.joint];
      if (arm_m > kLeastArm_m) group.flexors.push_back(line.muscle);
      if (arm_m < -kLeastArm_m) group.extensors.push_back(line.muscle);
    }
    if (!group.flexors.empty() || !group.extensors.empty()) specimen.groups.push_back(group);
  }
}

Import parse_model(std::string_view text, const std::string& file, const std::filesystem::path& folder) {
  Document document(text, file);
  const RawModel raw = read_raw_model(document);
  Placed placed = place_muscles(raw);
  add_springs(raw, placed);
  add_bones(raw, folder, placed);
  drop_ground(placed.specimen);
  add_groups(placed.specimen);
  name_specimen(raw, placed.specimen);
  if (const std::string defect = anatomy::find_defect(placed.specimen); !defect.empty()) {
    throw bad_data(file, "", defect);
  }
  Import import;
  const int joint = joint_to_show(placed.specimen);
  import.scene_json = scene_of_lines(placed.specimen, joint, placed.coordinates);
  if (joint >= 0) import.scene_joint = placed.specimen.joints[at(joint)].key;
  import.specimen = std::move(placed.specimen);
  import.coordinates = std::move(placed.coordinates);
  import.not_taken = document.not_taken();
  return import;
}

Import read_model(const std::filesystem::path& file) {
  std::filesystem::path folder = file.parent_path();
  if (folder.empty()) folder = ".";
  return parse_model(read_file(file), file.string(), folder);
}

}  // namespace myotact::exchange::opensim

#include <algorithm>
#include <cmath>
#include <sstream>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/at.h"
#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "exchange/opensim.h"
#include "exchange/opensim_convert.h"
#include "exchange/opensim_writer.h"

namespace myotact::exchange::opensim {
namespace {

constexpr const char* kVersion = "40000";  // read by every OpenSim 4

void write_frames(const Layout& layout, const anatomy::Joint& joint, const Vec3& xyz_rad, pugi::xml_node parent) {
  pugi::xml_node frames = parent.append_child("frames");
  for (const int body : {joint.parent, joint.child}) {
    const bool proximal = body == joint.parent;
    pugi::xml_node frame = add_named(frames, "PhysicalOffsetFrame", proximal ? "proximal_offset" : "distal_offset");
    add_text(frame, "socket_parent", layout.path(body));
    add_vec3(frame, "translation", layout.in_body(body, joint.centre_m));
    add_vec3(frame, "orientation", xyz_rad);
  }
}

void write_coordinates(const anatomy::Joint& joint, pugi::xml_node parent) {
  const std::vector<std::string> names = coordinate_names(joint);
  if (names.empty()) return;
  pugi::xml_node coordinates = parent.append_child("coordinates");
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto& [lowest, highest] = joint.range_rad[i];
    pugi::xml_node coordinate = add_named(coordinates, "Coordinate", names[i]);
    add_number(coordinate, "default_value", std::clamp(0.0, lowest, highest));
    add_text(coordinate, "range", to_text(lowest) + " " + to_text(highest));
    add_text(coordinate, "clamped", "true");
  }
}

/// The third axis of a joint of two is only there because OpenSim wants three that do not lie in a plane.
void write_transform(const anatomy::Joint& joint, pugi::xml_node parent) {
  std::vector<Vec3> axes = joint.axes;
  if (axes.size() == 2) axes.push_back(axes[0].cross(axes[1]).normalized());
  const std::vector<std::string> names = coordinate_names(joint);
  pugi::xml_node transform = parent.append_child("SpatialTransform");
  for (std::size_t i = 0; i < 6; ++i) {
    const bool rotates = i < 3, moves = i < joint.axes.size();
    pugi::xml_node axis =
        add_named(transform, "TransformAxis", fmt::format("{}{}", rotates ? "rotation" : "translation", i % 3 + 1));
    add_text(axis, "coordinates", moves ? names[i] : "");
    add_vec3(axis, "axis", rotates ? Layout::direction(axes[i]) : Vec3(Vec3::Unit(static_cast<Eigen::Index>(i % 3))));
    pugi::xml_node function = add_named(axis, moves ? "LinearFunction" : "Constant", "function");
    moves ? add_text(function, "coefficients", "1 0") : add_text(function, "value", "0");
  }
}

void write_joint(const Layout& layout, const anatomy::Joint& joint, pugi::xml_node joints) {
  static constexpr const char* kTypes[] = {"PinJoint", "CustomJoint", "CustomJoint", "WeldJoint"};
  pugi::xml_node node = add_named(joints, kTypes[static_cast<int>(joint.type)], joint.key);
  add_text(node, "socket_parent_frame", "proximal_offset");
  add_text(node, "socket_child_frame", "distal_offset");
  write_coordinates(joint, node);
  Vec3 xyz_rad = Vec3::Zero();
  if (joint.type == anatomy::JointType::Hinge) {  // a pin turns about z
    const Vec3 z = Layout::direction(joint.axes[0]), x = z.unitOrthogonal();
    Mat3 rotation;
    rotation << x, z.cross(x), z;
    xyz_rad = xyz_of(rotation);
  }
  write_frames(layout, joint, xyz_rad, node);
  if (joint.axes.size() >= 2) write_transform(joint, node);
}

void write_root(const Layout& layout, int body, pugi::xml_node joints) {
  const std::string& key = layout.specimen().bodies[at(body)].key;
  pugi::xml_node node = add_named(joints, "WeldJoint", "ground_" + key);
  add_text(node, "socket_parent_frame", "/ground");
  add_text(node, "socket_child_frame", layout.path(body));
}

void write_bones(const Layout& layout, int body, const std::string& folder, pugi::xml_node parent) {
  const anatomy::Specimen& specimen = layout.specimen();
  if (std::none_of(specimen.bones.begin(), specimen.bones.end(), [&](const auto& b) { return b.body == body; })) return;
  pugi::xml_node geometry = parent.append_child("attached_geometry");
  for (const anatomy::Bone& bone : specimen.bones) {
    if (bone.body != body) continue;
    pugi::xml_node mesh = add_named(geometry, "Mesh", bone.key);
    add_text(mesh, "socket_frame", "..");
    add_vec3(mesh, "scale_factors", Vec3::Ones());
    add_text(mesh, "mesh_file", folder + "/" + bone.key + ".obj");
  }
}

void write_body(const Layout& layout, int index, const std::string& folder, pugi::xml_node parent) {
  const anatomy::Body& body = layout.specimen().bodies[at(index)];
  pugi::xml_node node = add_named(parent, "Body", body.key);
  write_bones(layout, index, folder, node);
  write_wraps(layout, index, node);
  add_number(node, "mass", body.mass_kg);
  add_vec3(node, "mass_center", layout.in_body(index, body.com_m));
  const auto& [xx, yy, zz, xy, xz, yz] = body.inertia_kg_m2;
  Mat3 own, rows;
  own << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  const Mat3 R_OL = specimen_from_ground().transpose();
  const Mat3 turned = R_OL * own * R_OL.transpose();
  std::string text;
  for (const auto& [r, c] : {std::pair{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}) {
    text += (text.empty() ? "" : " ") + to_text(turned(r, c));
  }
  add_text(node, "inertia", text);
}

void write_springs(const anatomy::Joint& joint, pugi::xml_node forces) {
  if (joint.stiffness_Nm_rad == 0.0 && joint.damping_Nms_rad == 0.0) return;
  for (const std::string& name : coordinate_names(joint)) {
    pugi::xml_node spring = add_named(forces, "SpringGeneralizedForce", name + "_spring");
    add_text(spring, "coordinate", name);
    add_number(spring, "stiffness", joint.stiffness_Nm_rad);
    add_number(spring, "rest_length", 0.0);
    add_number(spring, "viscosity", joint.damping_Nms_rad);
  }
}

std::string obj_text(const Layout& layout, const anatomy::Bone& bone) {
  std::string text = "# " + bone.key + ", metres, in the frame of its body\n";
  for (const Vec3& x : bone.surface.positions_m) {
    const Vec3 p = layout.in_body(bone.body, x);
    text += fmt::format("v {} {} {}\n", to_text(p.x()), to_text(p.y()), to_text(p.z()));
  }
  for (const auto& t : bone.surface.triangles) text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

}  // namespace

Layout::Layout(const anatomy::Specimen& specimen) : specimen_(specimen) {
  joint_above_.assign(specimen.bodies.size(), -1);
  origins_L_.assign(specimen.bodies.size(), Vec3::Zero());
  for (std::size_t j = 0; j < specimen.joints.size(); ++j) {
    const anatomy::Joint& joint = specimen.joints[j];
    joint_above_[at(joint.child)] = static_cast<int>(j);
    origins_L_[at(joint.child)] = joint.centre_m;
  }
  const int found = anatomy::find_body(specimen, "ground");
  if (found >= 0 && joint_above(found) < 0) ground_ = found;
}

std::string Layout::path(int body) const {
  return body == ground_ ? "/ground" : "/bodyset/" + specimen_.bodies[at(body)].key;
}

Vec3 Layout::in_body(int body, const Vec3& p_L) const {
  return direction(p_L - origins_L_[at(body)]);
}

Vec3 Layout::direction(const Vec3& v_L) {
  return specimen_from_ground().transpose() * v_L;
}

pugi::xml_node add_text(pugi::xml_node parent, const char* tag, const std::string& text) {
  pugi::xml_node node = parent.append_child(tag);
  if (!text.empty()) node.append_child(pugi::node_pcdata).set_value(text.c_str());
  return node;
}

pugi::xml_node add_number(pugi::xml_node parent, const char* tag, double value) {
  return add_text(parent, tag, to_text(value));
}

pugi::xml_node add_vec3(pugi::xml_node parent, const char* tag, const Vec3& v) {
  return add_text(parent, tag, to_text(v.x()) + " " + to_text(v.y()) + " " + to_text(v.z()));
}

pugi::xml_node add_named(pugi::xml_node parent, const char* tag, const std::string& name) {
  pugi::xml_node node = parent.append_child(tag);
  node.append_attribute("name").set_value(name.c_str());
  return node;
}

pugi::xml_node add_set(pugi::xml_node parent, const char* tag) {
  return parent.append_child(tag).append_child("objects");
}

std::vector<std::string> coordinate_names(const anatomy::Joint& joint) {
  static constexpr const char* kMotions[] = {"_flexion", "_abduction", "_rotation"};
  std::vector<std::string> names;
  for (std::size_t i = 0; i < joint.axes.size(); ++i) names.push_back(joint.key + kMotions[i]);
  return names;
}

Model write_model(const anatomy::Specimen& specimen, const std::string& geometry_folder) {
  if (const std::string defect = anatomy::find_defect(specimen); !defect.empty()) {
    throw bad_data("specimen", specimen.name, defect);
  }
  const Layout layout(specimen);
  pugi::xml_document xml;
  pugi::xml_node declaration = xml.append_child(pugi::node_declaration);
  declaration.append_attribute("version").set_value("1.0");
  declaration.append_attribute("encoding").set_value("UTF-8");
  pugi::xml_node root = xml.append_child("OpenSimDocument");
  root.append_attribute("Version").set_value(kVersion);
  pugi::xml_node model = add_named(root, "Model", specimen.name);
  pugi::xml_node ground = add_named(model, "Ground", "ground");
  if (layout.ground() >= 0) {
    write_bones(layout, layout.ground(), geometry_folder, ground);
    write_wraps(layout, layout.ground(), ground);
  }
  add_vec3(model, "gravity", {0.0, -9.80665, 0.0});
  add_text(model, "credits", specimen.source);
  add_text(model, "length_units", "meters");
  add_text(model, "force_units", "N");
  pugi::xml_node bodies = add_set(model, "BodySet"), joints = add_set(model, "JointSet"),
                 forces = add_set(model, "ForceSet");
  for (int b = 0; b < static_cast<int>(specimen.bodies.size()); ++b) {
    if (b == layout.ground()) continue;
    write_body(layout, b, geometry_folder, bodies);
    if (layout.joint_above(b) < 0) write_root(layout, b, joints);
  }
  for (const anatomy::Joint& joint : specimen.joints) write_joint(layout, joint, joints);
  write_muscles(layout, forces);
  for (const anatomy::Joint& joint : specimen.joints) write_springs(joint, forces);
  std::ostringstream text;
  xml.save(text, "\t", pugi::format_default, pugi::encoding_utf8);
  Model made{text.str(), {}};
  for (const anatomy::Bone& bone : specimen.bones) {
    made.geometry.emplace_back(geometry_folder + "/" + bone.key + ".obj", obj_text(layout, bone));
  }
  return made;
}

void save_model(const anatomy::Specimen& specimen, const std::filesystem::path& file) {
  const std::string folder = file.stem().string() + "_geometry";
  const Model model = write_model(specimen, folder);
  if (!model.geometry.empty()) make_writable_folder(file.parent_path() / folder);
  for (const auto& [name, bytes] : model.geometry) write_file(file.parent_path() / name, bytes);
  write_file(file, model.osim);
}

}  // namespace myotact::exchange::opensim

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/at.h"
#include "core/text.h"
#include "exchange/opensim_reader.h"

namespace myotact::exchange::opensim {
namespace {

using geometry::WrapShape;

Vec3 quadrant_of(const Element& element) {
  const auto quadrant = element.find("quadrant");
  const std::string word = quadrant ? lower(quadrant->text()) : "all";
  if (word.empty() || word == "all" || word == "unassigned") return Vec3::Zero();
  const std::string axis =
      word.substr(word.find_first_not_of("+-") == std::string::npos ? 0 : word.find_first_not_of("+-"));
  const double sign = word.front() == '-' ? -1.0 : 1.0;
  if (axis == "x") return sign * Vec3::UnitX();
  if (axis == "y") return sign * Vec3::UnitY();
  if (axis == "z") return sign * Vec3::UnitZ();
  throw quadrant->error(fmt::format("is \"{}\"; must be all, x, -x, y, -y, z or -z", word.substr(0, 20)));
}

/// Its radii and length; false where it is of no shape that a specimen has.
bool read_shape(const Element& element, WrapObject& wrap) {
  const std::string tag = element.tag();
  if (tag == "WrapCylinder") {
    wrap.shape = WrapShape::Cylinder;
    wrap.radii_m.setConstant(element.number("radius"));
    wrap.length_m = element.number_or("length", 1.0);
    return true;
  }
  if (tag == "WrapSphere") {
    wrap.shape = WrapShape::Sphere;
    wrap.radii_m.setConstant(element.number("radius"));
    return true;
  }
  if (tag == "WrapEllipsoid") {
    wrap.shape = WrapShape::Ellipsoid;
    wrap.radii_m = element.vec3_or("dimensions", Vec3::Zero());
    return true;
  }
  return false;
}

void read_wraps(const Element& element, int body, RawModel& raw) {
  for (const Element& object : element.objects("WrapObjectSet")) {
    if (raw.wraps.size() >= kMostWraps) throw object.error(fmt::format("is one of more than {}", kMostWraps));
    WrapObject wrap{object.name(), body, {}, {}, Vec3::Zero(), 0.0, Vec3::Zero(), object};
    if (!read_shape(object, wrap)) {
      object.tell("a specimen's lines go round cylinders, spheres and ellipsoids only");
      continue;
    }
    object.take();
    if (!object.flag_or("active", true)) {
      object.tell("is not active");
      continue;
    }
    wrap.X_BW = read_offset(object, "translation", "xyz_body_rotation");
    wrap.quadrant = quadrant_of(object);
    raw.wraps.push_back(wrap);
  }
}

void read_meshes(const Element& element, int body, const Pose& X_BM, RawModel& raw) {
  const auto shown = element.find("attached_geometry");
  if (!shown) return;
  for (const Element& mesh : shown->children()) {
    if (mesh.tag() != "Mesh") continue;
    mesh.take();
    raw.meshes.push_back(
        {body, X_BM, mesh.name(), mesh.text_or("mesh_file", ""), mesh.vec3_or("scale_factors", Vec3::Ones()), mesh});
    mesh.find("socket_frame");
  }
}

void read_frame_meshes(const Element& element, int body, RawModel& raw) {
  if (const auto parts = element.find("components")) {
    for (const Element& part : parts->children()) {
      if (part.tag() != "PhysicalOffsetFrame") continue;
      part.take();
      part.find("socket_parent");
      read_meshes(part, body, read_offset(part, "translation", "orientation"), raw);
    }
  }
}

Body read_body(const Element& element) {
  Body body;
  body.name = element.name();
  body.element = element;
  if (body.name.empty()) throw element.error("has no name; give it one");
  body.mass_kg = element.number("mass");
  body.com_m = element.vec3_or("mass_center", Vec3::Zero());
  const Element inertia = element.at("inertia");
  const std::vector<double> values = inertia.numbers();
  if (values.size() != 6) {
    throw inertia.error(fmt::format("holds {} numbers; must be six: xx yy zz xy xz yz", values.size()));
  }
  std::copy(values.begin(), values.end(), body.inertia_kg_m2.begin());
  return body;
}

}  // namespace

std::string last_part(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

Mat3 rotation_of(const Vec3& xyz_rad) {
  using Eigen::AngleAxisd;
  return (AngleAxisd(xyz_rad.x(), Vec3::UnitX()) * AngleAxisd(xyz_rad.y(), Vec3::UnitY()) *
          AngleAxisd(xyz_rad.z(), Vec3::UnitZ()))
      .toRotationMatrix();
}

// R = Rx Ry Rz: the first row is (cy cz, -cy sz, sy), the last column (sy, -sx cy, cx cy).
Vec3 xyz_of(const Mat3& r) {
  const double cosine = std::hypot(r(0, 0), r(0, 1));
  constexpr double kLock = 1e-12;  // y at 90 degrees: x and z turn alike
  if (cosine < kLock) return {std::atan2(r(2, 1), r(1, 1)), std::atan2(r(0, 2), cosine), 0.0};
  return {std::atan2(-r(1, 2), r(2, 2)), std::atan2(r(0, 2), cosine), std::atan2(-r(0, 1), r(0, 0))};
}

Pose read_offset(const Element& element, const char* translation, const char* rotation) {
  return {rotation_of(element.vec3_or(rotation, Vec3::Zero())), element.vec3_or(translation, Vec3::Zero())};
}

void read_bodies(const Element& model, RawModel& raw) {
  Body ground;
  ground.name = "ground";
  raw.bodies.push_back(ground);
  if (const auto element = model.find("Ground")) {
    read_wraps(*element, 0, raw);
    read_meshes(*element, 0, {}, raw);
    read_frame_meshes(*element, 0, raw);
  }
  for (const Element& element : model.objects("BodySet")) {
    if (element.tag() != "Body") continue;
    element.take();
    const int index = static_cast<int>(raw.bodies.size());
    if (raw.bodies.size() > kMostBodies) throw element.error(fmt::format("is one of more than {} bodies", kMostBodies));
    Body body = read_body(element);
    const auto twin =
        std::find_if(raw.bodies.begin(), raw.bodies.end(), [&](const Body& b) { return b.name == body.name; });
    if (twin != raw.bodies.end()) throw element.error("has the name of another body; give each its own");
    raw.bodies.push_back(body);
    read_wraps(element, index, raw);
    read_meshes(element, index, {}, raw);
    read_frame_meshes(element, index, raw);
  }
}

int Names::find_body(const std::string& name) const {
  const auto found =
      std::find_if(model_.bodies.begin(), model_.bodies.end(), [&](const Body& b) { return b.name == name; });
  return found == model_.bodies.end() ? -1 : static_cast<int>(found - model_.bodies.begin());
}

const Frame* Names::find_frame(const std::string& name, const std::string& owner) const {
  const auto found = std::find_if(frames_.begin(), frames_.end(), [&](const Frame& frame) {
    return frame.name == name && (owner.empty() || frame.owner == owner);
  });
  return found == frames_.end() ? nullptr : &*found;
}

OnBody Names::resolve(const std::string& path, const std::string& owner, const Element& user) const {
  constexpr int kMostFrames = 16;  // on top of each other
  std::string next = path, owned_by = owner;
  Pose X;
  for (int depth = 0; depth < kMostFrames; ++depth) {
    const std::string name = last_part(next);
    const std::string above = next.size() > name.size() ? last_part(next.substr(0, next.size() - name.size() - 1)) : "";
    const bool of_bodies = above == "bodyset";
    const Frame* frame = nullptr;
    if (!of_bodies && !owned_by.empty()) frame = find_frame(name, owned_by);
    if (frame == nullptr && !of_bodies && !above.empty() && above != "..") frame = find_frame(name, above);
    if (frame == nullptr) {
      if (const int body = find_body(name); body >= 0) return {body, X};
      frame = find_frame(name, "");
    }
    if (frame == nullptr) {
      std::vector<std::string> known;
      for (const Body& body : model_.bodies) known.push_back(body.name);
      throw user.error(fmt::format("names \"{}\", which is no body and no frame of the model; the nearest is \"{}\"",
                                   path.substr(0, 80), nearest_word(name, known)));
    }
    X = frame->X_PF * X;
    next = frame->parent;
    owned_by = frame->owner;
  }
  throw user.error(
      fmt::format("names \"{}\", which hangs on frames that hang on each other; cut the ring", path.substr(0, 80)));
}

int Names::wrap_object(const std::string& path, const Element& user) const {
  const std::string name = last_part(path);
  std::vector<std::string> known;
  for (std::size_t i = 0; i < model_.wraps.size(); ++i) {
    if (model_.wraps[i].name == name) return static_cast<int>(i);
    known.push_back(model_.wraps[i].name);
  }
  const std::string nearest = nearest_word(name, known);
  throw user.error(fmt::format("names the wrap object \"{}\", which no body has{}", path.substr(0, 80),
                               nearest.empty() ? "" : "; the nearest is \"" + nearest + "\""));
}

RawModel read_raw_model(Document& document) {
  const Element model = document.model();
  RawModel raw;
  raw.file = document.file();
  raw.name = model.name();
  raw.credits = model.text_or("credits", "");
  model.find("length_units");
  model.find("force_units");
  raw.gravity_m_s2 = model.vec3_or("gravity", Vec3::Zero());
  read_bodies(model, raw);
  Names names(raw);
  read_joints(model, names, raw);
  read_springs(model, raw);
  read_muscles(model, names, raw);
  return raw;
}

}  // namespace myotact::exchange::opensim

#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/pose.h"
#include "exchange/opensim_xml.h"
#include "geometry/wrap/wrap_path.h"

// A model as its file has it: OpenSim's own frames, axes and names. References are indices into the model's lists.

namespace myotact::exchange::opensim {

/// Of one coordinate: what the formats of OpenSim's functions come to.
struct Function {
  double slope = 0.0, constant = 0.0;            // where there are no knots
  std::vector<std::pair<double, double>> knots;  // rising; between them straight
  double scale = 1.0;

  bool is_line() const { return knots.empty(); }
  double at(double x) const;
  /// Largest minus smallest value over the range.
  double travel(const std::pair<double, double>& range) const;
};

struct Coordinate {
  std::string name;
  double default_value = 0.0;
  std::pair<double, double> range{-3.14159265358979312, 3.14159265358979312};  // OpenSim's own default is no limit
  std::string held;                                                            // why it does not move; empty: it does
};

/// Rotation about or translation along an axis of the parent's joint frame, after those before it.
struct Motion {
  Vec3 axis = Vec3::Zero();
  int coordinate = -1;  // of the joint; -1: constant
  Function function;
};

struct Joint {
  std::string name, type;
  int parent = -1, child = -1;  // bodies
  Pose X_PJ, X_CJ;              // the joint's frames in the bodies' own
  std::vector<Coordinate> coordinates;
  std::array<Motion, 3> rotations, translations;
  Element element;
};

struct Body {
  std::string name;
  double mass_kg = 0.0;
  Vec3 com_m = Vec3::Zero();
  std::array<double, 6> inertia_kg_m2{};  // xx yy zz xy xz yz
  std::optional<Element> element;         // none: the ground
};

struct Mesh {
  int body = -1;
  Pose X_BM;
  std::string name, file;
  Vec3 scale = Vec3::Ones();
  Element element;
};

struct WrapObject {
  std::string name;
  int body = -1;
  geometry::WrapShape shape = geometry::WrapShape::Cylinder;
  Pose X_BW;
  Vec3 radii_m = Vec3::Zero();
  double length_m = 0.0;         // of a cylinder
  Vec3 quadrant = Vec3::Zero();  // in its frame, unit; zero: any side
  Element element;
};

struct PathPoint {
  int body = -1;
  Pose X_BF;  // of the frame that it is given in
  Vec3 position_m = Vec3::Zero();
  struct Moving {
    std::string coordinate;
    Function function;
  };
  std::array<std::optional<Moving>, 3> moving;  // of x, y and z
  struct Condition {
    std::string coordinate;
    std::pair<double, double> range;
  };
  std::optional<Condition> condition;
  Element element;
};

struct PathWrap {
  int object = -1;
  int first = 0, last = -1;  // points of the path between which it may wrap; last -1: the last one
  Element element;
};

struct Muscle {
  std::string name, type;
  double peak_force_N = 0.0, optimal_fibre_m = 0.0, tendon_slack_m = 0.0, pennation_rad = 0.0;
  double activation_tau_s = 0.0, deactivation_tau_s = 0.0;
  std::vector<PathPoint> points;
  std::vector<PathWrap> wraps;
  Element element;
};

/// A spring about a coordinate.
struct Spring {
  std::string coordinate;
  double stiffness = 0.0, rest = 0.0, viscosity = 0.0;
  Element element;
};

struct RawModel {
  std::string file, name, credits;
  Vec3 gravity_m_s2 = Vec3::Zero();
  std::vector<Body> bodies;  // the first is the ground
  std::vector<Joint> joints;
  std::vector<Mesh> meshes;
  std::vector<WrapObject> wraps;
  std::vector<Muscle> muscles;
  std::vector<Spring> springs;
};

/// Rotations about x, y and z, each about the axes as the ones before it left them.
Mat3 rotation_of(const Vec3& xyz_rad);
/// The inverse of rotation_of().
Vec3 xyz_of(const Mat3& rotation);

/// Throws Error BadData naming file, line, value and remedy.
RawModel read_raw_model(Document& document);

}  // namespace myotact::exchange::opensim

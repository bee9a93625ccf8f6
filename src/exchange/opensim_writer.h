#pragma once

#include <string>
#include <vector>

#include <pugixml.hpp>

#include "anatomy/specimen.h"

// The parts of write_model().

namespace myotact::exchange::opensim {

/// Where the specimen's parts stand in the model: every body's frame is turned as OpenSim's ground is, with its origin
/// in the centre of the joint that carries it.
class Layout {
 public:
  explicit Layout(const anatomy::Specimen& specimen);

  const anatomy::Specimen& specimen() const { return specimen_; }
  /// The body that is the model's ground; -1: none.
  int ground() const { return ground_; }
  /// Index of the joint that carries the body, or -1.
  int joint_above(int body) const { return joint_above_[static_cast<std::size_t>(body)]; }
  /// Path of the body's frame.
  std::string path(int body) const;
  Vec3 in_body(int body, const Vec3& p_L) const;
  static Vec3 direction(const Vec3& v_L);

 private:
  const anatomy::Specimen& specimen_;
  std::vector<int> joint_above_;
  std::vector<Vec3> origins_L_;
  int ground_ = -1;
};

pugi::xml_node add_text(pugi::xml_node parent, const char* tag, const std::string& text);
pugi::xml_node add_number(pugi::xml_node parent, const char* tag, double value);
pugi::xml_node add_vec3(pugi::xml_node parent, const char* tag, const Vec3& v);
pugi::xml_node add_named(pugi::xml_node parent, const char* tag, const std::string& name);
/// PARENT/TAG/objects.
pugi::xml_node add_set(pugi::xml_node parent, const char* tag);

/// Names of the coordinates about the joint's axes.
std::vector<std::string> coordinate_names(const anatomy::Joint& joint);

/// Muscles with their paths, into the model's ForceSet.
void write_muscles(const Layout& layout, pugi::xml_node forces);
/// The surfaces of a body round which lines go, into its WrapObjectSet.
void write_wraps(const Layout& layout, int body, pugi::xml_node parent);

}  // namespace myotact::exchange::opensim

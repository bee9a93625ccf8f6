#pragma once

#include <map>
#include <string>
#include <vector>

#include "exchange/opensim_model.h"

// The parts of read_raw_model().

namespace myotact::exchange::opensim {

/// More of one kind is no model of a limb, and would take for ever.
inline constexpr std::size_t kMostBodies = 1000, kMostMuscles = 2000, kMostPoints = 200, kMostWraps = 2000;

/// A frame that is fixed to a body at some place.
struct Frame {
  std::string name, owner;  // the joint in which it stands; empty: the model
  std::string parent;       // path of the frame that it is given in
  Pose X_PF;
  Element element;
};

/// Where a path to a frame leads.
struct OnBody {
  int body = -1;
  Pose X_BF;
};

/// Looks names up while a model is read.
class Names {
 public:
  explicit Names(const RawModel& model) : model_(model) {}
  void add(Frame frame) { frames_.push_back(std::move(frame)); }

  /// `path` as the sockets of `user` name frames: "/bodyset/femur", "femur_offset" of the joint `owner`. Throws Error
  /// BadData where nothing has that name, or frames hang on each other in a ring.
  OnBody resolve(const std::string& path, const std::string& owner, const Element& user) const;
  /// Index of the object, by its name or a path to it. Throws Error BadData.
  int wrap_object(const std::string& path, const Element& user) const;

 private:
  const Frame* find_frame(const std::string& name, const std::string& owner) const;
  int find_body(const std::string& name) const;

  const RawModel& model_;
  std::vector<Frame> frames_;
};

/// The last part of a path.
std::string last_part(const std::string& path);
Pose read_offset(const Element& element, const char* translation, const char* rotation);
/// The function that stands in an element, or nothing where it is of a kind that is not read.
std::optional<Function> read_function(const Element& holder);
/// The element as such a function.
std::optional<Function> as_function(const Element& element);

void read_bodies(const Element& model, RawModel& raw);
void read_joints(const Element& model, Names& names, RawModel& raw);
void read_springs(const Element& model, RawModel& raw);
void read_muscles(const Element& model, const Names& names, RawModel& raw);

}  // namespace myotact::exchange::opensim

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/vector.h"

// What a person marked in 3D Slicer, and what that says of a limb. README.md lists the names that mean something.

namespace myotact::prepare {

enum class MarkupKind { Points, Line, Curve };

struct MarkupPoint {
  std::string label;
  Vec3 position_m = Vec3::Zero();  // LPS as read; place() takes it elsewhere
};

struct Markup {
  MarkupKind kind = MarkupKind::Points;
  std::string file;  // for messages
  std::string name;  // the file's name without .mrk.json: Slicer keeps a node's name nowhere else
  std::vector<MarkupPoint> points;
};

/// Reads a .mrk.json. Lengths become metres, RAS becomes LPS. Angles, planes and boxes are left out, with a note.
/// Throws Error NoInput, or BadData naming file, JSON pointer, value and remedy.
std::vector<Markup> read_markups(const std::filesystem::path& file, std::vector<std::string>& notes);

/// Turns all points by `rotation` (specimen_from_lps() for those of a label volume).
void place(std::vector<Markup>& markups, const Mat3& rotation);

/// A hinge: the axis goes from the first point to the second, and a right-hand rotation of the child about it flexes.
struct MarkedJoint {
  std::string key;
  int parent = -1, child = -1;  // bones; -1: to be told from the place
  std::array<Vec3, 2> axis_m{Vec3::Zero(), Vec3::Zero()};
};

/// Places or a line of one muscle.
struct MarkedMuscle {
  int muscle = -1;
  std::vector<Vec3> points_m;
};

struct LimbMarks {
  std::vector<MarkedJoint> joints;
  std::vector<MarkedMuscle> origins, insertions;  // a point each
  std::vector<MarkedMuscle> lines;                // from end to end, two points or more
};

/// Which part each markup speaks of. Throws Error BadData naming file and name, and the nearest that would be
/// understood, for one whose words are not known or that has too few points.
LimbMarks understand_markups(const std::vector<Markup>& markups, const std::vector<std::string>& bone_keys,
                             const std::vector<std::string>& muscle_keys);

}  // namespace myotact::prepare

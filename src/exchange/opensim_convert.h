#pragma once

#include <map>
#include <string>
#include <vector>

#include "exchange/opensim_model.h"

// From OpenSim's frames to a specimen at one pose of the coordinates. Bodies of the specimen are those of the model, in
// the same order, the ground first.

namespace myotact::exchange::opensim {

/// Every coordinate's value, by its name.
using PoseValues = std::map<std::string, double>;

struct Placed {
  anatomy::Specimen specimen;  // bodies and joints; then muscles and lines
  std::vector<Pose> X_LB;      // of the model's bodies
  std::vector<CoordinateTaken> coordinates;
  PoseValues pose;
};

/// A specimen's frame from OpenSim's ground: x as it is, y to the left, z up.
Mat3 specimen_from_ground();

/// Lower case; what is no letter or digit becomes "_"; another than those in `used`, to which it is added.
std::string key_of(const std::string& name, std::vector<std::string>& used);

/// The pose that the model has at 0, with coordinates that cannot be 0 or are held at their defaults; or all at those.
PoseValues file_pose(const RawModel& raw, bool at_defaults);
/// Throws Error BadData where joints form a ring or none hangs on the ground.
Placed place_skeleton(const RawModel& raw, const PoseValues& pose);
/// Muscles and lines, added to `placed`. The elements of what cannot be taken bear the reason. Returns how many muscles
/// there are at which the pose itself is at fault; with `tells` false nothing is told.
int add_muscles(const RawModel& raw, bool tells, Placed& placed);

/// The path's wraps as those of the line's segments, as far as a specimen can have them; the others are told.
/// `points[i]` is the index in the line of point i of the path, or that of the one before it.
void add_wraps(const RawModel& raw, const Muscle& muscle, const std::vector<int>& points, const Placed& placed,
               anatomy::MuscleLine& line);

/// Gives the muscle a spindle of tets along its line, so that it can be seen and touched: as thick as its force and
/// fibre length make it. Where the
/// line folds back on itself it is straight from end to end; false where these are one place.
bool draw_spindle(const anatomy::MuscleLine& line, anatomy::Muscle& muscle);

/// Groups of the muscles that flex and extend each hinge, by their moment arms at the middle of its range.
void add_groups(anatomy::Specimen& specimen);

}  // namespace myotact::exchange::opensim

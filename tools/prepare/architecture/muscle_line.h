#pragma once

#include <string>
#include <vector>

#include "anatomy/specimen.h"
#include "core/vector.h"
#include "prepare/architecture/attachment_patch.h"
#include "prepare/architecture/sections.h"
#include "prepare/recipe/anatomy_data.h"

namespace myotact::prepare {

/// The skeleton that a line is hung on.
struct LineBones {
  const std::vector<anatomy::Body>& bodies;
  const std::vector<anatomy::Joint>& joints;
  int origin_body = -1;
  int insertion_body = -1;
};

/// Joints between two bodies, from the first to the second. Throws Error BadData when there is no way.
std::vector<int> joints_between(const std::string& name, const LineBones& bones);

/// What is known of a line: its ends, on bone, how it passes joints, and the middle of the muscle where it was
/// measured.
struct LineGuide {
  Vec3 origin_m = Vec3::Zero();
  Vec3 insertion_m = Vec3::Zero();
  std::vector<CrossingData> crossings = {};
  std::vector<Vec3> middle_m = {};  // from the origin; empty: the profile's, which a coarse cage moves by millimetres
};

/// A line through the middle of the muscle: origin, borders of the belly, points between, insertion; 4 to 8 points, and
/// up to two more a joint.
/// A point rides on the body before a joint until the line has passed its axis. Near an axis there is none, so that the
/// part of the line that changes length is long against the uncertainty of the axis; where the guide says how the line
/// crosses a joint, there is none between the two points of the crossing; else two points beside the axis hold a
/// tendon that would be a bowstring. `muscle` is left at -1. Throws Error BadData for a crossing of a joint that is not
/// on the way.
anatomy::MuscleLine trace_line(const std::string& name, const MuscleProfile& profile, const BellySpan& belly,
                               const LineGuide& guide, const LineBones& bones);

/// Puts the surfaces on the segments of the line that cross their joints; where no side is given, it is the one on
/// which the line passes the axis. Throws Error BadData when the line does not cross a joint or cannot clear a surface.
void add_wraps(const std::string& name, const std::vector<WrapData>& wraps, const LineBones& bones,
               anatomy::MuscleLine& line);

/// Moment arm of a unit pull along the line about a hinge, in the file pose, positive flexes [m]; 0 when it does not
/// cross. Round surfaces as they lie.
double moment_arm_m(const anatomy::MuscleLine& line, const anatomy::Joint& joint, const LineBones& bones);

}  // namespace myotact::prepare

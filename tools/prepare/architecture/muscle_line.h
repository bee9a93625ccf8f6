#pragma once

#include <string>
#include <vector>

#include "anatomy/specimen.h"
#include "core/vector.h"
#include "prepare/architecture/attachment_patch.h"
#include "prepare/architecture/sections.h"

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

/// Ends of a line, on bone.
struct LineEnds {
  Vec3 origin_m = Vec3::Zero();
  Vec3 insertion_m = Vec3::Zero();
};

/// A line through the middle of the muscle: origin, borders of the belly, points between, insertion; 4 to 8 points.
/// A point rides on the body before a joint until the line has passed its axis. Near an axis there is none, so that the
/// part of the line that changes length is long against the uncertainty of the axis. `muscle` is left at -1.
anatomy::MuscleLine trace_line(const std::string& name, const MuscleProfile& profile, const BellySpan& belly,
                               const LineEnds& ends, const LineBones& bones);

/// Lever of a unit pull along the line about a hinge, in the file pose, positive flexes [m]; 0 when it does not cross.
double moment_arm_m(const anatomy::MuscleLine& line, const anatomy::Joint& joint, const LineBones& bones);

}  // namespace myotact::prepare

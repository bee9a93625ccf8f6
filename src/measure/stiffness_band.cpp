#include "measure/stiffness_band.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <Eigen/Geometry>
#include <fmt/format.h>

namespace myotact::measure {

namespace {

/// Puts one measure of a copy of the limb off by `sign` times its uncertainty.
using Change = std::function<void(LineLimb& limb, double sign)>;

struct Cause {
  std::string name;
  std::vector<Change> changes;  // one a direction
};

anatomy::Joint& joint_of(LineLimb& limb) {
  return limb.specimen.joints[static_cast<std::size_t>(limb.set.joint)];
}

/// Everything that is not known better. Two unit vectors across the axis span what moves it.
std::vector<Cause> causes_of(const LineLimb& limb) {
  const anatomy::Joint& joint = limb.specimen.joints[static_cast<std::size_t>(limb.set.joint)];
  const Vec3 across = joint.axes[0].unitOrthogonal();
  std::vector<Cause> causes = {{"joint centre", {}}, {"joint axis", {}}, {"peak force", {}}, {"rest stretch", {}}};
  for (const Vec3& direction : {across, Vec3(joint.axes[0].cross(across))}) {
    causes[0].changes.push_back([direction](LineLimb& changed, double sign) {
      joint_of(changed).centre_m += sign * joint_of(changed).centre_uncertainty_m * direction;
    });
    causes[1].changes.push_back([direction](LineLimb& changed, double sign) {
      anatomy::Joint& rotated = joint_of(changed);
      rotated.axes[0] = Eigen::AngleAxisd(sign * rotated.axis_uncertainty_rad, direction) * rotated.axes[0];
    });
  }
  causes[2].changes.push_back([](LineLimb& changed, double sign) {
    for (const int m : changed.set.flexors) {
      changed.specimen.muscles[static_cast<std::size_t>(m)].peak_force_N *= 1.0 + sign * kPeakForceUncertainty;
    }
  });
  causes[3].changes.push_back([](LineLimb& changed, double sign) {
    for (anatomy::Muscle& muscle : changed.specimen.muscles) muscle.rest_stretch += sign * kRestStretchUncertainty;
  });
  if (!(joint.axis_uncertainty_rad > 0.0)) causes.erase(causes.begin() + 1);
  if (!(joint.centre_uncertainty_m > 0.0)) causes.erase(causes.begin());
  return causes;
}

}  // namespace

std::vector<BandPart> stiffness_band(const LineLimb& limb, std::span<const double> angles_rad, double common) {
  const double plain_Nm_rad = balanced_line_stiffness_Nm_rad(limb, angles_rad, common);
  std::vector<BandPart> parts;
  for (const Cause& cause : causes_of(limb)) {
    std::vector<BandPart> ways;
    for (const Change& change : cause.changes) {
      BandPart& way = ways.emplace_back();
      for (const double sign : {-1.0, 1.0}) {
        LineLimb changed = limb;
        change(changed, sign);
        const double off_Nm_rad = balanced_line_stiffness_Nm_rad(changed, angles_rad, common) - plain_Nm_rad;
        way.up_Nm_rad = std::max(way.up_Nm_rad, off_Nm_rad);
        way.down_Nm_rad = std::max(way.down_Nm_rad, -off_Nm_rad);
      }
    }
    parts.push_back(whole_band(ways));
    parts.back().cause = cause.name;
  }
  return parts;
}

BandPart whole_band(const std::vector<BandPart>& parts) {
  double down = 0.0, up = 0.0;
  for (const BandPart& part : parts) {
    down += part.down_Nm_rad * part.down_Nm_rad;
    up += part.up_Nm_rad * part.up_Nm_rad;
  }
  return {"", std::sqrt(down), std::sqrt(up)};
}

std::string missing_uncertainty(const anatomy::Joint& joint) {
  std::string missing;
  if (!(joint.centre_uncertainty_m > 0.0)) missing = "centre_uncertainty_m";
  if (!(joint.axis_uncertainty_rad > 0.0))
    missing += missing.empty() ? "axis_uncertainty_rad" : ", axis_uncertainty_rad";
  if (missing.empty()) return "";
  return fmt::format("the specimen gives 0 as {} of the joint {}: the band of K leaves it out and is too narrow",
                     missing, joint.key);
}

}  // namespace myotact::measure

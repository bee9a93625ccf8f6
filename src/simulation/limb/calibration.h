#pragma once

#include "simulation/limb/limb.h"

namespace myotact::simulation {

/// How well a muscle's tissue agrees with its line at the file pose, half active: both 1 when it agrees. NaN when no
/// static solve came to rest.
struct LineAgreement {
  double force = 0.0;      // isometric tension, excited at rest, over the line's force
  double stiffness = 0.0;  // dF/dL by rotating a joint, over the line's; 1 when no joint changes the line's length
};

/// Fingerprint of what a muscle's calibration depends on in the specimen: its mesh, fibres and figures, its line, its
/// groups, and the joints; `on_bones`: the bones, too. FNV-1a over their bits.
std::uint64_t calibration_fingerprint(const anatomy::Specimen& specimen, int muscle, bool on_bones = false);

/// Puts the fibres as a calibration left them. `fit`: of this muscle, by its fingerprint.
void apply_fit(const anatomy::FibreFit& fit, FibreMap& map);

/// Adjusts the fibres so that the muscle as a whole does what its line does (one muscle, one mechanics). A curved belly
/// straightens when it pulls and soft ends give way, so the fibres shorten on the isometric muscle; the offset returns
/// their mean length to rest_stretch, the scale of the peak stress returns the force, and the gain the slope dF/dL.
/// Where the force cannot be had with the slope, the force alone. The slope is that with the joint at which the
/// specimen groups the muscle, else with the one that changes its line most. Leaves the muscle as it was when the
/// tissue agrees already or cannot be brought nearer, and always at rest. `index`: of the muscle in the specimen, a
/// soft one that has its line; `skeleton` is at the file pose. Returns the best agreement found. Costs some ten static
/// solves, 85 at most. Muscles may be calibrated by different threads at once.
LineAgreement calibrate_muscle(const anatomy::Specimen& specimen, int index, const Skeleton& skeleton,
                               LimbMuscle& muscle);

}  // namespace myotact::simulation

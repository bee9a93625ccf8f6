#pragma once

#include <span>

#include "scene/co_contraction.h"

namespace myotact::scene {

/// A torque table for another posture than the one it was measured in: each muscle's torque changes by as much as that
/// of its line, which costs no static solve, so that a person may take up a posture and hold it at once. Angles: one a
/// joint.
TorqueTable rotated_torques(const TorqueTable& table, const Scene& scene, std::span<const double> measured_rad,
                            std::span<const double> wanted_rad);

}  // namespace myotact::scene

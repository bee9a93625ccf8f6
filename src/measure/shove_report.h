#pragma once

#include <string>

#include "measure/joint_response.h"
#include "scene/shove_test.h"

namespace myotact::measure {

/// What a shove test shows of a joint, measured beside what its stiffness, damping and inertia predict.
struct ShoveReport {
  double pushed_stiffness_Nm_rad = 0.0;  // torque of the slow push over the angle it gave
  double read_stiffness_Nm_rad = 0.0;    // as the joint was read out before, gravity and passive joint included
  double undamped_frequency_hz = 0.0;    // sqrt(K/I)/2pi; 0 where K < 0
  JointMode mode;                        // of the linear response
  double measured_frequency_hz = 0.0;    // from the swing's passes through rest; 0: fewer than two
  double swing_error = 0.0;              // largest difference from the linear response, over the swing's largest
  std::string why;                       // it rings, or does not: one sentence
};

/// The record must be of a test that came to its end.
ShoveReport report_shove(const scene::ShoveRecord& record);

/// Whether the joint comes back, and rings: the report's `why`, of its other figures.
std::string shove_reason(const ShoveReport& report);

/// The report in a few lines for a person.
std::string shove_text(const ShoveReport& report);

}  // namespace myotact::measure

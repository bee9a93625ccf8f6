#pragma once

#include <string>

namespace myotact::view {

/// What is known about the stiffness of the joint on show, refreshed a few times a second.
struct JointReadings {
  double K_low_Nm_rad = 0.0, K_high_Nm_rad = 0.0;  // within what the anatomy leaves open; both 0: not known
  std::string why;                                 // in words
  std::string shove;                               // outcome of the last shove test; empty: none yet
};

}  // namespace myotact::view

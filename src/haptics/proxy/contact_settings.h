#pragma once

namespace myotact::haptics {

/// How the tool feels against tissue.
struct ContactSettings {
  double radius_m = 3e-3;  // of the proxy sphere; 0: a point
  // Across the fibres, and everywhere on tissue without: wet fascia 0.05-0.3, skin and hair coat 0.3-0.8
  // (general knowledge, not measured here)
  double static_friction = 0.3;
  double dynamic_friction = 0.3;   // <= static_friction
  double stribeck_m_s = 0.01;      // speed at which friction is about half way down to dynamic, > 0 (0.005-0.02)
  double along_over_across = 1.0;  // friction along the fibres over across them, 0.2 .. 5
  double viscous_Ns_m = 0.0;       // more friction per speed of slip, whatever the pressure, >= 0
  double stiffness_N_m = 800.0;    // of the coupling between device and proxy; bounded by device and tick rate
  double damping_Ns_m = 1.0;       // against the tissue, while the tool goes into it (own choice)
};

}  // namespace myotact::haptics

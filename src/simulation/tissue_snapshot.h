#pragma once

#include <vector>

#include "core/vector.h"
#include "geometry/tet_mesh.h"

namespace myotact::simulation {

/// The tets of one muscle after the last step or settle, for files. World frame; NaN where nothing solves for it.
struct TissueSnapshot {
  geometry::TetMesh rest;            // at the file pose: quadratic, but for mass-spring muscles; straight-sided
  std::vector<Vec3> position_m;      // one a node
  std::vector<Vec3> velocity_m_s;    // one a node; NaN of a muscle that follows bones or sleeps
  std::vector<Vec3> fibre;           // one a tet: unit, along the fibres now
  std::vector<double> stretch;       // one a tet: of the fibre, length now over that at the file pose; mean
  std::vector<double> volume_ratio;  // one a tet: now over rest
  std::vector<double> fibre_Pa;      // one a tet: nominal stress of the fibres, active and passive, mean; without the
                                     // damping of their speed; NaN without finite elements, as below
  std::vector<Mat3> cauchy_Pa;       // one a tet: of matrix and fibres, mean
};

/// What the tets of one muscle are made of and what holds them, as they are after the last step or settle. The muscle
/// need not be one of finite elements: it is then what it would be as such, with fibres that nothing calibrated and
/// that are on average as long as its line has them.
struct TissueMechanics {
  geometry::TetMesh rest;       // quadratic
  std::vector<int> body;        // one a node: that clamps it, or -1
  std::vector<bool> sheath;     // one a tet: of a tendon, else belly
  std::vector<double> peak_Pa;  // one a tet: of its fibres, calibrated; 0: none
  double active = 1.0;          // active force over the peak at stretch 1, the mean length held (fibre_field.h)
  double active_slope = 0.0;    // of it against the stretch
  double passive_length = 0.8;  // n at stretch 1, as passive force has it
  double gain = 1.0;            // dn / d(stretch)
  std::vector<bool> on_string;  // one a node: a tendon's string pulls at it
  double activation = 0.0;      // 0 .. 1
};

}  // namespace myotact::simulation

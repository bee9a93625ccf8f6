#pragma once

#include "simulation/material/stable_neo_hookean.h"

namespace myotact::simulation {

/// Matrix of a soft tissue, on quadratic tets with the volume term on the mean volume ratio.
struct TissueMaterial {
  StableNeoHookean matrix;      // shear and volume term
  double fluctuation_Pa = 0.0;  // c of 1/2 c (J - mean J)^2; without it the points inside a tet fold over
  double density_kg_m3 = 0.0;
};

/// Bulk modulus of all soft tissue [Pa]: keeps the volume within 1 % under 300 kPa of active stress, while a direct
/// solver still copes with it. Water would be 2.2 GPa.
inline constexpr double kBulk_Pa = 3e6;

/// Passive skeletal muscle across the fibres: mu of 5 .. 20 kPa is reported, most elastography of resting muscle finds
/// 3 .. 10 kPa. At 20 kPa the matrix alone would be stiffer along a slender muscle than its passive fibres. c: below 50
/// kPa single points jitter at this mu. Density: Mendez and Keys 1960.
inline constexpr TissueMaterial kMuscleMatrix{{10e3, kBulk_Pa - 2.0 / 3.0 * 10e3}, 50e3, 1060.0};

/// Sheath around a tendon strand: soft enough not to carry the load that the strand carries (at 200 kPa the sheaths
/// added more than the muscles to the stiffness of a relaxed elbow), stiff enough to follow it.
inline constexpr TissueMaterial kTendonSheath{{40e3, kBulk_Pa - 2.0 / 3.0 * 40e3}, 100e3, 1120.0};

/// Added to c per pascal of active stress: an active element needs it near clamped ends, where points fold over first.
inline constexpr double kActiveFluctuation = 0.2;

}  // namespace myotact::simulation

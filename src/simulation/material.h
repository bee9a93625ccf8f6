#pragma once

namespace myotact::simulation {

/// Isotropic matrix of a soft tissue: stable neo-Hookean law (Smith, de Goes, Kim 2018, log form) whose volume part
/// acts on the mean volume ratio of an element, plus 1/2 c (J - mean J)^2 at each integration point. The law of a
/// homogeneous state is the plain stable neo-Hookean one.
struct TissueMaterial {
  double shear_Pa = 0.0;        // mu, Lame
  double lambda_Pa = 0.0;       // first Lame parameter
  double fluctuation_Pa = 0.0;  // c; without it the points inside an element fold over
  double density_kg_m3 = 0.0;

  double shear_term_Pa() const { return 4.0 / 3.0 * shear_Pa; }               // m of the log form
  double volume_term_Pa() const { return lambda_Pa + 5.0 / 6.0 * shear_Pa; }  // L of the log form
  /// Volume ratio at which the volume term alone would rest, so that the whole law rests at J = 1.
  double rest_ratio() const { return 1.0 + 0.75 * shear_term_Pa() / volume_term_Pa(); }
};

/// Bulk modulus of all soft tissue [Pa]: keeps the volume within 1 % under 300 kPa of active stress, while a direct
/// solver still bears it. Water would be 2.2 GPa.
inline constexpr double kBulk_Pa = 3e6;

/// Passive skeletal muscle across the fibres: mu of 5 .. 20 kPa is reported, most elastography of resting muscle finds
/// 3 .. 10 kPa. At 20 kPa the matrix alone would be stiffer along a slender muscle than its passive fibres. c: below 50
/// kPa single points jitter at this mu. Density: Mendez and Keys 1960.
inline constexpr TissueMaterial kMuscleMatrix{10e3, kBulk_Pa - 2.0 / 3.0 * 10e3, 50e3, 1060.0};

/// Sheath around a tendon strand: soft enough not to carry the load that the strand carries (at 200 kPa the sheaths
/// added more than the muscles to the stiffness of a relaxed elbow), stiff enough to follow it.
inline constexpr TissueMaterial kTendonSheath{40e3, kBulk_Pa - 2.0 / 3.0 * 40e3, 100e3, 1120.0};

/// Added to c per pascal of active stress: an active element needs it near clamped ends, where points fold over first.
inline constexpr double kActiveFluctuation = 0.2;

/// Shortest stretch at which fibre terms are evaluated; below, a fibre would divide by zero.
inline constexpr double kShortestStretch = 0.05;

}  // namespace myotact::simulation

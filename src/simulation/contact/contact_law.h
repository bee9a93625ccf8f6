#pragma once

namespace myotact::simulation {

/// What muscles of finite elements touch: nothing, bones alone, or bones and each other.
enum class Contact { None, Bones, All };

/// Pressure between two surfaces that overlap by s: a parabola, then a line, so that the force has a continuous slope.
///
///   p = k s^2 / (2 e)  for 0 <= s < e,   k (s - e / 2)  beyond
struct ContactLaw {
  double stiffness_Pa_m = 0.0;  // k
  double onset_m = 0.0;         // e
};

/// What the law gives at one overlap.
struct ContactPressure {
  double pressure_Pa = 0.0;
  double slope_Pa_m = 0.0;  // against the overlap
};

/// Zero for no overlap, and for NaN. Real-time safe.
inline ContactPressure contact_pressure(const ContactLaw& law, double overlap_m) {
  if (!(overlap_m > 0.0)) return {};
  if (overlap_m < law.onset_m) {
    const double slope = law.stiffness_Pa_m * overlap_m / law.onset_m;
    return {0.5 * slope * overlap_m, slope};
  }
  return {law.stiffness_Pa_m * (overlap_m - 0.5 * law.onset_m), law.stiffness_Pa_m};
}

/// Muscle on bone. 600 kPa (a belly at full tension around a bone as thick as itself) press it in by 0.4 mm, 100 kPa
/// (10 N on 1 cm^2) by 0.15 mm. A surface node of 10 mm^2 then holds 2e4 N/m, about what the bulk modulus gives its
/// element: stiffer would gain little and make the solve ill-conditioned.
inline constexpr ContactLaw kBoneContact{2e9, 0.2e-3};

/// Muscle on muscle: as soft as the tissue allows, because stiffer coupling costs iterations. 20 kPa, a relaxed muscle
/// squeezed by its neighbours, press it in by 0.28 mm, 100 kPa by 0.7 mm.
inline constexpr ContactLaw kTissueContact{2e8, 0.4e-3};

/// Loose connective tissue that holds what lies side by side at rest: a linear spring an area, softer than what keeps
/// the two from overlapping. All zero: none.
struct Fascia {
  double tension_Pa_m = 0.0;  // against being drawn apart, along the normal
  double shear_Pa_m = 0.0;    // against sliding, all directions alike; part of the tension above
  double reach_m = 0.0;       // surfaces closer than this at the file pose are held
};

/// The law between two surfaces that fascia holds: its tension in both directions, and contact's on top where they
/// overlap. Real-time safe.
inline ContactPressure held_pressure(const ContactLaw& law, double tension_Pa_m, double overlap_m) {
  const ContactPressure contact = contact_pressure(law, overlap_m);
  return {contact.pressure_Pa + tension_Pa_m * overlap_m, contact.slope_Pa_m + tension_Pa_m};
}

}  // namespace myotact::simulation

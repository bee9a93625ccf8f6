#pragma once

#include <string>
#include <vector>

#include "measure/solve_case.h"

// Our laws as FEBio's materials (FEBio User Manual 4.0) and, in febio_read_laws.h, the other way.
//
//   neo_hookean                                "neo-Hookean"                            exact
//   mooney_rivlin                              "Mooney-Rivlin"                          exact
//   stable_neo_hookean                         "hyperelastic" with its energy as text   exact
//   blemker_muscle, blemker_tendon             "muscle material", "tendon material"     exact
//   mooney_rivlin + isochoric_exponential_fibre [+ calcium_tension]
//                                              "trans iso Mooney-Rivlin"                exact; calcium: up to J
//   neo_hookean + exponential_fibre            "coupled trans-iso Mooney-Rivlin"        exact
//   fibre_tension, isotropic_tension           "prescribed ... active contraction"      exact
//   muscle_fibre, fibres of a posed muscle     two "active fiber stress" with tables    within 1e-3 of the peak
//   corotated                                  "neo-Hookean" of the same moduli         equal at rest only; told
//
// What stands together without a name of its own becomes a "solid mixture". All others have no like: they are refused.

namespace myotact::exchange {

/// A material as it stands in the file, and what a person should know of it.
struct FebioMaterial {
  std::string text;
  std::vector<std::string> notes;
};

/// `name`: unique in the file; `id` from 1. `activation` at full load, 0 .. 1; load curve 1 raises it. Throws Error
/// BadData for laws that FEBio has no like of.
FebioMaterial febio_material(const measure::CaseMaterial& material, const std::string& name, int id, double activation);

/// What such fibres are called there, so that they are found again: kind and numbers.
std::string febio_fibre_name(const simulation::MuscleFibre& fibre);
std::string febio_fibre_name(const simulation::PosedFibre& fibre);
/// T(stretch) / (peak stress) of FEBio's active fibres as a list of points: stretch times the nominal stress that full
/// activation adds (`active`), or that without any.
std::string febio_fibre_table(const simulation::MuscleFibre& fibre, bool active);
std::string febio_fibre_table(const simulation::PosedFibre& fibre, bool active);
/// W of a stable neo-Hookean solid in FEBio's words.
std::string febio_energy(const simulation::StableNeoHookean& matrix);

}  // namespace myotact::exchange

#pragma once

#include <variant>

#include "simulation/material/active_tension.h"
#include "simulation/material/blemker_muscle.h"
#include "simulation/material/corotated.h"
#include "simulation/material/fibre_laws.h"
#include "simulation/material/mooney_rivlin.h"
#include "simulation/material/neo_hookean.h"
#include "simulation/material/stable_neo_hookean.h"

namespace myotact::simulation {

/// Fibres of the whole stretch, and of that of the deformation without its change of volume.
template <class Curve>
using UnsplitFibres = FibreFamily<Curve, FibreStretch::Unsplit>;
template <class Curve>
using IsochoricFibres = FibreFamily<Curve, FibreStretch::Isochoric>;

/// Every law that a solid can be made of.
using Law = std::variant<StableNeoHookean, NeoHookean, MooneyRivlin, Corotated, BlemkerMuscle<BlemkerFibre>,
                         BlemkerMuscle<ExponentialFibre>, UnsplitFibres<MuscleFibre>, IsochoricFibres<MuscleFibre>,
                         UnsplitFibres<PosedFibre>, UnsplitFibres<BlemkerFibre>, IsochoricFibres<ExponentialFibre>,
                         UnsplitFibres<ExponentialFibre>, UnsplitFibres<ConstantTension>, UnsplitFibres<CalciumTension>,
                         IsotropicTension>;

}  // namespace myotact::simulation

#pragma once

#include <optional>
#include <vector>

#include "core/vector.h"
#include "exchange/febio_file.h"
#include "simulation/solid/law.h"

namespace myotact::exchange {

/// A material of a model as our laws. Tensions that FEBio scales by no activation are those at full load.
struct FebioReadMaterial {
  std::vector<simulation::Law> laws;
  double density_kg_m3 = 1.0;        // FEBio's where it says none
  std::optional<double> activation;  // of its fibres at full load; none: they have none
  double rise_s = 0.0;               // in motion: until it is reached
  std::optional<Vec3> fibre;         // unit, in the axes of its tets where these have some, else of the world
  bool follows_axes = false;         // the fibre is the first axis of the tets unless `fibre` says otherwise
};

/// Reads one <material>, whose load curves are known. `in_motion`: the activation's curve is looked at as such. What is
/// not among febio_laws.h is put among what cannot be read. Throws Error BadData for numbers outside their range.
FebioReadMaterial read_febio_material(const pugi::xml_node& material, bool in_motion, FebioFile& file);

}  // namespace myotact::exchange

#pragma once

#include <vector>

#include "anatomy/specimen.h"
#include "prepare/prepare_muscle.h"
#include "prepare/recipe/anatomy_data.h"
#include "prepare/recipe/named_surface.h"
#include "prepare/report.h"

namespace myotact::prepare {

/// All that a specimen is made from, in memory: where the surfaces come from (scan or loft) makes no difference.
struct PreparedInput {
  AnatomyData anatomy;
  std::vector<NamedSurface> bones, muscles;
};

/// Makes a specimen of the bones and muscles that the anatomy names and the input has, in the anatomy's order; appends
/// one report a surface. Throws Error BadData naming surface and stage, or when there is no bone or no muscle at all.
anatomy::Specimen assemble_specimen(const PreparedInput& input, const PrepareSettings& settings,
                                    std::vector<SurfaceReport>& reports);

}  // namespace myotact::prepare

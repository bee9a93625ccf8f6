#pragma once

#include <functional>
#include <string>

#include "anatomy/specimen.h"
#include "prepare/limb_work.h"

namespace myotact::prepare {

/// How far the work is. Called from any thread, one call at a time.
struct Progress {
  std::string stage;
  int done = 0, parts = 0;  // of this stage
  double whole = 0.0;       // part of all the work, 0 .. 1, as far as is known beforehand
};
using OnProgress = std::function<void(const Progress&)>;

/// Takes the limb through all stages, from raw surfaces to a specimen that has no defect. Deterministic, whatever the
/// number of threads. Throws Error BadData naming part, stage, place and remedy.
anatomy::Specimen prepare_limb(LimbWork& limb, const OnProgress& on_progress = {});

}  // namespace myotact::prepare

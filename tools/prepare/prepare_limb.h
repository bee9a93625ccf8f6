#pragma once

#include <functional>
#include <string>
#include <vector>

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

/// The stages by name, in their order.
std::vector<std::string> stage_names();

/// Takes the limb through the stages up to and with `last`, which is one of stage_names(). Deterministic, whatever the
/// number of threads. Throws Error BadData naming part, stage, place and remedy.
void run_stages(LimbWork& limb, const std::string& last, const OnProgress& on_progress = {});

/// Takes the limb through all stages, from raw surfaces to a specimen that has no defect. Throws as above.
anatomy::Specimen prepare_limb(LimbWork& limb, const OnProgress& on_progress = {});

}  // namespace myotact::prepare

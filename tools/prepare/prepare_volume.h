#pragma once

#include <filesystem>

#include "prepare/commands.h"

namespace myotact::prepare {

/// A segmented volume in, a specimen out: with the recipe named, with the built-in one that knows more of its segments,
/// or, where neither knows a bone and a muscle, with one that is guessed. Margins beside it (part_volume_file.h) make
/// its surfaces as fine as they were measured, else they are smoothed.
void prepare_volume(const Options& options);

}  // namespace myotact::prepare

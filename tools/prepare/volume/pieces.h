#pragma once

#include <string>
#include <vector>

#include "prepare/volume/label_volume.h"

namespace myotact::prepare {

/// One note for every segment in several pieces (points that share no face): its name, how many, the sizes of the
/// largest. Nothing for segments in one piece. Notes nothing of layers in too many tatters to count in bounded memory.
std::vector<std::string> piece_notes(const LabelVolume& volume);

}  // namespace myotact::prepare

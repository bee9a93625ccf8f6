#pragma once

#include <string>
#include <vector>

#include "prepare/volume/label_volume.h"

namespace myotact::prepare {

/// One note for every segment in several pieces, as its surface will have them (points touch as in
/// part/simple_point.h): its name, how many, the sizes of the largest. Nothing for segments in one piece. Notes nothing
/// of layers in too many tatters to count in bounded memory.
std::vector<std::string> piece_notes(const LabelVolume& volume);

}  // namespace myotact::prepare

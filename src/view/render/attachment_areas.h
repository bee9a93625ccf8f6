#pragma once

#include <vector>

#include "anatomy/specimen.h"

namespace myotact::view {

enum class AttachmentEnd : unsigned char { None, Origin, Insertion };

/// For each vertex of the muscle's skin, whether the tet node nearest to it hangs on a bone, and at which end: on the
/// body of the first point of its line (`line`, or null) it is the origin.
std::vector<AttachmentEnd> attachment_areas(const anatomy::Muscle& muscle, const anatomy::MuscleLine* line);

/// The muscle's line, or null.
const anatomy::MuscleLine* line_of(const anatomy::Specimen& specimen, int muscle);

}  // namespace myotact::view

#pragma once

#include <string>
#include <vector>

#include "anatomy/specimen.h"
#include "prepare/report/surface_report.h"

// Pictures for the report, drawn by the renderer of the scenes, as PNG in base 64.

namespace myotact::prepare {

/// One thing seen from the lateral and from the medial side.
struct PicturePair {
  std::string lateral, medial;
};

/// Colours of the marks in the pictures, as HTML writes them.
struct MarkColour {
  MarkKind kind;
  const char* html;
  const char* meaning;
};
const std::vector<MarkColour>& mark_colours();

/// All of the specimen. Throws Error Unavailable when nothing can be drawn here (no EGL), with what to install.
PicturePair picture_of_limb(const anatomy::Specimen& specimen);
/// One bone alone, and one muscle with its line, defects marked.
PicturePair picture_of_bone(const anatomy::Specimen& specimen, std::size_t bone, const std::vector<ReportMark>& marks);
PicturePair picture_of_muscle(const anatomy::Specimen& specimen, std::size_t muscle,
                              const std::vector<ReportMark>& marks);

}  // namespace myotact::prepare

#pragma once

#include "core/vector.h"

namespace myotact::prepare {

/// Turns LPS (x left, y posterior, z superior: how scanners, Slicer and ITK store places) into the specimen frame (x
/// cranial, y left, z up), without a shift. Terms for a person who stands upright say of an animal on four legs:
/// superior, towards the head, is cranial; posterior, towards the back, is dorsal, which is up; left stays left. DICOM
/// says the same of the trunk of quadrupeds (PS3.3 C.7.6.2.1.1). A rotation: nothing is mirrored.
inline Mat3 specimen_from_lps() {
  Mat3 rotation;
  rotation << 0.0, 0.0, 1.0,  // cranial: superior
      1.0, 0.0, 0.0,          // left: left
      0.0, 1.0, 0.0;          // up: posterior
  return rotation;
}

}  // namespace myotact::prepare

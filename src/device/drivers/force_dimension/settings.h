#pragma once

#include <string>

namespace myotact::device::force_dimension {

struct ForceDimensionSettings {
  std::string library;               // path of libdrd or libdhd; empty: where the system's loader finds them
  bool gravity_compensation = true;  // the library carries the device's own weight
  /// A device that does not know where it is moves by itself to find out, when it is opened.
  bool initialises_itself = false;
};

}  // namespace myotact::device::force_dimension

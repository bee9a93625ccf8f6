#pragma once

#include <string>

#include "core/data_folder.h"

namespace myotact {

/// Where the sources are, which a build folder's link leads to. Nothing compiled knows it, so that checkouts in several
/// places share a compiler cache.
inline std::string source_folder() {
  return data_folder().string();
}

}  // namespace myotact

#pragma once

#include <string>

#include "geometry/triangle_mesh.h"

namespace myotact::prepare {

/// The surface of one bone or muscle, under its stable key. Metres, specimen frame.
struct NamedSurface {
  std::string key;
  geometry::TriangleMesh surface;
};

}  // namespace myotact::prepare

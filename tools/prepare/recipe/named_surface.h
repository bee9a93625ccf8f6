#pragma once

#include <string>
#include <vector>

#include "core/vector.h"
#include "geometry/triangle_mesh.h"

namespace myotact::prepare {

/// The surface of one bone or muscle, under its stable key. Metres, specimen frame.
struct NamedSurface {
  std::string key;
  geometry::TriangleMesh surface;
  std::vector<Vec3> middle_m = {};  // of a muscle's measured sections with both tips, from the origin; empty: not known
};

}  // namespace myotact::prepare

#pragma once

#include <glm/glm.hpp>

#include "view/render/drawable.h"

namespace myotact::view {

/// Appends a coil between two places, that is drawn out and pushed together but keeps its turns; world metres.
void add_spring(DrawMesh& mesh, const glm::vec3& from_m, const glm::vec3& to_m);

}  // namespace myotact::view

#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "geometry/triangle_mesh.h"

namespace myotact::view {

/// Places of the skin's vertices squeezed along the fibres [m]: on the skin they change by a metre a metre across the
/// fibres and hardly at all along them, so that a pattern drawn by them is a pattern of strands. Where fibres pierce
/// the skin the pattern is of cut strands.
///
/// c minimises, over the skin, the integral of |dc/dt|^2 + e |grad (c - x)|^2, with x the place itself and t the part
/// of the fibre that lies in the skin. `fibres`: one a vertex, unit.
std::vector<glm::vec3> strand_coordinates(const geometry::TriangleMesh& skin, const std::vector<Vec3>& fibres);

}  // namespace myotact::view

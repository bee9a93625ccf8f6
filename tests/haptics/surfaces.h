#pragma once

#include <array>
#include <vector>

#include "core/vector.h"
#include "geometry/depth_inside.h"
#include "geometry/plain_surfaces.h"
#include "messages/local_model.h"

namespace myotact::haptics {

/// The part of the mesh around `centre_m` as the simulation would send it: as many of the nearest triangles as fit.
void write_patch(const geometry::TriangleMesh& mesh, const std::vector<Vec3>& previous_m,
                 const std::vector<Vec3>& current_m, const Vec3& centre_m, messages::LocalModel& model);

}  // namespace myotact::haptics

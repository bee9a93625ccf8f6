#pragma once

#include <vector>

#include "prepare/remesh/guarded_mesh.h"

namespace myotact::prepare {

/// Moves vertices along their normals, all by the same length where the guard lets them, until the mesh encloses
/// `volume_m3`; no vertex v moves outward by more than `room_m[v]`, where that is not empty. The relative error that is
/// left.
double restore_volume(GuardedMesh& guarded, double volume_m3, std::vector<double> room_m = {});

}  // namespace myotact::prepare

#pragma once

#include "prepare/remesh/guarded_mesh.h"

namespace myotact::prepare {

/// Moves vertices along their normals, all by the same length where the guard lets them, until the mesh encloses
/// `volume_m3`. The relative error that is left.
double restore_volume(GuardedMesh& guarded, double volume_m3);

}  // namespace myotact::prepare

#pragma once

#include <vector>

#include "anatomy/specimen.h"
#include "prepare/recipe/anatomy_data.h"
#include "prepare/recipe/named_surface.h"
#include "prepare/report.h"

namespace myotact::prepare {

/// Edge length that skins are made of [m]: the tool's proxy has a radius of 3 mm, and triangles smaller than it only
/// cost time; bellies of 15 mm radius still come out round.
inline constexpr double kSkinEdge_m = 5.5e-3;

struct PrepareSettings {
  /// Tets of a muscle of 30 cm3; others get the more, the larger they are (with the cube root of the volume).
  double tets = 200.0;
};

/// The limb around a muscle: surfaces of the bones as they go into the specimen, and all anatomy.
struct LimbContext {
  const AnatomyData& anatomy;
  const std::vector<anatomy::Bone>& bones;
  PrepareSettings settings;
};

struct PreparedMuscle {
  anatomy::Muscle muscle;
  anatomy::MuscleLine line;  // its muscle is left at -1
};

/// Everything from a raw muscle surface to a muscle that can be simulated: clean, even skin, coarse cage, tets,
/// attachments, fibres, sections, regions, line. Throws Error BadData naming the muscle and the stage.
PreparedMuscle prepare_muscle(const LimbContext& limb, const MuscleData& data, const geometry::TriangleMesh& raw,
                              SurfaceReport& report);

/// Cleans a bone and evens its triangles where that leaves it whole.
geometry::TriangleMesh prepare_bone(const NamedSurface& raw, SurfaceReport& report);

}  // namespace myotact::prepare

#pragma once

#include <string>
#include <vector>

#include "anatomy/specimen.h"
#include "prepare/architecture/attachment_patch.h"
#include "prepare/architecture/fibre_field.h"
#include "prepare/architecture/sections.h"
#include "prepare/part/part_surfaces.h"
#include "prepare/recipe/anatomy_data.h"
#include "prepare/report/surface_report.h"
#include "prepare/tets/cage.h"

// A limb on its way from surfaces to a specimen. Every stage fills in what the next ones need.

namespace myotact::prepare {

struct PrepareSettings {
  double tets = 210.0;       // of a muscle, roughly
  double tolerance = 0.005;  // how far repairs may move a surface, as a part of its diagonal
  int threads = 2;
};

struct BoneWork {
  BoneData data;
  geometry::TriangleMesh surface;  // raw, then repaired
  geometry::TriangleMesh skin;     // as it goes into the specimen
  SurfaceReport report;
};

struct MuscleWork {
  MuscleData data;
  geometry::TriangleMesh surface;  // raw, then repaired, parted, fine
  std::vector<Vec3> middle_m;      // of its measured sections, from the origin; empty: not known
  geometry::TriangleMesh skin;
  Cage cage;
  AttachmentPatches origins, insertions;  // in the order of the data's sites
  std::vector<int> origin_bodies, insertion_bodies;
  FibreField fibres;
  MuscleProfile profile;
  BellySpan belly;
  anatomy::MuscleLine line;
  SurfaceReport report;
};

struct LimbWork {
  AnatomyData anatomy;
  PrepareSettings settings;
  bool shares_borders = false;  // cut from a volume: repaired, parted and remeshed, neighbours share their triangles
  std::vector<BoneWork> bones;
  std::vector<MuscleWork> muscles;
  std::vector<std::string> notes;                             // on reading, units and frame
  std::vector<anatomy::Overlap> overlaps;                     // between skins, left after parting
  std::vector<std::pair<std::string, double>> stage_seconds;  // wall time
};

}  // namespace myotact::prepare

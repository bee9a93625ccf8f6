#pragma once

#include <string>
#include <vector>

#include "anatomy/specimen.h"
#include "core/vector.h"

// What is known of a limb besides its shapes: bodies, joints, the mechanics of its muscles, where they attach.

namespace myotact::prepare {

/// Where one end of a muscle is fixed.
struct AttachmentSite {
  std::vector<std::string> bones;  // keys of the bones that may carry it; all on one body
  Vec3 point_m = Vec3::Zero();     // middle of the patch, specimen frame
  double area_m2 = 0.0;            // of the measured contact patch; 0: not known
};

struct MuscleData {
  anatomy::Muscle mechanics;  // key, names, material, forces, lengths, sources; no meshes
  AttachmentSite origin, insertion;
};

struct BoneData {
  std::string key, name_la, name_en;
  int body = -1;  // index into AnatomyData::bodies
};

/// A muscle group by keys: made into indices once the muscles of the specimen are known.
struct GroupData {
  int joint = -1;  // index into AnatomyData::joints
  std::vector<std::string> flexors, extensors;
};

struct AnatomyData {
  std::string name, species, breed, side, source, licence;
  std::vector<BoneData> bones;
  std::vector<anatomy::Body> bodies;
  std::vector<anatomy::Joint> joints;
  std::vector<MuscleData> muscles;
  std::vector<GroupData> groups;
};

}  // namespace myotact::prepare

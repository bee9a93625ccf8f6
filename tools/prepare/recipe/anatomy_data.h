#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "anatomy/specimen.h"
#include "core/vector.h"

// What is known of a limb besides its shapes: bodies, joints, the mechanics of its muscles, where they attach.

namespace myotact::prepare {

/// A place where a muscle is fixed.
struct AttachmentSite {
  std::vector<std::string> bones;  // keys of the bones that may carry it; all on one body
  int body = -1;                   // index into AnatomyData::bodies, where no bone carries it (the trunk)
  Vec3 point_m = Vec3::Zero();     // middle of the patch, specimen frame
  double area_m2 = 0.0;            // of the measured contact patch; 0: not known
};

/// What was measured of a muscle of other dogs; 0: not known.
struct PublishedMuscle {
  double mass_kg = 0.0;
  double fascicle_m = 0.0;
};

/// How a muscle's line passes a joint: between two points on the middle of its sections, at these distances from the
/// joint's axis (in the plane across it), or its ends where the middle comes nowhere so far.
struct CrossingData {
  int joint = -1;  // index into AnatomyData::joints
  double proximal_m = 0.0;
  double distal_m = 0.0;               // 0: the insertion
  std::optional<Vec3> distal_point_m;  // where the line ends, past the joint, in place of the insertion
};

/// A surface that the line goes round where it crosses a joint.
struct WrapData {
  int joint = -1;              // index into AnatomyData::joints
  anatomy::LineWrap wrap;      // `after` is not known yet
  bool side_is_given = false;  // else: the side on which the muscle passes
};

struct MuscleData {
  anatomy::Muscle mechanics;                        // key, names, material, forces, lengths, sources; no meshes
  std::vector<AttachmentSite> origins, insertions;  // at least one each; the muscle line ends at the first
  PublishedMuscle published;
  std::vector<CrossingData> crossings;
  std::vector<WrapData> wraps;
  std::vector<anatomy::LinePoint> line;  // given by hand; empty: through the middle of the sections
  std::string file;                      // of its surface, in the input's folder; empty: muscles/KEY
};

struct BoneData {
  std::string key, name_la, name_en;
  int body = -1;     // index into AnatomyData::bodies
  std::string file;  // of its surface, in the input's folder; empty: bones/KEY
  /// Where the file holds several bones: a place on or in this one; the pieces nearest to it are its own.
  std::optional<Vec3> piece_m = {};
};

/// A part that the scan lacks and the limb needs: a flat band between two points, ends rounded.
struct BandData {
  BoneData bone;  // it moves with its body like a bone
  std::array<Vec3, 2> ends_m{Vec3::Zero(), Vec3::Zero()};
  double width_m = 0.0, thickness_m = 0.0;
};

/// A file of the input that is no part of the limb.
struct LeftOut {
  std::string file, why;
};

/// A muscle group by keys: made into indices once the muscles of the specimen are known.
struct GroupData {
  int joint = -1;  // index into AnatomyData::joints
  std::vector<std::string> flexors, extensors;
};

struct AnatomyData {
  std::string name, species, breed, side, source, licence;
  std::string units;             // of the scan's files: "m", "cm", "mm" or "in"; empty: guessed from their size
  std::string published_source;  // of MuscleData::published
  std::vector<BoneData> bones;
  std::vector<anatomy::Body> bodies;
  std::vector<anatomy::Joint> joints;
  std::vector<MuscleData> muscles;
  std::vector<GroupData> groups;
  std::vector<BandData> built;
  std::vector<LeftOut> leave_out;
  std::string shapes;  // recipe whose sections and outlines are lofted; empty: its own
};

}  // namespace myotact::prepare

#pragma once

#include <string>
#include <vector>

#include "prepare/guess/decision.h"
#include "prepare/guess/guess_skeleton.h"
#include "prepare/guess/markups.h"
#include "prepare/guess/muscle_contacts.h"
#include "prepare/recipe/anatomy_data.h"

namespace myotact::prepare {

/// All that the ends of muscles hang on.
struct EndBones {
  const std::vector<NamedSurface>& bones;
  const std::vector<BoneDistance>& distances;  // one a bone
  const GuessedSkeleton& skeleton;             // without bones: one body, which carries everything
};

/// What was marked of one muscle.
struct MuscleMarks {
  std::vector<Vec3> origins_m, insertions_m, line_m;
};

/// A muscle before it has ends.
struct LooseMuscle {
  const NamedSurface& surface;
  const LongAxis& axis;
  MuscleMarks marks;
  std::string pointer;  // its place in the recipe
};

/// Fills in origins, insertions and the marked line of the muscle.
void guess_ends(const LooseMuscle& muscle, const EndBones& bones, MuscleData& data, std::vector<Decision>& decisions);

}  // namespace myotact::prepare

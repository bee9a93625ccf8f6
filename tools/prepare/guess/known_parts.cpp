#include "prepare/guess/known_parts.h"

#include <set>

namespace myotact::prepare {

KnownParts known_parts(const std::vector<AnatomyData>& recipes, const anatomy::FactsByKey& facts) {
  KnownParts known;
  std::set<std::string> keys;
  const auto add = [&](const std::string& key, const std::string& la, const std::string& en, bool bone) {
    if (keys.insert(key).second) known.push_back({key, la, en, bone, anatomy::facts_of(facts, key).synonyms});
  };
  for (const AnatomyData& recipe : recipes) {
    for (const BoneData& bone : recipe.bones) add(bone.key, bone.name_la, bone.name_en, true);
    for (const MuscleData& muscle : recipe.muscles) {
      add(muscle.mechanics.key, muscle.mechanics.name_la, muscle.mechanics.name_en, false);
    }
  }
  return known;
}

}  // namespace myotact::prepare

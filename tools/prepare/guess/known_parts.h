#pragma once

#include <vector>

#include "anatomy/part_facts.h"
#include "prepare/guess/part_names.h"
#include "prepare/recipe/anatomy_data.h"

namespace myotact::prepare {

/// All bones and muscles of the recipes, each key once, with the synonyms that the facts list.
KnownParts known_parts(const std::vector<AnatomyData>& recipes, const anatomy::FactsByKey& facts);

}  // namespace myotact::prepare

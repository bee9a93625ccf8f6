#pragma once

#include <string>
#include <vector>

#include "prepare/guess/decision.h"
#include "prepare/guess/markups.h"
#include "prepare/guess/part_names.h"
#include "prepare/recipe/anatomy_data.h"
#include "prepare/recipe/named_surface.h"

namespace myotact::prepare {

/// Surfaces of which nothing is known but what they are. Metres, specimen frame; keys as part_key() makes them, all
/// different.
struct Strangers {
  std::string name = "specimen";
  std::string source = "not stated";
  std::vector<NamedSurface> bones, muscles;  // at least one of both together
  std::vector<Markup> markups;               // in the same frame
};

struct GuessedRecipe {
  AnatomyData anatomy;
  std::vector<Decision> decisions;  // what a person should look at
};

/// What can be known of a limb from its surfaces: a body a bone, welded where they lie nearest unless a joint is
/// marked; a muscle's ends where its surface lies on bone, far apart, else its tips along its longest direction; forces
/// and lengths by rule of thumb, which `sources` states. Names come from `known`, where a key is one of its. The result
/// goes through make_limb() like any recipe, and through recipe_text() unchanged. Deterministic. Throws Error BadData
/// for markups that fit no part, and where there is no surface, or one that is empty, names vertices that it has not,
/// or has such that are not finite.
GuessedRecipe guess_recipe(const Strangers& strangers, const KnownParts& known);

}  // namespace myotact::prepare

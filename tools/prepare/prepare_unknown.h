#pragma once

#include <filesystem>
#include <vector>

#include "prepare/commands.h"
#include "prepare/guess/guess_recipe.h"

namespace myotact::prepare {

/// The names that the built-in recipes and the table of names know.
KnownParts built_in_parts();

/// Surfaces that no recipe knows in, a specimen out, with the recipe that was guessed as recipe.json beside it and, on
/// request, elsewhere. Without an output the recipe alone is written.
void prepare_unknown(const Options& options);

/// What a person should decide: a line each, unsure ones only, or, as JSON, all.
void print_decisions(const std::vector<Decision>& decisions, bool json);

}  // namespace myotact::prepare

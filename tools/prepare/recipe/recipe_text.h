#pragma once

#include <string>

#include "prepare/recipe/anatomy_data.h"

namespace myotact::prepare {

/// A recipe as read_recipe() takes it, to be edited by a person: what is read back is the same to the last bit. Wraps,
/// crossings, published figures, parts to build and files to leave out are not written: nothing that is guessed has
/// any.
std::string recipe_text(const AnatomyData& anatomy);

}  // namespace myotact::prepare

#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "prepare/guess/guess_recipe.h"
#include "prepare/guess/part_files.h"

namespace myotact::prepare {

/// Asks a person what the surfaces do not say, a line a question. An empty line takes what stands in brackets; where
/// the input ends, that goes for all that is left. Never asks what is sure.
class Wizard {
 public:
  Wizard(std::istream& in, std::ostream& out) : in_(in), out_(out) {}

  /// What each unsure part is.
  void ask_parts(std::vector<PartFile>& parts);
  /// The unit, with the size that it makes.
  void ask_units(const Strangers& strangers, std::string& units);
  /// Names, the bones of unsure ends, and which welds are hinges.
  void ask_recipe(const Strangers& strangers, const KnownParts& known, GuessedRecipe& guess);

 private:
  /// One of `allowed`, asked again until it is; anything where that is empty.
  std::string ask(const std::string& question, const std::string& taken, const std::vector<std::string>& allowed = {});
  void ask_names(AnatomyData& anatomy, const KnownParts& known);
  void ask_ends(const Strangers& strangers, GuessedRecipe& guess);
  void ask_joints(AnatomyData& anatomy);

  std::istream& in_;
  std::ostream& out_;
};

}  // namespace myotact::prepare

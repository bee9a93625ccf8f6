#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "prepare/guess/decision.h"
#include "prepare/guess/guess_recipe.h"
#include "prepare/guess/part_names.h"

namespace myotact::prepare {

/// A surface file of an unknown specimen.
struct PartFile {
  std::filesystem::path path;
  std::string name;  // the file's, without extension
  std::string key;   // one that is known, where the name means it; else made of the name; all are different
  bool bone = false;
  bool sure = false;  // that it is a bone, or none: its folder, its name or the person said so
};

/// What the inputs hold: surface files, those of folders, and Markups (.mrk.json) beside them.
struct StrangerInputs {
  std::vector<std::filesystem::path> surfaces, markups;
};
StrangerInputs find_inputs(const std::vector<std::filesystem::path>& inputs);

/// Bones are those that `bones` names, all others muscles; where it is empty, the folder decides, then the name; what
/// remains is taken for a muscle. Throws Error Usage for a name in `bones` that no file has.
std::vector<PartFile> sort_parts(const std::vector<std::filesystem::path>& files, const std::vector<std::string>& bones,
                                 const KnownParts& known);

/// What a person should look at in that.
std::vector<Decision> decisions_on(const std::vector<PartFile>& parts);

/// The surfaces in metres. `units` is "m", "cm", "mm" or "in", or empty: then what makes a limb of 2 cm to 3 m, metres
/// before millimetres before centimetres, and it is filled in. Throws Error BadData where none does.
Strangers read_strangers(const std::vector<PartFile>& parts, std::string& units, std::vector<std::string>& notes);

/// Names the files in the recipe, so that it finds them again, and their unit.
void name_files(const std::vector<PartFile>& parts, const std::string& units, AnatomyData& anatomy);

}  // namespace myotact::prepare

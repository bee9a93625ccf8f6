#include "prepare/commands.h"

#include <algorithm>
#include <iostream>
#include <optional>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "core/data_folder.h"
#include "core/error.h"
#include "prepare/check/specimen_check.h"
#include "prepare/finish_limb.h"
#include "prepare/loft/loft.h"
#include "prepare/prepare_unknown.h"
#include "prepare/prepare_volume.h"
#include "prepare/recipe/make_limb.h"
#include "prepare/recipe/read_recipe.h"
#include "prepare/recipe/read_scan.h"
#include "prepare/recipe/surface_files.h"
#include "prepare/recipe/units_and_frame.h"
#include "prepare/volume/dicom.h"
#include "prepare/volume/read_label_volume.h"

namespace myotact::prepare {

namespace {

namespace fs = std::filesystem;

fs::path canine(const char* limb) {
  return data_folder() / "assets" / "canine" / (std::string(limb) + ".json");
}

/// How many bones and how many muscles of a recipe the inputs' names mean.
struct KnownNames {
  int bones = 0, muscles = 0;
};

KnownNames known_names(const fs::path& recipe_file, const std::vector<std::string>& stems) {
  const AnatomyData recipe = read_recipe(recipe_file);
  const auto is_stem = [&](const std::string& key) {
    return std::find(stems.begin(), stems.end(), key) != stems.end() ? 1 : 0;
  };
  KnownNames known;
  for (const BoneData& bone : recipe.bones) known.bones += is_stem(bone.key);
  for (const MuscleData& muscle : recipe.muscles) known.muscles += is_stem(muscle.mechanics.key);
  return known;
}

/// The built-in recipe that knows more of the files' names; none where neither knows both a bone and a muscle, while
/// there are files.
std::optional<fs::path> choose_recipe(const std::vector<fs::path>& inputs) {
  std::vector<std::string> stems;
  for (const fs::path& input : inputs) {
    if (!fs::is_directory(input)) {
      stems.push_back(input.stem().string());
      continue;
    }
    for (const auto& entry : fs::recursive_directory_iterator(input)) {
      if (is_surface_file(entry.path())) stems.push_back(entry.path().stem().string());
    }
  }
  const KnownNames fore = known_names(canine("forelimb"), stems), hind = known_names(canine("hindlimb"), stems);
  const bool is_hind = hind.bones + hind.muscles > fore.bones + fore.muscles;
  const KnownNames& best = is_hind ? hind : fore;
  if (!stems.empty() && (best.bones == 0 || best.muscles == 0)) return {};
  return canine(is_hind ? "hindlimb" : "forelimb");
}

void prepare_folder(const Options& options, const fs::path& recipe_file, const std::vector<fs::path>& inputs,
                    const fs::path& output, anatomy::CompanionFiles companions = {}) {
  const AnatomyData recipe = read_recipe(recipe_file);
  Scan scan = read_scan(inputs, recipe);
  set_units_and_frame(scan, recipe, options.units);
  for (const std::string& note : scan.notes) spdlog::info("{}", note);
  LimbWork limb = make_limb(recipe, scan.bones, scan.muscles, options.settings);
  limb.notes = std::move(scan.notes);
  finish_limb(limb, options, output, std::move(companions));
}

/// A recipe says all that would be guessed or asked.
void check_ways(const Options& options) {
  if (options.recipe.empty()) return;
  const char* other = options.guess                   ? "--guess"
                      : options.ask                   ? "--ask"
                      : !options.bones.empty()        ? "--bones"
                      : !options.write_recipe.empty() ? "--write-recipe"
                                                      : nullptr;
  if (!other) return;
  throw Error(ExitStatus::Usage,
              fmt::format("{}: does not go with --recipe, which says it all; edit the recipe", other));
}

}  // namespace

int prepare_scan(const Options& options) {
  if (options.inputs.empty()) {
    throw Error(ExitStatus::Usage, "the scan is missing; name a folder that holds bones/ and muscles/, or files");
  }
  const bool recipe_only = options.output.empty() && !options.write_recipe.empty();
  if (!recipe_only) check_output(options.output, "specimen");
  for (const fs::path& input : options.inputs) {
    if (!fs::exists(input)) throw Error(ExitStatus::NoInput, input.string() + ": is not there");
    refuse_dicom(input);
  }
  check_ways(options);
  const bool guessing = options.guess || options.ask || recipe_only || !options.bones.empty();
  std::optional<fs::path> recipe;
  if (!options.recipe.empty())
    recipe = options.recipe;
  else if (!guessing)
    recipe = choose_recipe(options.inputs);
  return unless_interrupted([&] {
    if (is_label_volume(options.inputs.front()))
      prepare_volume(options);
    else if (recipe)
      prepare_folder(options, *recipe, options.inputs, options.output, companions_of(options));
    else
      prepare_unknown(options);
  });
}

int prepare_loft(const Options& options) {
  check_output(options.output, "specimen");
  return unless_interrupted([&] {
    const AnatomyData recipe = read_recipe(options.recipe);
    const fs::path shapes =
        recipe.shapes.empty() ? options.recipe : options.recipe.parent_path() / (recipe.shapes + ".json");
    LimbWork limb = make_limb(recipe, loft_bones(shapes), loft_muscles(shapes), options.settings);
    finish_limb(limb, options, options.output);
  });
}

int import_canine(const Options& options) {
  check_output(options.output, "specimens");
  const char* named = std::getenv("MYOTACT_CANINE_DIR");
  if (options.inputs.empty() && !named) {
    throw Error(ExitStatus::Usage, "the data set is missing; name its folder, or set MYOTACT_CANINE_DIR");
  }
  const fs::path folder = options.inputs.empty() ? fs::path(named) : options.inputs.front();
  return unless_interrupted([&] {
    for (const char* limb : {"forelimb", "hindlimb"}) {
      prepare_folder(options, canine(limb), {folder / (std::string(limb) + "_left")},
                     options.output / (std::string("canine_") + limb));
    }
  });
}

int check_specimen(const Options& options) {
  const anatomy::SpecimenSurvey survey = anatomy::survey_specimen(options.inputs.front());
  std::vector<std::string> violations = survey.defects;
  for (std::string& violation : find_violations(survey.specimen)) violations.push_back(std::move(violation));
  for (const std::string& violation : violations) std::cout << violation << "\n";
  if (!violations.empty()) return static_cast<int>(ExitStatus::CheckFailed);
  std::cout << options.inputs.front().string() << ": no violation\n";
  return static_cast<int>(ExitStatus::Done);
}

}  // namespace myotact::prepare

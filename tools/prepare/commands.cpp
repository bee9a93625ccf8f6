#include "prepare/commands.h"

#include <algorithm>
#include <iostream>

#include <spdlog/spdlog.h>

#include "core/data_folder.h"
#include "core/error.h"
#include "prepare/check/specimen_check.h"
#include "prepare/finish_limb.h"
#include "prepare/loft/loft.h"
#include "prepare/recipe/make_limb.h"
#include "prepare/recipe/read_recipe.h"
#include "prepare/recipe/read_scan.h"
#include "prepare/recipe/units_and_frame.h"

namespace myotact::prepare {

namespace {

namespace fs = std::filesystem;

fs::path canine(const char* limb) {
  return data_folder() / "assets" / "canine" / (std::string(limb) + ".json");
}

/// The built-in recipe that knows more of the files' names.
fs::path choose_recipe(const std::vector<fs::path>& inputs) {
  std::vector<std::string> stems;
  for (const fs::path& input : inputs) {
    if (!fs::is_directory(input)) {
      stems.push_back(input.stem().string());
      continue;
    }
    for (const auto& entry : fs::recursive_directory_iterator(input)) stems.push_back(entry.path().stem().string());
  }
  const auto known = [&](const fs::path& file) {
    const AnatomyData recipe = read_recipe(file);
    const auto names = [&](const std::string& stem) {
      return std::any_of(recipe.bones.begin(), recipe.bones.end(), [&](const auto& b) { return b.key == stem; }) ||
             std::any_of(recipe.muscles.begin(), recipe.muscles.end(),
                         [&](const auto& m) { return m.mechanics.key == stem; });
    };
    return std::count_if(stems.begin(), stems.end(), names);
  };
  return known(canine("hindlimb")) > known(canine("forelimb")) ? canine("hindlimb") : canine("forelimb");
}

void prepare_folder(const Options& options, const fs::path& recipe_file, const std::vector<fs::path>& inputs,
                    const fs::path& output) {
  const AnatomyData recipe = read_recipe(recipe_file);
  Scan scan = read_scan(inputs, recipe);
  set_units_and_frame(scan, recipe, options.units);
  for (const std::string& note : scan.notes) spdlog::info("{}", note);
  LimbWork limb = make_limb(recipe, scan.bones, scan.muscles, options.settings);
  limb.notes = std::move(scan.notes);
  finish_limb(limb, options, output);
}

}  // namespace

int prepare_scan(const Options& options) {
  if (options.inputs.empty()) {
    throw Error(ExitStatus::Usage, "the scan is missing; name a folder that holds bones/ and muscles/, or files");
  }
  check_output(options.output, "specimen");
  for (const fs::path& input : options.inputs) {
    if (!fs::exists(input)) throw Error(ExitStatus::NoInput, input.string() + ": is not there");
  }
  const fs::path recipe = options.recipe.empty() ? choose_recipe(options.inputs) : options.recipe;
  return unless_interrupted([&] { prepare_folder(options, recipe, options.inputs, options.output); });
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

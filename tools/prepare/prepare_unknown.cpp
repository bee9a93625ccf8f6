#include "prepare/prepare_unknown.h"

#include <algorithm>
#include <iostream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "core/data_folder.h"
#include "core/error.h"
#include "core/file.h"
#include "prepare/finish_limb.h"
#include "prepare/guess/known_parts.h"
#include "prepare/guess/part_files.h"
#include "prepare/guess/wizard.h"
#include "prepare/recipe/make_limb.h"
#include "prepare/recipe/read_recipe.h"
#include "prepare/recipe/recipe_text.h"

namespace myotact::prepare {

namespace {

namespace fs = std::filesystem;

/// Questions on standard error: standard output carries data.
bool may_ask(const Options& options) {
  if (!options.ask) return false;
  if (::isatty(STDIN_FILENO) != 0) return true;
  spdlog::warn("--ask: there is no terminal to ask on; everything is taken as guessed");
  return false;
}

/// In the files' unit, as `units` says after it.
Strangers read_parts(const std::vector<PartFile>& parts, const Options& options, Wizard* wizard, std::string& units,
                     std::vector<std::string>& notes) {
  Strangers strangers = read_strangers(parts, units, notes);
  if (!wizard || !options.units.empty()) return strangers;
  const std::string guessed = units;
  wizard->ask_units(strangers, units);
  if (units == guessed) return strangers;
  std::vector<std::string> said_before;
  return read_strangers(parts, units, said_before);
}

void tell_of_units_and_frame(const std::string& units, bool named, std::vector<Decision>& decisions) {
  if (!named) decisions.push_back({"units", "", "taken as " + units + "; else name them with --units", {}, "/units"});
  decisions.push_back({"frame",
                       "",
                       "the files' own: x should be cranial, y left, z up, and the limb a left one; else "
                       "turn the files, and set the side in the recipe",
                       {},
                       "/side"});
}

}  // namespace

KnownParts built_in_parts() {
  const fs::path folder = data_folder() / "assets" / "canine";
  return known_parts({read_recipe(folder / "forelimb.json"), read_recipe(folder / "hindlimb.json")},
                     anatomy::load_part_facts(folder / "names.json"));
}

void print_decisions(const std::vector<Decision>& decisions, bool json) {
  int left = 0;
  for (const Decision& decision : decisions) {
    if (json) {
      std::cout << nlohmann::ordered_json{{"decide", decision.about},    {"part", decision.part},
                                          {"text", decision.text},       {"suggestions", decision.suggestions},
                                          {"pointer", decision.pointer}, {"sure", decision.sure}}
                       .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
                << "\n";
    } else if (decision.sure) {
      ++left;
    } else {
      const std::string part = decision.part.empty() ? "" : decision.part + ": ";
      std::cout << fmt::format("to decide ({}): {}{}\n", decision.about, part, decision.text);
    }
  }
  if (left > 0) std::cout << fmt::format("{} more that look sure are in the recipe, and listed by --json\n", left);
  std::cout << std::flush;
}

void prepare_unknown(const Options& options) {
  const KnownParts known = built_in_parts();
  const StrangerInputs inputs = find_inputs(options.inputs);
  Wizard terminal(std::cin, std::cerr);
  Wizard* wizard = may_ask(options) ? &terminal : nullptr;
  std::vector<PartFile> parts = sort_parts(inputs.surfaces, options.bones, known);
  if (wizard) wizard->ask_parts(parts);
  std::string units = options.units;
  std::vector<std::string> notes;
  Strangers strangers = read_parts(parts, options, wizard, units, notes);
  strangers.name = fs::absolute(options.inputs.front()).lexically_normal().stem().string();
  if (strangers.name.empty()) strangers.name = "specimen";
  for (const fs::path& file : inputs.markups) {
    for (Markup& markup : read_markups(file, notes)) strangers.markups.push_back(std::move(markup));
  }
  GuessedRecipe guess = guess_recipe(strangers, known);
  std::vector<Decision> decisions = decisions_on(parts);
  tell_of_units_and_frame(units, !options.units.empty(), decisions);
  decisions.insert(decisions.end(), guess.decisions.begin(), guess.decisions.end());
  if (wizard) wizard->ask_recipe(strangers, known, guess);
  name_files(parts, units, guess.anatomy);
  const std::string recipe = recipe_text(guess.anatomy);
  for (const std::string& note : notes) spdlog::info("{}", note);
  print_decisions(decisions, options.json);
  if (!options.write_recipe.empty()) write_file(options.write_recipe, recipe);
  if (options.output.empty()) return;
  LimbWork limb = make_limb(guess.anatomy, strangers.bones, strangers.muscles, options.settings);
  limb.notes = std::move(notes);
  for (const Decision& decision : decisions) {
    if (!decision.sure) limb.notes.push_back("to decide: " + decision.part + ": " + decision.text);
  }
  finish_limb(limb, options, options.output, {{"recipe.json", recipe}});
}

}  // namespace myotact::prepare

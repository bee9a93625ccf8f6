#include "prepare/commands.h"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <iostream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "core/data_folder.h"
#include "core/error.h"
#include "prepare/check/specimen_check.h"
#include "prepare/loft/loft.h"
#include "prepare/mirror.h"
#include "prepare/prepare_limb.h"
#include "prepare/progress_bar.h"
#include "prepare/recipe/make_limb.h"
#include "prepare/recipe/read_recipe.h"
#include "prepare/recipe/read_scan.h"
#include "prepare/recipe/units_and_frame.h"
#include "prepare/report/html_report.h"
#include "prepare/save_stage.h"

namespace myotact::prepare {

namespace {

namespace fs = std::filesystem;

constexpr const char* kRead = "read";

std::atomic<int> received_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);

void remember(int signal) {
  received_signal = signal;
}

/// Ends the work where it stands.
struct Interrupted {
  int status;
};

void stop_when_interrupted() {
  constexpr int kShellOffset = 128;  // how a shell reports an end by signal
  if (const int signal = received_signal; signal != 0) throw Interrupted{kShellOffset + signal};
}

/// Before any work: whether the folder that is to hold the output is there, or can be made, and can be written.
void check_output(const fs::path& output, const char* what) {
  if (output.empty()) {
    throw Error(ExitStatus::Usage, fmt::format("--output: is missing; name the folder of the {} to write", what));
  }
  fs::path holder = fs::absolute(output).lexically_normal().parent_path();
  while (!fs::exists(holder) && holder.has_relative_path()) holder = holder.parent_path();
  if (fs::is_directory(holder) && ::access(holder.c_str(), W_OK) == 0) return;
  throw Error(
      ExitStatus::InputOutput,
      fmt::format("{}: is not a folder that can be written; name another place for the {}", holder.string(), what));
}

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

void print_report(const LimbWork& limb, bool json) {
  std::vector<SurfaceReport> reports;
  for (const BoneWork& bone : limb.bones) reports.push_back(bone.report);
  for (const MuscleWork& muscle : limb.muscles) reports.push_back(muscle.report);
  if (json) {
    for (const auto& [stage, seconds] : limb.stage_seconds) {
      std::cout << nlohmann::ordered_json{{"stage", stage}, {"wall_s", seconds}}.dump() << "\n";
    }
    std::cout << report_json_lines(reports) << std::flush;
    return;
  }
  std::cout << report_table(reports);
  for (const anatomy::Overlap& overlap : limb.overlaps) {
    std::cout << fmt::format("left overlapping: {} and {}, {:.2f} mm deep, {:.3f} cm3\n", overlap.a, overlap.b,
                             1e3 * overlap.depth_m, 1e6 * overlap.volume_m3);
  }
  for (const auto& [stage, seconds] : limb.stage_seconds) std::cout << fmt::format("{} {:.1f} s  ", stage, seconds);
  std::cout << std::endl;
}

/// Calls work(on_progress) with a progress bar that also looks for signals.
template <class Work>
auto with_progress(Work&& work) {
  ProgressBar bar;
  return work([&](const Progress& progress) {
    stop_when_interrupted();
    bar.show(progress);
  });
}

void stop_at_stage(LimbWork& limb, const Options& options, const fs::path& output) {
  if (options.until != kRead) {
    with_progress([&](const OnProgress& on_progress) { run_stages(limb, options.until, on_progress); });
  }
  stop_when_interrupted();
  save_stage(limb, output);
  print_report(limb, options.json);
}

void make_specimen(LimbWork& limb, const Options& options, const fs::path& output) {
  if (!options.until.empty()) {
    stop_at_stage(limb, options, output);
    return;
  }
  anatomy::Specimen specimen =
      with_progress([&](const OnProgress& on_progress) { return prepare_limb(limb, on_progress); });
  const std::string report = html_report(limb, specimen, find_violations(specimen));
  if (options.mirror) specimen = mirrored(std::move(specimen));
  stop_when_interrupted();
  anatomy::save_specimen(specimen, output, {{"report.html", report}});
  print_report(limb, options.json);
}

void prepare_folder(const Options& options, const fs::path& recipe_file, const std::vector<fs::path>& inputs,
                    const fs::path& output) {
  const AnatomyData recipe = read_recipe(recipe_file);
  Scan scan = read_scan(inputs, recipe);
  set_units_and_frame(scan, recipe, options.units);
  for (const std::string& note : scan.notes) spdlog::info("{}", note);
  LimbWork limb = make_limb(recipe, scan.bones, scan.muscles, options.settings);
  limb.notes = std::move(scan.notes);
  make_specimen(limb, options, output);
}

template <class Command>
int unless_interrupted(Command&& command) {
  try {
    command();
    return static_cast<int>(ExitStatus::Done);
  } catch (const Interrupted& interrupted) {
    spdlog::error("interrupted; nothing was written");
    return interrupted.status;
  }
}

}  // namespace

void watch_for_interruption() {
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
}

std::vector<std::string> stages_to_stop_at() {
  std::vector<std::string> stages = stage_names();
  stages.insert(stages.begin(), kRead);
  return stages;
}

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
    make_specimen(limb, options, options.output);
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

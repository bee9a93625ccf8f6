#include "prepare/finish_limb.h"

#include <atomic>
#include <csignal>
#include <iostream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "core/error.h"
#include "core/file.h"
#include "prepare/check/specimen_check.h"
#include "prepare/mirror.h"
#include "prepare/prepare_limb.h"
#include "prepare/progress_bar.h"
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

}  // namespace

void stop_when_interrupted() {
  constexpr int kShellOffset = 128;  // how a shell reports an end by signal
  if (const int signal = received_signal; signal != 0) throw Interrupted{kShellOffset + signal};
}

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

anatomy::CompanionFiles companions_of(const Options& options) {
  if (options.recipe.empty()) return {};
  return {{"recipe.json", read_file(options.recipe)}};
}

void finish_limb(LimbWork& limb, const Options& options, const fs::path& output, anatomy::CompanionFiles companions) {
  if (!options.until.empty()) {
    stop_at_stage(limb, options, output);
    return;
  }
  if (limb.muscles.empty()) {
    throw bad_data(
        options.inputs.empty() ? output.string() : options.inputs.front().string(), "parts",
        fmt::format("holds {} bones and no muscle; there must be one at least. Leave what is a muscle out of "
                    "--bones, or map its name to a muscle's",
                    limb.bones.size()));
  }
  anatomy::Specimen specimen =
      with_progress([&](const OnProgress& on_progress) { return prepare_limb(limb, on_progress); });
  const std::string report = html_report(limb, specimen, find_violations(specimen));
  if (options.mirror) specimen = mirrored(std::move(specimen));
  stop_when_interrupted();
  companions.emplace_back("report.html", report);
  anatomy::save_specimen(specimen, output, companions);
  print_report(limb, options.json);
}

void watch_for_interruption() {
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
}

std::vector<std::string> stages_to_stop_at() {
  std::vector<std::string> stages = stage_names();
  stages.insert(stages.begin(), kRead);
  return stages;
}

}  // namespace myotact::prepare

// The program myotact-prepare: reads the command line, makes one specimen, turns every error into one line and a
// status.

#include <exception>
#include <filesystem>
#include <iostream>
#include <new>

#include <CLI/CLI.hpp>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "anatomy/specimen.h"
#include "core/data_folder.h"
#include "core/error.h"
#include "core/log.h"
#include "prepare/loft/loft.h"
#include "prepare/prepare_limb.h"
#include "prepare/recipe/make_limb.h"
#include "prepare/recipe/read_recipe.h"
#include "prepare/recipe/read_scan.h"
#include "prepare/report/surface_report.h"

namespace {

using namespace myotact;

struct Options {
  std::filesystem::path scan;
  std::filesystem::path anatomy;  // empty: the project's
  std::filesystem::path specimen;
  prepare::PrepareSettings settings;
  bool json = false;
};

void add_common(CLI::App& command, Options& options) {
  command.add_option("-o,--output", options.specimen, "folder of the specimen to write");
  command.add_option("--tets", options.settings.tets, "tets of a muscle, roughly")
      ->check(CLI::Range(40.0, 20000.0))
      ->capture_default_str();
  command.add_flag("--json", options.json, "report as JSON lines");
}

prepare::LimbWork read_input(const Options& options, bool loft) {
  const std::filesystem::path anatomy = options.anatomy.empty() ? data_folder() / "assets" / "canine" : options.anatomy;
  const prepare::AnatomyData recipe = prepare::read_recipe(anatomy / "forelimb.json");
  if (loft) {
    return make_limb(recipe, prepare::loft_bones(anatomy / "forelimb.json"), prepare::loft_muscles(anatomy / "forelimb.json"), options.settings);
  }
  const prepare::Scan scan = prepare::read_scan(options.scan, recipe);
  return make_limb(recipe, scan.bones, scan.muscles, options.settings);
}

/// Before any work: whether the folder that is to hold the specimen is there, or can be made, and can be written.
void check_output(const std::filesystem::path& specimen) {
  std::filesystem::path holder = std::filesystem::absolute(specimen).lexically_normal().parent_path();
  while (!std::filesystem::exists(holder) && holder.has_relative_path()) {
    holder = holder.parent_path();
  }
  if (std::filesystem::is_directory(holder) && ::access(holder.c_str(), W_OK) == 0) return;
  throw Error(ExitStatus::InputOutput,
              holder.string() + ": is not a folder that can be written; name another place for the specimen");
}

int make_specimen(const Options& options, bool loft) {
  if (options.specimen.empty()) {
    throw Error(ExitStatus::Usage, "--output: is missing; name the folder of the specimen to write");
  }
  if (!loft && options.scan.empty()) {
    throw Error(ExitStatus::Usage, "the folder of the scan is missing; name one that holds bones/ and muscles/");
  }
  check_output(options.specimen);
  prepare::LimbWork limb = read_input(options, loft);
  const anatomy::Specimen specimen = prepare::prepare_limb(limb);
  anatomy::save_specimen(specimen, options.specimen);
  std::vector<prepare::SurfaceReport> reports;
  for (const prepare::BoneWork& bone : limb.bones) reports.push_back(bone.report);
  for (const prepare::MuscleWork& muscle : limb.muscles) reports.push_back(muscle.report);
  std::cout << (options.json ? prepare::report_json_lines(reports) : prepare::report_table(reports)) << std::flush;
  return static_cast<int>(ExitStatus::Done);
}

int fail(ExitStatus status, const std::string& text) {
  spdlog::error("{}", text);
  return static_cast<int>(status);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Turns scans of a limb into a specimen that can be touched. AGPL-3.0-or-later.", "myotact-prepare");
  Options options;
  add_common(program, options);
  program.add_option("scan", options.scan, "folder with bones/KEY.stl and muscles/KEY.stl, in metres");
  program.add_option("--anatomy", options.anatomy, "folder with bodies, joints and mechanics of the limb");
  CLI::App* loft = program.add_subcommand("loft", "make the surfaces from the sections and outlines of the anatomy");
  loft->add_option("anatomy", options.anatomy, "folder with the anatomy")->required();
  add_common(*loft, options);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? static_cast<int>(ExitStatus::Done) : static_cast<int>(ExitStatus::Usage);
  }
  try {
    start_log("info");
    return make_specimen(options, loft->parsed());
  } catch (const Error& error) {
    return fail(error.status(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitStatus::Internal, "out of memory; use a smaller surface");
  } catch (const std::exception& error) {
    return fail(ExitStatus::Internal, error.what());
  }
}

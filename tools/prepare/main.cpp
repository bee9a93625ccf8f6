// The program myotact-prepare: reads the command line, reports every error as one line and a status.

#include <exception>
#include <new>

#include <CLI/CLI.hpp>
#include <spdlog/spdlog.h>

#include "core/error.h"
#include "core/log.h"
#include "prepare/commands.h"

namespace {

using namespace myotact;

void add_common(CLI::App& command, prepare::Options& options) {
  command.add_option("-o,--output", options.output, "folder of the specimen to write");
  command.add_option("--tets", options.settings.tets, "tets of a muscle, roughly")
      ->check(CLI::Range(40.0, 5000.0))
      ->capture_default_str();
  command.add_option("--threads", options.settings.threads, "the result does not depend on their number")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command.add_flag("--mirror", options.mirror, "write the limb of the other side");
  command.add_flag("--json", options.json, "report as JSON lines");
}

void add_until(CLI::App& command, prepare::Options& options) {
  command.add_option("--until", options.until, "last stage; its surfaces, tets and report are written, no specimen")
      ->check(CLI::IsMember(prepare::stages_to_stop_at()));
}

int fail(ExitStatus status, const std::string& text) {
  spdlog::error("{}", text);
  return static_cast<int>(status);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Turns scans of a limb into a specimen that can be touched. AGPL-3.0-or-later.", "myotact-prepare");
  program.set_version_flag("--version", MYOTACT_VERSION);
  prepare::Options options;
  add_common(program, options);
  add_until(program, options);
  program.add_option("scan", options.inputs,
                     "folder with bones/ and muscles/, or surface files (STL, OBJ, PLY, OFF, VTK), and .mrk.json; "
                     "or one segmented volume (NRRD, NIfTI, MetaImage)");
  program.add_option("--recipe", options.recipe, "JSON file that names parts, joints and attachments");
  program.add_option("--units", options.units, "of the scan; guessed from its size when left out")
      ->check(CLI::IsMember({"m", "cm", "mm", "in"}));
  program.add_flag("--guess", options.guess, "take the names as they are, with no built-in recipe");
  program.add_option("--bones", options.bones, "parts that are bones; all others are muscles: A,B,...")->delimiter(',');
  program.add_flag("--ask", options.ask, "ask on the terminal what the surfaces do not say");
  program.add_option("--write-recipe", options.write_recipe, "JSON file for the guessed recipe, to be edited");
  program.add_option("--segments", options.segments, "CSV table: which part each segment of a volume is");
  program.add_option("--write-segments", options.write_segments, "where to write that table, to be edited");
  CLI::App* measure = program.add_subcommand("measure", "make a segmented volume from surfaces");
  measure->add_option("scan", options.inputs, "folder with bones/ and muscles/, or surface files")->required();
  measure->add_option("-o,--output", options.output, "NAME.seg.nrrd to write; NAME.margins.nrrd goes beside it")
      ->required();
  measure->add_option("--recipe", options.recipe, "JSON file that names the parts")->required();
  measure->add_option("--units", options.units, "of the scan; guessed from its size when left out")
      ->check(CLI::IsMember({"m", "cm", "mm", "in"}));
  measure->add_option("--step", options.step_mm, "between lattice points [mm]")
      ->check(CLI::Range(0.1, 10.0))
      ->capture_default_str();
  measure->add_option("--threads", options.settings.threads, "the result does not depend on their number")
      ->check(CLI::Range(1, 64));
  CLI::App* loft = program.add_subcommand("loft", "make the surfaces from a recipe's own sections and outlines");
  loft->add_option("recipe", options.recipe, "RECIPE.json")->required();
  add_common(*loft, options);
  add_until(*loft, options);
  CLI::App* import = program.add_subcommand("import", "make both whole limbs of the canine data set");
  import->add_option("dataset", options.inputs, "its folder; default: MYOTACT_CANINE_DIR")->expected(0, 1);
  add_common(*import, options);
  CLI::App* check = program.add_subcommand("check", "name every violation of a specimen");
  check->add_option("specimen", options.inputs, "its folder")->required()->expected(1);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? static_cast<int>(ExitStatus::Done) : static_cast<int>(ExitStatus::Usage);
  }
  try {
    start_log("info");
    prepare::watch_for_interruption();
    if (measure->parsed()) return prepare::measure_volume(options);
    if (loft->parsed()) return prepare_loft(options);
    if (import->parsed()) return import_canine(options);
    if (check->parsed()) return check_specimen(options);
    return prepare_scan(options);
  } catch (const Error& error) {
    return fail(error.status(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitStatus::Internal, "out of memory; use a smaller surface");
  } catch (const std::exception& error) {
    return fail(ExitStatus::Internal, error.what());
  }
}

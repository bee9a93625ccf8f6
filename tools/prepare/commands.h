#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "prepare/limb_work.h"

// What the program does, one function a command. Each returns the exit status, or throws Error.

namespace myotact::prepare {

struct Options {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path recipe;  // empty: the built-in one that knows the inputs' names
  std::filesystem::path output;
  std::string units;                   // empty: guessed
  std::vector<std::string> bones;      // parts that are bones, all others muscles; empty: told from folders and names
  std::filesystem::path write_recipe;  // where the guessed recipe goes as well; empty: nowhere
  bool guess = false;                  // no recipe, even if one knows some of the names
  bool ask = false;                    // on the terminal, what the surfaces do not say
  std::filesystem::path segments;      // table that says which part each segment of a volume is; empty: by their names
  std::filesystem::path write_segments;  // where that table goes, to be edited; empty: nowhere
  double step_mm = 1.0;                  // of a measured volume
  std::string until;  // last stage, whose result is written instead of a specimen; empty: all of them
  bool mirror = false;
  bool json = false;
  PrepareSettings settings;
};

/// What `until` may be: "read", and the stages after it.
std::vector<std::string> stages_to_stop_at();

/// Surfaces and a recipe in, a specimen out; surfaces that no recipe knows in, the same by guessing one.
int prepare_scan(const Options& options);
/// The recipe's own sections and outlines in, a specimen out.
int prepare_loft(const Options& options);
/// Surfaces and a recipe in, a volume of parts out.
int measure_volume(const Options& options);
/// The canine data set's two whole limbs, from its full meshes.
int import_canine(const Options& options);
/// Every violation of a specimen, with file, place and value.
int check_specimen(const Options& options);

/// From now on SIGINT and SIGTERM end the work between two parts, with nothing left behind and exit status 130 or 143.
void watch_for_interruption();

}  // namespace myotact::prepare

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "measure/stiffness_sweep.h"

namespace myotact::measure {

/// What a sweep was of. Parts of one sweep have all of it in common.
struct SweepOrigin {
  std::string version;     // of the program
  std::string scene;       // name
  std::string title;       // of the plots
  std::string scene_hash;  // SHA-256 of the scene with its overrides and of the specimen.json, which has its meshes'
  std::string joint;
  SweepGrid grid;

  bool operator==(const SweepOrigin&) const = default;
};

/// The rows of one share of a sweep; part 1 of 1 is a whole one.
struct SweepPart {
  SweepOrigin origin;
  int part = 1, parts = 1;
  std::vector<StiffnessRow> rows;
};

inline constexpr int kMostParts = 10'000;

/// Throws Error NoInput when the specimen's file has gone.
SweepOrigin sweep_origin(const scene::Scene& scene, const SweepGrid& grid, const std::string& version);

/// "stiffness_part_2_of_8.json".
std::string part_file_name(int part, int parts);
std::string part_json(const SweepPart& part);
/// Throws Error NoInput or BadData.
SweepPart read_part(const std::filesystem::path& file);

/// The whole sweep out of the files of all its parts, in any order; equal to the one of a single run to the bit. Throws
/// Error BadData that names the file that is of another sweep, comes twice or is missing.
SweepPart merge_parts(const std::vector<std::filesystem::path>& files);

}  // namespace myotact::measure

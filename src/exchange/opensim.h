#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "anatomy/specimen.h"

// Models of OpenSim 4 (.osim), read into specimens and written from them. docs/opensim.md says what becomes of what.
//
// OpenSim's ground is x forward, y up, z right; a specimen's frame is x cranial, y left, z up: both are the same turned
// by 90 degrees about x. Its bodies have frames of their own; a specimen's are all given at the file pose.

namespace myotact::exchange::opensim {

/// What a model holds and a specimen does not, or holds otherwise. Of one kind all are in one entry.
struct NotTaken {
  std::string element;               // the name of the XML element
  std::vector<std::string> objects;  // what they belong to, in the order of the file; a long list is cut
  std::string place;                 // of the first: "line 12"
  std::string reason;                // empty: the element means nothing to a specimen
  std::size_t count = 0;
};

/// A coordinate of the model that moves in the specimen.
struct CoordinateTaken {
  std::string coordinate;    // its name in the model
  std::string joint;         // key of the specimen's joint
  std::size_t axis = 0;      // of that joint
  double factor = 1.0;       // q = factor (coordinate - file_pose), so that q > 0 flexes; -1: it was turned
  double file_pose = 0.0;    // value of the coordinate where q is 0 [rad]
  double default_rad = 0.0;  // value that the model starts at
  std::pair<double, double> range_rad;
};

struct Import {
  anatomy::Specimen specimen;
  std::string scene_json;   // a scene of lines about one joint, for a file beside specimen.json
  std::string scene_joint;  // that joint's key; empty: no joint has muscles on both sides
  std::vector<CoordinateTaken> coordinates;
  std::vector<NotTaken> not_taken;
};

/// Larger files are refused; the largest public models have 6 MB.
inline constexpr std::size_t kLargestModel_bytes = std::size_t{16} << 20;

/// Reads a model; surfaces of bones are looked for beside it and in `Geometry` beside it. Throws Error: NoInput or
/// InputOutput of the file, BadData naming file, line, value and remedy.
Import read_model(const std::filesystem::path& file);
/// The same from text. `file` is named in errors; without `folder` no surfaces are read.
Import parse_model(std::string_view text, const std::string& file, const std::filesystem::path& folder = {});

/// A model's text, and the surfaces of bones that it names.
struct Model {
  std::string osim;
  std::vector<std::pair<std::string, std::string>> geometry;  // path beside the model, bytes (.obj)
};
/// The specimen as a model of OpenSim 4. Its universal and ball joints are its own, not chains of hinges. Surfaces go
/// to `geometry_folder`, beside the model. Throws Error BadData for a specimen with a defect.
Model write_model(const anatomy::Specimen& specimen, const std::string& geometry_folder);

/// Writes the model and its surfaces (STEM_geometry/KEY.obj). Throws Error as above, and InputOutput.
void save_model(const anatomy::Specimen& specimen, const std::filesystem::path& file);

}  // namespace myotact::exchange::opensim

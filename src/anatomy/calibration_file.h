#pragma once

#include <filesystem>
#include <string>

#include "anatomy/specimen.h"

namespace myotact::anatomy {

/// The file in a specimen folder that holds what the simulation found out about the muscles' fibres, so that opening
/// the specimen need not find it out again: `muscles` where they touch nothing, `on_bones` where they touch the bones.
/// It may be missing, or hold some muscles only.
inline constexpr const char* kCalibrationFile = "calibration.json";

/// Reads it, where it is there, into the muscles' fits; muscles that the specimen has not are passed over.
/// Throws Error BadData naming file, place and remedy.
void read_calibration(const std::filesystem::path& folder, Specimen& specimen);

/// The file's text: every muscle that has a fit.
std::string calibration_json(const Specimen& specimen);

}  // namespace myotact::anatomy

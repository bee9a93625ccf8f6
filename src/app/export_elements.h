#pragma once

#include <string>

#include "app/options.h"
#include "scene/scene_file.h"

namespace myotact::app {

/// Whether a file is one of finite elements (assets/cases/README.md) and no scene; false for what is no JSON file.
bool is_case(const std::string& scene);

/// Writes the case as a model of FEBio. Throws Error: as measure::load_case(), InputOutput.
int export_case(const Options& options);

/// Plays the script and writes the muscle of --muscle, or all, at their pose. Throws Error: Usage for an unknown
/// muscle, InputOutput.
void write_elements(const Options& options, const scene::Scene& scene);

}  // namespace myotact::app

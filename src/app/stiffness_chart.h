#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "measure/stiffness_row.h"

namespace myotact::app {

/// Draws joint stiffness against co-contraction, by all three ways of finding it and with its uncertainty band; some
/// six angles where there are more. The title states when it is a preview. Throws Error InputOutput.
void write_stiffness_chart(const std::vector<measure::StiffnessRow>& rows, const std::string& title,
                           const std::filesystem::path& path);

/// Draws it over angle and co-contraction as a map that marks where the joint is unstable, not held or not known. The
/// rows are of one grid, at least one. Throws Error InputOutput.
void write_stiffness_map(const std::vector<measure::StiffnessRow>& rows, const std::string& title,
                         const std::filesystem::path& path);

}  // namespace myotact::app

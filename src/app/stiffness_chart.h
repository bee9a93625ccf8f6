#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "measure/stiffness_sweep.h"

namespace myotact::app {

/// Draws joint stiffness against co-contraction, by all three ways of finding it; the title says so
/// when it is a preview. Throws Error InputOutput.
void write_stiffness_chart(const std::vector<measure::StiffnessRow>& rows, const std::string& title,
                           const std::filesystem::path& path);

}  // namespace myotact::app

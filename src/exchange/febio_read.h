#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "measure/solve_case.h"

namespace myotact::exchange {

/// A model of FEBio as a case, and what of it was left out because it changes no answer ("line 12: <Output>").
struct FebioCase {
  measure::SolveCase solve_case;
  std::vector<std::string> left_out;
};

/// Reads a .feb file of version 4.0: module solid, one step, static or in motion; tet4, tet10 and hex8 (cut into tets);
/// materials as in febio_laws.h; zero and prescribed displacements, nodal forces, pressure, traction over the area at
/// rest, body force; load curves. Its numbers are taken as SI. Outputs: of all nodes of the file, and of each set that
/// is held. Throws Error: NoInput; BadData naming line and element, with all elements that would change the answer and
/// are not read.
FebioCase read_febio(const std::filesystem::path& path);
/// The same from text; `name` is for messages.
FebioCase parse_febio(const std::string& text, const std::string& name);

}  // namespace myotact::exchange

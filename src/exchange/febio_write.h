#pragma once

#include <string>
#include <vector>

#include "measure/solve_case.h"

namespace myotact::exchange {

/// A case as FEBio 4.0 reads it (.feb), and what a person should know of it; the file's first comment says the same.
struct FebioText {
  std::string text;
  std::vector<std::string> notes;
};

/// Mesh (tet4, ut4 or tet10), laws (febio_laws.h), fibres, supports, loads, activation and steps. `notes` are put
/// before those that the case itself gives rise to. `activations`: one a material, instead of the case's own. Throws
/// Error BadData naming the law that FEBio has no like of.
FebioText febio_text(const measure::SolveCase& input, std::vector<std::string> notes = {},
                     const std::vector<double>& activations = {});

}  // namespace myotact::exchange

#pragma once

#include <string>
#include <vector>

#include "exchange/febio_file.h"
#include "exchange/febio_mesh.h"
#include "measure/solve_case.h"

namespace myotact::exchange {

/// Sections of a model that may stand in it or in its one step.
struct FebioSections {
  std::vector<pugi::xml_node> boundary, loads;
};

/// Fills the loads of a case whose mesh is there, and one output of displacement and reaction for each set that is
/// held. What cannot be read is put among it. Throws Error BadData.
void read_febio_conditions(const FebioSections& sections, const FebioMesh& mesh, FebioFile& file,
                           measure::SolveCase& out);

}  // namespace myotact::exchange

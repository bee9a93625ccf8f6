#pragma once

#include "core/json_reader.h"
#include "measure/solve_case.h"

namespace myotact::measure {

std::vector<CaseOutput> read_outputs(const JsonValue& value, const NodeSets& sets, const SolveCase& solve_case);

/// "m", "N", "Pa", "J" or "1".
const char* unit_of(Quantity quantity);

/// What outputs are taken from.
struct SolvedState {
  std::vector<Vec3> displacement_m;                           // of each node
  std::vector<Vec3> reaction_N;                               // of each node
  std::vector<Mat3> cauchy_Pa;                                // of each tet
  std::vector<double> stretch, volume_ratio, rest_volume_m3;  // of each tet
  double energy_J = 0.0;
};

double von_mises_Pa(const Mat3& cauchy_Pa);

/// One number, or the components of a vector (x y z) or a stress (xx yy zz xy yz zx).
///   mean  of nodes; of tets weighted by their volume at rest
///   sum   plain
///   max   the largest: of vectors the length, of stresses von Mises
///   l2    root of the sum of squares: of stresses all nine components
std::vector<double> evaluate_output(const CaseOutput& output, const SolvedState& state);

}  // namespace myotact::measure

#pragma once

#include "core/json_reader.h"
#include "measure/solve_case.h"

namespace myotact::measure {

/// Node sets by name, each with at least one node; "all", unless the file defines it, is every node.
NodeSets read_sets(const std::optional<JsonValue>& value, const CaseMesh& mesh);

/// The set of that name. Throws Error BadData naming the nearest one.
const NodeSet& require_set(const JsonValue& name, const NodeSets& sets);

/// Nodes of the mesh file by their numbers there, those of no tet left out; mid-sides that were added belong with both
/// their corners.
NodeSet set_of_file_nodes(const std::vector<int>& of_file, const CaseMesh& mesh);

/// Tets with all corners in the set or, where no tet has, those with at least one.
std::vector<int> tets_of(const NodeSet& set, const geometry::TetMesh& mesh);

}  // namespace myotact::measure

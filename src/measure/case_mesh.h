#pragma once

#include <optional>

#include "core/json_reader.h"
#include "measure/solve_case.h"

namespace myotact::measure {

/// Where a case defines its mesh.
struct MeshKeys {
  JsonValue mesh;
  std::optional<JsonValue> fibre;
  Element element = Element::T10;
};

/// The mesh named by a case, or its box, converted to what the element needs; every tet has a positive volume.
CaseMesh read_case_mesh(const MeshKeys& keys);

/// The same of a mesh that was read already: nodes of no tet left out, mid-sides added or dropped, fibres made unit.
/// `file` is for messages.
CaseMesh make_case_mesh(geometry::TetFile mesh, Element element, const std::string& file);

}  // namespace myotact::measure

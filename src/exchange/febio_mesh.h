#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "exchange/febio_file.h"
#include "geometry/tet_mesh.h"

namespace myotact::exchange {

/// One <Elements> of a model. An element is a tet, or a hexahedron cut into twelve about its centre.
struct FebioPart {
  std::string name;
  std::vector<std::vector<int>> tets;  // of each element, in the file's order: those that it became
};

/// The mesh of a model: tets alone. The file's nodes come first and in its order, then the centres of hexahedra.
struct FebioMesh {
  geometry::TetMesh mesh;
  std::size_t nodes_of_file = 0;
  bool has_hexahedra = false;
  std::vector<FebioPart> parts;
  std::map<std::string, std::vector<int>> node_sets;                // as the file lists them
  std::map<std::string, std::vector<std::array<int, 3>>> surfaces;  // triangles of corners
};

/// Reads <Mesh>: tet4, tet10 and hex8, node sets and surfaces. Others are put among what cannot be read. Throws Error
/// BadData.
FebioMesh read_febio_mesh(FebioFile& file);

}  // namespace myotact::exchange

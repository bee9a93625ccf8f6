#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/tet_mesh.h"
#include "geometry/triangle_mesh.h"

namespace myotact::geometry {

/// Binary little-endian PLY with double positions. Reading also accepts float positions and skips unknown properties.
/// Throws Error NoInput, BadData (file, byte offset, value), InputOutput.
TriangleMesh read_ply(const std::filesystem::path& path);
void write_ply(const TriangleMesh& mesh, const std::filesystem::path& path);

/// ASCII or binary STL; the kind is told from the size, not from "solid". Equal corners are welded exactly.
/// Refuses non-finite coordinates and files whose size does not fit the header.
TriangleMesh read_stl(const std::filesystem::path& path);

/// Named values of a tet mesh in a legacy VTK 3.0 file.
struct TetFile {
  TetMesh mesh;
  std::vector<Vec3> fibres;         // cell vectors "fibre"
  std::vector<double> sections_m2;  // cell scalars "section", optional: cross-section along the fibres
  std::vector<int> regions;         // cell scalars "region"
  std::vector<int> attachments;     // point scalars "attachment"
};

/// Legacy VTK 3.0, ASCII, unstructured grid of cell type 10 or 24, double. Throws as above, naming the line.
TetFile read_vtk(const std::filesystem::path& path);
void write_vtk(const TetFile& file, const std::filesystem::path& path);

}  // namespace myotact::geometry

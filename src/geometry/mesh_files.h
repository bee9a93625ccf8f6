#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "geometry/tet_mesh.h"
#include "geometry/triangle_mesh.h"

namespace myotact::geometry {

/// A surface, and what a person should know of the file it came from: "the header announces 12 facets, ...".
struct SurfaceFile {
  TriangleMesh mesh;
  std::vector<std::string> notes;
};

/// A surface in the file's own unit; the format is by the extension: .stl, .obj, .ply, .off, .vtk (legacy: PolyData, or
/// the boundary of an unstructured grid of tets), .mesh (Medit), .node and .ele (boundary of the tets); capitals are
/// the same. Polygons are cut into triangles; faces are kept as they are, also degenerate ones; only STL's corners are
/// welded, exactly. Throws Error NoInput, BadData (file, line or byte, value), InputOutput.
SurfaceFile read_surface(const std::filesystem::path& path);

/// PLY in any of its three encodings; unknown elements and properties are read over. Throws as above.
TriangleMesh read_ply(const std::filesystem::path& path);
/// Binary little-endian with double positions.
void write_ply(const TriangleMesh& mesh, const std::filesystem::path& path);

/// ASCII or binary STL; the kind is detected by the size, not by "solid". Equal corners are welded exactly. Since it
/// returns no notes, it refuses a file whose header and size differ, which read_surface() reads where it can.
TriangleMesh read_stl(const std::filesystem::path& path);

/// A tet mesh with the values that its file has for it; formats without a kind of value leave that list empty.
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

/// What a computation adds to a mesh, for ParaView. Names hold no blanks; lists have one entry a node or a tet.
struct TetResults {
  std::vector<std::pair<std::string, std::vector<Vec3>>> point_vectors;
  std::vector<std::pair<std::string, std::vector<double>>> cell_scalars;
};
void write_vtk(const TetFile& file, const TetResults& results, const std::filesystem::path& path);

/// TetGen's NAME.node and NAME.ele, of which `path` names either. Indices from 0 or 1; attributes and markers are read
/// over. Throws as above, naming the line.
TetFile read_tetgen(const std::filesystem::path& path);

/// Medit's .mesh in text form: Vertices, and Tetrahedra with their references as regions; other sections are read over.
TetFile read_medit(const std::filesystem::path& path);

/// Any of these, by the extension: .vtk, .mesh, .node or .ele.
TetFile read_tet_mesh(const std::filesystem::path& path);

}  // namespace myotact::geometry

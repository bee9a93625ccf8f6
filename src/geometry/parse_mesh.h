#pragma once

#include <string>
#include <string_view>

#include "geometry/mesh_files.h"

// The readers of mesh_files.h behind their files: bytes in, mesh or Error BadData out. `file` is only named in errors.

namespace myotact::geometry {

SurfaceFile parse_stl(std::string_view bytes, const std::string& file);
SurfaceFile parse_obj(std::string_view bytes, const std::string& file);
SurfaceFile parse_ply(std::string_view bytes, const std::string& file);
SurfaceFile parse_off(std::string_view bytes, const std::string& file);
/// PolyData, ASCII or binary, of the versions to 5; or the boundary of what parse_vtk() reads.
SurfaceFile parse_vtk_surface(std::string_view bytes, const std::string& file);

TetFile parse_vtk(std::string_view bytes, const std::string& file);
TetFile parse_medit(std::string_view bytes, const std::string& file);
/// The contents of `stem`.node and `stem`.ele.
TetFile parse_tetgen(std::string_view nodes, std::string_view tets, const std::string& stem);

/// The boundary of the tets, with the nodes on it only, in their order.
SurfaceFile boundary_surface(const TetFile& tets, const std::string& file);

/// Whether the size is exactly that of the facets which the header of a binary STL announces. No text can be.
bool is_whole_binary_stl(std::string_view bytes);

/// The kind of file whose mark `bytes` begin with, as "PLY" or "gzip"; empty when there is none.
std::string_view marked_kind(std::string_view bytes);

}  // namespace myotact::geometry

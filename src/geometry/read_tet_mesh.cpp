#include <fmt/format.h>

#include "core/error.h"
#include "geometry/mesh_files.h"

namespace myotact::geometry {

TetFile read_tet_mesh(const std::filesystem::path& path) {
  const std::string kind = path.extension().string();
  if (kind == ".vtk") return read_vtk(path);
  if (kind == ".mesh") return read_medit(path);
  if (kind == ".node" || kind == ".ele") return read_tetgen(path);
  throw bad_data(path.string(), "",
                 fmt::format("the kind \"{}\" of tet mesh is not read; must be .vtk, .mesh, .node or .ele", kind));
}

}  // namespace myotact::geometry

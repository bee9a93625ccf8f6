#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "core/error.h"
#include "geometry/mesh_files.h"

// What every reader promises of any bytes: a mesh that may be used, or an Error that names the file.

namespace myotact::testing {

/// Ends the program where a promise is broken, so that libFuzzer keeps the bytes.
inline void require(bool promise) {
  if (!promise) std::abort();
}

inline std::string_view as_text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Runs a reader of the file `name`; an Error must be BadData and begin with that name.
template <class Read>
void check_reader(std::string_view name, Read&& read) {
  try {
    read();
  } catch (const Error& error) {
    require(error.status() == ExitStatus::BadData);
    require(std::string_view(error.what()).starts_with(name));
  }
}

template <class Cells>
void check_indices(const Cells& cells, std::size_t vertices) {
  for (const auto& cell : cells) {
    for (const int vertex : cell) require(vertex >= 0 && static_cast<std::size_t>(vertex) < vertices);
  }
}

inline void check_positions(const std::vector<Vec3>& positions) {
  for (const Vec3& position : positions) require(position.allFinite());
}

inline void check_surface(const geometry::SurfaceFile& surface) {
  require(!surface.mesh.triangles.empty());
  check_positions(surface.mesh.positions_m);
  check_indices(surface.mesh.triangles, surface.mesh.positions_m.size());
}

inline void check_tets(const geometry::TetFile& file) {
  require(!file.mesh.corners.empty());
  check_positions(file.mesh.nodes_m);
  check_indices(file.mesh.corners, file.mesh.nodes_m.size());
  check_indices(file.mesh.midsides, file.mesh.nodes_m.size());
}

}  // namespace myotact::testing

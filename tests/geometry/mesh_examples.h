#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "geometry/mesh_files.h"

// Small meshes and the bytes of files that hold them.

namespace myotact::geometry {

/// The unit right-angled tetrahedron's surface: volume 1/6, triangles outward.
inline TriangleMesh corner_surface() {
  return {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}

template <class T>
void append_bytes(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

inline std::string binary_stl(const TriangleMesh& mesh, const std::string& title = "made by a test") {
  std::string bytes = title;
  bytes.resize(80, ' ');
  append_bytes(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) append_bytes(bytes, 0.0F);  // the normal, which readers work out themselves
    for (const int vertex : triangle) {
      for (const double x : to_array(mesh.positions_m[static_cast<std::size_t>(vertex)])) {
        append_bytes(bytes, static_cast<float>(x));
      }
    }
    append_bytes(bytes, std::uint16_t{0});
  }
  return bytes;
}

inline std::string ascii_stl() {
  return "solid one facet\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex +1.5e0 0 0\n   vertex 0 2 0\n"
         "  endloop\n endfacet\nendsolid one facet\n";
}

/// Two tets that share a face, with every kind of value a file may hold.
inline TetFile two_tets() {
  TetFile file;
  file.mesh.nodes_m = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1.0 / 3.0), Vec3(1, 1, 1)};
  file.mesh.corners = {{0, 1, 2, 3}, {1, 4, 2, 3}};
  file.fibres = {Vec3(1, 0, 0), Vec3(0, 0.6, 0.8)};
  file.sections_m2 = {1e-4, 2.5e-4};
  file.regions = {0, 1};
  file.attachments = {0, -1, -1, 1, -1};
  return file;
}

}  // namespace myotact::geometry

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "geometry/parse_mesh.h"
#include "geometry/tet_topology.h"
#include "geometry/words.h"

namespace myotact::geometry {

namespace {

SurfaceFile parse_medit_surface(std::string_view bytes, const std::string& file) {
  return boundary_surface(parse_medit(bytes, file), file);
}

struct Kind {
  std::string_view extension;
  std::string_view mark;  // as marked_kind() names it; empty when the format has none
  SurfaceFile (*parse)(std::string_view bytes, const std::string& file);
};

constexpr std::array<Kind, 6> kKinds = {{{".stl", "STL", parse_stl},
                                         {".obj", "OBJ", parse_obj},
                                         {".ply", "PLY", parse_ply},
                                         {".off", "OFF", parse_off},
                                         {".vtk", "legacy VTK", parse_vtk_surface},
                                         {".mesh", "Medit", parse_medit_surface}}};

const Kind& kind_of(const std::string& file, std::string_view extension) {
  for (const Kind& kind : kKinds) {
    if (kind.extension == extension) return kind;
  }
  throw bad_data(file, "",
                 fmt::format("the kind \"{}\" of surface is not read; must be .stl, .obj, .ply, .off, .vtk, .mesh, "
                             ".node or .ele",
                             shown(extension)));
}

void refuse_other_kind(const std::string& file, std::string_view bytes, const Kind& named) {
  const std::string_view found = marked_kind(bytes);
  if (found.empty() || found == named.mark) return;
  const auto right = std::find_if(kKinds.begin(), kKinds.end(), [&](const Kind& kind) { return kind.mark == found; });
  const std::string remedy = right == kKinds.end() ? std::string("export the surface as STL, OBJ, PLY, OFF or VTK")
                                                   : fmt::format("rename it to end in {}", right->extension);
  throw bad_data(file, "byte 0", fmt::format("is named {} but holds {}; {}", named.extension, found, remedy));
}

}  // namespace

std::string_view marked_kind(std::string_view bytes) {
  struct Mark {
    std::string_view start;
    std::string_view kind;
  };
  static constexpr std::array<Mark, 17> kMarks = {{{"ply\n", "PLY"},
                                                   {"ply\r", "PLY"},
                                                   {"OFF", "OFF"},
                                                   {"COFF", "OFF"},
                                                   {"NOFF", "OFF"},
                                                   {"STOFF", "OFF"},
                                                   {"# vtk DataFile", "legacy VTK"},
                                                   {"MeshVersionFormatted", "Medit"},
                                                   {"solid ", "STL"},
                                                   {"solid\n", "STL"},
                                                   {"<?xml", "XML"},
                                                   {"<VTKFile", "XML"},
                                                   {"glTF", "glTF"},
                                                   {"\x1f\x8b", "gzip"},
                                                   {"PK\x03\x04", "a zip archive"},
                                                   {"\x89PNG", "PNG"},
                                                   {"v ", "OBJ"}}};
  if (is_whole_binary_stl(bytes)) return "STL";
  for (const Mark& mark : kMarks) {
    if (bytes.starts_with(mark.start)) return mark.kind;
  }
  return "";
}

SurfaceFile boundary_surface(const TetFile& tets, const std::string& file) {
  std::vector<int> number(tets.mesh.nodes_m.size(), -1);
  const std::vector<BoundaryTriangle> boundary = boundary_triangles(tets.mesh);
  if (boundary.empty()) throw bad_data(file, "", "its tets have no boundary; there is no surface to read");
  for (const BoundaryTriangle& triangle : boundary) {
    for (const int node : triangle.corners) number[static_cast<std::size_t>(node)] = 0;
  }
  SurfaceFile surface;
  for (std::size_t node = 0; node < number.size(); ++node) {
    if (number[node] < 0) continue;
    number[node] = static_cast<int>(surface.mesh.positions_m.size());
    surface.mesh.positions_m.push_back(tets.mesh.nodes_m[node]);
  }
  for (const BoundaryTriangle& triangle : boundary) {
    const auto vertex = [&](std::size_t k) { return number[static_cast<std::size_t>(triangle.corners[k])]; };
    surface.mesh.triangles.push_back({vertex(0), vertex(1), vertex(2)});
  }
  std::size_t inverted = 0;
  for (std::size_t tet = 0; tet < tets.mesh.corners.size(); ++tet) {
    if (corner_volume_m3(tets.mesh, tet) < 0.0) ++inverted;
  }
  if (inverted > 0) {
    surface.notes.push_back(fmt::format("{} of its {} tets are inside out: their triangles look inwards", inverted,
                                        tets.mesh.corners.size()));
  }
  return surface;
}

SurfaceFile read_surface(const std::filesystem::path& path) {
  const std::string file = path.string();
  const std::string extension = lower(path.extension().string());
  if (extension == ".node" || extension == ".ele") return boundary_surface(read_tetgen(path), file);
  const Kind& kind = kind_of(file, extension);
  const std::string bytes = read_file(path);
  refuse_other_kind(file, bytes, kind);
  return kind.parse(bytes, file);
}

}  // namespace myotact::geometry

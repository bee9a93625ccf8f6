#include "measure/probe/probe_frames.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "geometry/mesh_files.h"
#include "measure/probe/csv_rows.h"
#include "measure/probe/probe_path.h"
#include "measure/probe/surface_side.h"

namespace myotact::measure {

namespace {

/// No limb is larger: such a surface is most likely in millimetres.
constexpr double kLargeSurface_m = 3.0;
/// Haptics takes nothing that is farther than 1 km (moving_surface).
constexpr double kFarthestVertex_m = 900.0;

void require_places(const geometry::TriangleMesh& mesh, const std::string& file) {
  for (std::size_t i = 0; i < mesh.positions_m.size(); ++i) {
    const Vec3& x_m = mesh.positions_m[i];
    if (x_m.allFinite() && x_m.cwiseAbs().maxCoeff() <= kFarthestVertex_m) continue;
    throw bad_data(file, fmt::format("vertex {}", i),
                   fmt::format("lies at {}, {}, {}; must be finite and within {} m; surfaces are in metres, divide "
                               "millimetres by 1000",
                               to_text(x_m.x()), to_text(x_m.y()), to_text(x_m.z()), kFarthestVertex_m));
  }
}

void note_defects(const geometry::TriangleMesh& mesh, const std::string& file, std::vector<std::string>& notes) {
  const SurfaceDefects defects = find_defects(mesh);
  if (defects.triangles_without_area > 0)
    notes.push_back(fmt::format("{}: {} of {} triangles have no area; they are felt as the lines that they are", file,
                                defects.triangles_without_area, mesh.triangles.size()));
  if (defects.non_manifold_edges > 0)
    notes.push_back(
        fmt::format("{}: {} edges are not between two triangles that face the same way; \"inside\" is "
                    "decided by the nearest triangle there",
                    file, defects.non_manifold_edges));
  if (defects.border_edges > 0)
    notes.push_back(fmt::format("{}: the surface is open ({} border edges); \"inside\" means behind it", file,
                                defects.border_edges));
  Eigen::AlignedBox3d box;
  for (const Vec3& x_m : mesh.positions_m) box.extend(x_m);
  if (box.sizes().maxCoeff() > kLargeSurface_m)
    notes.push_back(fmt::format("{}: measures {:.4g} m; is it in millimetres? Surfaces are read as metres", file,
                                box.sizes().maxCoeff()));
}

}  // namespace

ProbeFrames::ProbeFrames(const std::filesystem::path& folder) {
  const std::filesystem::path table = folder / "times.csv";
  const std::string text = read_file(table);
  constexpr std::array<std::string_view, 2> columns = {"file", "t_s"};
  CsvRows rows(text, table.string(), columns);
  while (rows.next()) {
    const std::filesystem::path name(rows.field(0));
    const auto refuse = [&](const std::string& problem) {
      throw Error(ExitStatus::BadData, rows.place() + ": " + problem);
    };
    if (name.empty() || name != name.filename()) refuse("file must be the plain name of a surface in the same folder");
    if (!std::filesystem::is_regular_file(folder / name))
      refuse(fmt::format("there is no frame \"{}\" in {}; add it or take the row out", name.string(), folder.string()));
    const double t_s = rows.number(1);
    if (!t_s_.empty() && !(t_s > t_s_.back()))
      refuse(fmt::format("t_s is {} after {}; must rise from row to row", to_text(t_s), to_text(t_s_.back())));
    files_.push_back(folder / name);
    t_s_.push_back(t_s);
  }
  if (files_.empty()) throw bad_data(table.string(), "", "names no frames; must have at least one row file, t_s");
}

std::vector<Vec3> ProbeFrames::positions_m(std::size_t frame, const geometry::TriangleMesh& mesh) const {
  geometry::TriangleMesh read = geometry::read_surface(files_[frame]).mesh;
  const std::string file = files_[frame].string();
  if (read.positions_m.size() != mesh.positions_m.size()) {
    throw bad_data(file, "",
                   fmt::format("has {} vertices; must have the {} of the surface, in its order",
                               read.positions_m.size(), mesh.positions_m.size()));
  }
  if (read.triangles != mesh.triangles) {
    const auto [other, same] =
        std::mismatch(read.triangles.begin(), read.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
    throw bad_data(file, fmt::format("triangle {}", other - read.triangles.begin()),
                   "is not that of the surface; all frames must have its triangles, in its order");
  }
  require_places(read, file);
  return std::move(read.positions_m);
}

geometry::TriangleMesh load_probe_surface(const std::filesystem::path& file, std::vector<std::string>& notes) {
  geometry::SurfaceFile read = geometry::read_surface(file);
  for (const std::string& note : read.notes) notes.push_back(file.string() + ": " + note);
  if (read.mesh.triangles.size() > kMostProbeTriangles) {
    throw bad_data(file.string(), "",
                   fmt::format("has {} triangles; must have at most {}; simplify the surface",
                               read.mesh.triangles.size(), kMostProbeTriangles));
  }
  require_places(read.mesh, file.string());
  note_defects(read.mesh, file.string(), notes);
  return std::move(read.mesh);
}

}  // namespace myotact::measure

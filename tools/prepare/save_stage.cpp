#include "prepare/save_stage.h"

#include "core/file.h"
#include "core/folder.h"
#include "geometry/mesh_files.h"

namespace myotact::prepare {

namespace {

namespace fs = std::filesystem;

void save_surfaces(const fs::path& folder, const char* kind, const std::string& key,
                   const geometry::TriangleMesh& surface, const geometry::TriangleMesh& skin) {
  make_writable_folder(folder / kind);
  geometry::write_ply(surface, folder / kind / (key + ".ply"));
  if (skin.triangles.empty()) return;
  make_writable_folder(folder / "skins");
  geometry::write_ply(skin, folder / "skins" / (key + ".ply"));
}

void save_cage(const fs::path& folder, const MuscleWork& muscle) {
  if (muscle.cage.tets.nodes_m.empty()) return;
  make_writable_folder(folder / "cages");
  geometry::write_vtk({muscle.cage.tets, muscle.fibres.direction, muscle.profile.tet_section_m2, {}, {}},
                      folder / "cages" / (muscle.data.mechanics.key + ".vtk"));
}

}  // namespace

void save_stage(const LimbWork& limb, const fs::path& folder) {
  write_folder(folder, "stage.jsonl", [&](const fs::path& fresh) {
    std::vector<SurfaceReport> reports;
    for (const BoneWork& bone : limb.bones) {
      save_surfaces(fresh, "bones", bone.data.key, bone.surface, bone.skin);
      reports.push_back(bone.report);
    }
    for (const MuscleWork& muscle : limb.muscles) {
      save_surfaces(fresh, "muscles", muscle.data.mechanics.key, muscle.surface, muscle.skin);
      save_cage(fresh, muscle);
      reports.push_back(muscle.report);
    }
    write_file(fresh / "stage.jsonl", report_json_lines(reports));
  });
}

}  // namespace myotact::prepare

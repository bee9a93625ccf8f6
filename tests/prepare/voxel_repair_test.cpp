// Surfaces of voxels: edges with four triangles, vertices with several fans.

#include <filesystem>
#include <random>

#include <gtest/gtest.h>

#include "core/at.h"
#include "geometry/mesh_files.h"
#include "prepare/repair/repair_surface.h"
#include "prepare/repair/surface_check.h"
#include "prepare/shapes.h"
#include "prepare/surface/edge_table.h"
#include "prepare/surface/surface_pieces.h"
#include "prepare/voxel_surfaces.h"
#include "support/source_folder.h"

namespace myotact::prepare {
namespace {

using geometry::TriangleMesh;
using testing::cuberille;

constexpr double kStep_m = 0.005;
constexpr double kVoxel_m3 = kStep_m * kStep_m * kStep_m;

/// Fans are pulled apart by a hundredth of a millimetre.
constexpr double kPulled_m = 5e-5;

RepairResult repaired(const TriangleMesh& mesh, bool several_bodies = false) {
  RepairSettings settings;
  settings.several_bodies = several_bodies;
  return repair_surface("voxels", mesh, settings);
}

int euler_characteristic(const TriangleMesh& mesh) {
  return static_cast<int>(mesh.positions_m.size()) - static_cast<int>(mesh.triangles.size()) / 2;
}

TEST(VoxelRepair, PartsBlocksThatTouchAlongAnEdge) {
  const TriangleMesh mesh = cuberille(4, kStep_m, [](int x, int y, int) { return (x < 2) == (y < 2); });
  ASSERT_EQ(count_edges(mesh).crowded, 4);
  const RepairResult result = repaired(mesh, true);
  EXPECT_FALSE(find_defect(result.mesh));
  EXPECT_EQ(pieces_of(result.mesh).size(), 2u);
  EXPECT_NEAR(geometry::enclosed_volume_m3(result.mesh), 32.0 * kVoxel_m3, 1e-2 * kVoxel_m3);
  EXPECT_LT(result.hausdorff_m, kPulled_m);
}

TEST(VoxelRepair, PartsBlocksThatTouchAtACorner) {
  const TriangleMesh mesh =
      cuberille(4, kStep_m, [](int x, int y, int z) { return (x < 2 && y < 2 && z < 2) || (x > 1 && y > 1 && z > 1); });
  const RepairResult result = repaired(mesh, true);
  EXPECT_FALSE(find_defect(result.mesh));
  EXPECT_EQ(pieces_of(result.mesh).size(), 2u);
  EXPECT_NEAR(geometry::enclosed_volume_m3(result.mesh), 16.0 * kVoxel_m3, 1e-2 * kVoxel_m3);
}

/// Between two slabs two cubes meet along one edge: the body holds together at both of its ends, so that it can only be
/// joined there. Apart, it would be a ring about a tunnel of no width.
TEST(VoxelRepair, JoinsABodyThatHoldsTogetherAtBothEndsOfAnEdge) {
  for (const int layers : {1, 2}) {
    const TriangleMesh mesh = cuberille(2 + layers, kStep_m, [&](int x, int y, int z) {
      if (x > 1 || y > 1) return false;
      return z == 0 || z == 1 + layers || x == y;
    });
    ASSERT_EQ(count_edges(mesh).crowded, layers);
    const RepairResult result = repaired(mesh);
    EXPECT_FALSE(find_defect(result.mesh));
    EXPECT_EQ(pieces_of(result.mesh).size(), 1u);
    EXPECT_EQ(euler_characteristic(result.mesh), 2) << layers;  // a ball
    EXPECT_NEAR(geometry::enclosed_volume_m3(result.mesh), (8.0 + 2.0 * layers) * kVoxel_m3, 2e-2 * kVoxel_m3);
    EXPECT_LT(result.hausdorff_m, kPulled_m);
  }
}

/// The same between two slabs as a foreign program cuts it: three edges with four triangles, one after the other.
TEST(VoxelRepair, TakesTheSurfaceNetsOfAForeignProgram) {
  const auto file = std::filesystem::path(source_folder()) / "tests/prepare/fixtures_surface/surface_nets.off";
  const TriangleMesh mesh = geometry::read_surface(file).mesh;
  ASSERT_EQ(count_edges(mesh).crowded, 3);
  const RepairResult result = repaired(mesh);
  EXPECT_FALSE(find_defect(result.mesh));
  EXPECT_EQ(pieces_of(result.mesh).size(), 1u);
  EXPECT_EQ(euler_characteristic(result.mesh), 2);
  EXPECT_NEAR(geometry::enclosed_volume_m3(result.mesh) / geometry::enclosed_volume_m3(mesh), 1.0, 1e-4);
  EXPECT_LT(result.hausdorff_m, kPulled_m);
}

/// A ball with holes of all shapes in it, from a few to a sponge: edges and corners of every kind.
TEST(VoxelRepair, MakesABodyOfEverySponge) {
  for (const int solid_percent : {60, 80, 90, 97}) {
    for (unsigned seed = 0; seed < 10; ++seed) {
      std::mt19937 random(seed);
      std::vector<bool> inside;
      int voxels = 0;
      for (int i = 0; i < 1000; ++i) {
        const Vec3 p(i % 10, i / 10 % 10, i / 100);
        inside.push_back((p - Vec3::Constant(4.5)).norm() < 4.5 && static_cast<int>(random() % 100u) < solid_percent);
        voxels += inside.back() ? 1 : 0;
      }
      const TriangleMesh mesh =
          cuberille(10, kStep_m, [&](int x, int y, int z) { return inside[at((z * 10 + y) * 10 + x)]; });
      const RepairResult result = repaired(mesh);
      EXPECT_FALSE(find_defect(result.mesh)) << solid_percent << " % " << seed;
      EXPECT_EQ(pieces_of(result.mesh).size(), 1u);
      // Loose voxels go, cavities are filled.
      EXPECT_NEAR(geometry::enclosed_volume_m3(result.mesh), voxels * kVoxel_m3, 0.15 * voxels * kVoxel_m3);
    }
  }
}

}  // namespace
}  // namespace myotact::prepare

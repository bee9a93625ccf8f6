#include "prepare/tets/tetrahedralise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "prepare/shapes.h"
#include "prepare/surface/surface_pieces.h"
#include "prepare/tets/tet_quality.h"

namespace myotact::prepare {
namespace {

using ::testing::HasSubstr;

TEST(Tetrahedralise, FillsTheWholeVolumeAndKeepsTheSurface) {
  const geometry::TriangleMesh rod = testing::rod_surface({});
  const geometry::TetMesh tets = tetrahedralise("rod", rod);
  EXPECT_NEAR(geometry::total_volume_m3(tets), geometry::enclosed_volume_m3(rod), 1e-12);
  for (std::size_t v = 0; v < rod.positions_m.size(); ++v) EXPECT_EQ(tets.nodes_m[v], rod.positions_m[v]);
  for (std::size_t t = 0; t < tets.corners.size(); ++t) EXPECT_GT(geometry::corner_volume_m3(tets, t), 0.0);
}

TEST(Tetrahedralise, TurnsTheMeshersCrashIntoAnErrorThatNamesTheCause) {
  geometry::TriangleMesh crossing = testing::rod_surface({});
  append(crossing, testing::box_surface({0.03, -0.03, -0.004}, {0.05, 0.031, 0.005}));
  try {
    tetrahedralise("rod", crossing);
    FAIL() << "was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::BadData);
    EXPECT_THAT(error.what(), HasSubstr("rod"));
    EXPECT_THAT(error.what(), HasSubstr("cross"));
  }
}

TEST(MeasureTets, KnowsTheAnglesOfARegularTet) {
  geometry::TetMesh tet;
  tet.nodes_m = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  tet.corners = {{0, 1, 2, 3}};
  const TetQuality quality = measure_tets(tet);
  EXPECT_NEAR(quality.smallest_dihedral_deg, 70.528779, 1e-5);  // arccos(1/3)
  EXPECT_NEAR(quality.shortest_edge_m, 2.8284271, 1e-6);
}

}  // namespace
}  // namespace myotact::prepare

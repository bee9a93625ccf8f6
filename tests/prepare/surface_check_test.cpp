#include "prepare/repair/surface_check.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "prepare/repair/surface_pieces.h"
#include "prepare/shapes.h"

namespace myotact::prepare {
namespace {

using geometry::TriangleMesh;
using ::testing::HasSubstr;

TriangleMesh cube() {
  return testing::box_surface(Vec3::Zero(), Vec3::Constant(0.02));
}

/// Every triangle with its own three vertices, as an STL file holds it.
TriangleMesh soup_of(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (const auto& triangle : mesh.triangles) {
    const int base = static_cast<int>(soup.positions_m.size());
    for (const int v : triangle) soup.positions_m.push_back(mesh.positions_m[static_cast<std::size_t>(v)]);
    soup.triangles.push_back({base, base + 1, base + 2});
  }
  return soup;
}

std::string refusal_of(const TriangleMesh& mesh) {
  try {
    clean_surface("belly", mesh);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::BadData);
    EXPECT_THAT(error.what(), HasSubstr("belly"));
    return error.what();
  }
  ADD_FAILURE() << "was accepted";
  return "";
}

TEST(CleanSurface, WeldsASoupIntoAClosedSurface) {
  SurfaceRepair repair;
  const TriangleMesh clean = clean_surface("belly", soup_of(cube()), &repair);
  EXPECT_EQ(clean.positions_m.size(), 8u);
  EXPECT_EQ(geometry::bad_edge_count(clean), 0);
  EXPECT_EQ(repair.welded_vertices, 28);
}

TEST(CleanSurface, LeavesAGoodSurfaceAsItIs) {
  const TriangleMesh rod = testing::rod_surface({});
  SurfaceRepair repair;
  const TriangleMesh clean = clean_surface("belly", rod, &repair);
  EXPECT_EQ(clean.triangles, rod.triangles);
  EXPECT_EQ(clean.positions_m, rod.positions_m);
  EXPECT_EQ(repair.turned_triangles + repair.dropped_triangles + repair.dropped_pieces + repair.welded_vertices, 0);
}

TEST(CleanSurface, TurnsSingleTrianglesBack) {
  TriangleMesh mesh = cube();
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  EXPECT_NEAR(geometry::enclosed_volume_m3(clean_surface("belly", mesh)), 8e-6, 1e-12);
}

TEST(CleanSurface, TurnsASurfaceThatIsInsideOut) {
  TriangleMesh mesh = cube();
  for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_NEAR(geometry::enclosed_volume_m3(clean_surface("belly", mesh)), 8e-6, 1e-12);
}

TEST(CleanSurface, DropsCopiesNeedlesAndSpecks) {
  TriangleMesh mesh = cube();
  mesh.triangles.push_back(mesh.triangles[0]);
  mesh.triangles.push_back({1, 1, 2});
  append(mesh, testing::box_surface(Vec3::Constant(0.03), Vec3::Constant(0.0305)));
  SurfaceRepair repair;
  const TriangleMesh clean = clean_surface("belly", mesh, &repair);
  EXPECT_EQ(clean.triangles.size(), 12u);
  EXPECT_EQ(repair.dropped_triangles, 2);
  EXPECT_EQ(repair.dropped_pieces, 1);
}

TEST(CleanSurface, SaysHowManyEdgesAreOpenAndWhere) {
  TriangleMesh mesh = cube();
  mesh.triangles.pop_back();
  const std::string refusal = refusal_of(mesh);
  EXPECT_THAT(refusal, HasSubstr("3 edges"));
  EXPECT_THAT(refusal, HasSubstr("near (0.0"));
}

TEST(CleanSurface, RefusesCoordinatesThatAreNotFinite) {
  TriangleMesh mesh = cube();
  mesh.positions_m[5].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal_of(mesh), HasSubstr("vertex 5"));
}

TEST(CleanSurface, RefusesMillimetres) {
  TriangleMesh mesh = cube();
  for (Vec3& p : mesh.positions_m) p *= 1e3;
  EXPECT_THAT(refusal_of(mesh), HasSubstr("in metres"));
}

TEST(CleanSurface, RefusesNothingAtAll) {
  EXPECT_THAT(refusal_of({}), HasSubstr("no triangles"));
}

TEST(CleanSurface, RefusesAFin) {
  TriangleMesh mesh = cube();
  mesh.positions_m.emplace_back(0.03, 0.03, 0.03);
  mesh.triangles.push_back({0, 1, 8});
  EXPECT_THAT(refusal_of(mesh), HasSubstr("edges"));
}

TEST(CleanSurface, RefusesTwoBodiesThatTouchInAPoint) {
  TriangleMesh mesh = cube();
  append(mesh, testing::box_surface(Vec3::Constant(0.02), Vec3::Constant(0.04)));  // welded at one corner
  EXPECT_THAT(refusal_of(mesh), HasSubstr("fan"));
}

TEST(RefuseCrossings, NamesThePlaceOfTheFirst) {
  TriangleMesh mesh = cube();
  append(mesh, testing::box_surface(Vec3::Constant(0.01), Vec3::Constant(0.03)));
  try {
    refuse_crossings("belly", mesh);
    FAIL() << "was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::BadData);
    EXPECT_THAT(error.what(), HasSubstr("cross each other, the first near (0.0"));
  }
}

TEST(RefuseCrossings, AcceptsACleanSurface) {
  EXPECT_NO_THROW(refuse_crossings("belly", cube()));
}

}  // namespace
}  // namespace myotact::prepare

#include "prepare/repair/repair_surface.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "prepare/repair/surface_check.h"
#include "prepare/shapes.h"
#include "prepare/surface/surface_pieces.h"

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

std::string refusal_of(const TriangleMesh& mesh, const RepairSettings& settings = {}) {
  try {
    repair_surface("belly", mesh, settings);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::BadData);
    EXPECT_THAT(error.what(), HasSubstr("belly"));
    return error.what();
  }
  ADD_FAILURE() << "was accepted";
  return "";
}

int count_of(const RepairResult& result, const std::string& what) {
  for (const RepairStep& step : result.steps) {
    if (step.what == what) return step.count;
  }
  return 0;
}

TEST(RepairSurface, WeldsASoupIntoAClosedSurface) {
  const RepairResult result = repair_surface("belly", soup_of(cube()));
  EXPECT_EQ(result.mesh.positions_m.size(), 8u);
  EXPECT_EQ(geometry::bad_edge_count(result.mesh), 0);
  EXPECT_EQ(count_of(result, "equal vertices welded"), 28);
  EXPECT_EQ(result.hausdorff_m, 0.0);
}

TEST(RepairSurface, LeavesAGoodSurfaceAsItIs) {
  const TriangleMesh rod = testing::rod_surface({});
  const RepairResult result = repair_surface("belly", rod);
  EXPECT_EQ(result.mesh.triangles, rod.triangles);
  EXPECT_EQ(result.mesh.positions_m, rod.positions_m);
  EXPECT_TRUE(result.steps.empty());
}

TEST(RepairSurface, TurnsSingleTrianglesBack) {
  TriangleMesh mesh = cube();
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  const RepairResult result = repair_surface("belly", mesh);
  EXPECT_NEAR(geometry::enclosed_volume_m3(result.mesh), 8e-6, 1e-12);
  EXPECT_EQ(count_of(result, "triangles flipped to their neighbours' side"), 2);
}

TEST(RepairSurface, DropsCopiesNeedlesAndSpecks) {
  TriangleMesh mesh = cube();
  mesh.triangles.push_back(mesh.triangles[0]);
  mesh.triangles.push_back({1, 1, 2});
  append(mesh, testing::box_surface(Vec3::Constant(0.03), Vec3::Constant(0.0305)));
  const RepairResult result = repair_surface("belly", mesh);
  EXPECT_EQ(result.mesh.triangles.size(), 12u);
  EXPECT_EQ(count_of(result, "copies of triangles dropped"), 1);
  EXPECT_EQ(count_of(result, "loose specks dropped"), 1);
  EXPECT_LT(result.hausdorff_m, 1e-12);
}

TEST(RepairSurface, SaysHowLargeAHoleIsAndWhere) {
  TriangleMesh mesh = cube();
  mesh.triangles.pop_back();
  const std::string refusal = refusal_of(mesh);
  EXPECT_THAT(refusal, HasSubstr("a hole with 3 edges near (0.0"));
  EXPECT_THAT(refusal, HasSubstr("9.1 %"));
  EXPECT_THAT(refusal, HasSubstr("at most 5.0 %"));
}

TEST(RepairSurface, ClosesAHoleThatTheSettingsAllow) {
  TriangleMesh mesh = cube();
  mesh.triangles.pop_back();
  RepairSettings settings;
  settings.largest_hole = 0.1;
  const RepairResult result = repair_surface("belly", mesh, settings);
  EXPECT_EQ(count_of(result, "holes closed"), 1);
  EXPECT_NEAR(geometry::enclosed_volume_m3(result.mesh), 8e-6, 1e-12);
}

TEST(RepairSurface, RefusesCoordinatesThatAreNotFinite) {
  TriangleMesh mesh = cube();
  mesh.positions_m[5].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal_of(mesh), HasSubstr("vertex 5"));
}

TEST(RepairSurface, RefusesNothingAtAll) {
  EXPECT_THAT(refusal_of({}), HasSubstr("no triangles"));
}

TEST(RepairSurface, CutsAFin) {
  TriangleMesh mesh = cube();
  mesh.positions_m.emplace_back(0.01, -0.005, -0.005);
  mesh.triangles.push_back({0, 1, 8});
  const RepairResult result = repair_surface("belly", mesh);
  EXPECT_EQ(count_of(result, "triangles of fins dropped"), 1);
  EXPECT_EQ(result.mesh.triangles, cube().triangles);
}

TEST(RepairSurface, RefusesALargeFin) {
  TriangleMesh mesh = cube();
  mesh.positions_m.emplace_back(0.01, -0.04, -0.04);
  mesh.triangles.push_back({0, 1, 8});
  EXPECT_THAT(refusal_of(mesh), HasSubstr("at most 10.0 % is dropped"));
}

TEST(RepairSurface, TwoBodiesThatTouchInAPointAreRefusedForAMuscleAndPartedForBones) {
  TriangleMesh mesh = cube();
  append(mesh, testing::box_surface(Vec3::Constant(0.02), Vec3::Constant(0.04)));
  EXPECT_THAT(refusal_of(mesh), HasSubstr("2 separate pieces"));
  RepairSettings settings;
  settings.several_bodies = true;
  const RepairResult result = repair_surface("paw", mesh, settings);
  EXPECT_EQ(pieces_of(result.mesh).size(), 2u);
  EXPECT_NEAR(geometry::enclosed_volume_m3(result.mesh), 16e-6, 1e-9);
}

TEST(RepairSurface, BonesThatLieApartStayBitForBit) {
  TriangleMesh mesh = cube();
  append(mesh, testing::box_surface(Vec3::Constant(0.021), Vec3::Constant(0.04)));
  RepairSettings settings;
  settings.several_bodies = true;
  const RepairResult result = repair_surface("paw", mesh, settings);
  EXPECT_TRUE(result.steps.empty());
  EXPECT_EQ(result.mesh.positions_m, mesh.positions_m);
  EXPECT_EQ(result.mesh.triangles, mesh.triangles);
}

TEST(RepairSurface, UnitesBodiesThatCross) {
  TriangleMesh mesh = cube();
  append(mesh, testing::box_surface(Vec3::Constant(0.01), Vec3::Constant(0.03)));
  const RepairResult result = repair_surface("belly", mesh);
  EXPECT_EQ(count_of(result, "crossing pieces united with others"), 1);
  EXPECT_NEAR(geometry::enclosed_volume_m3(result.mesh), 15e-6, 1e-12);
  EXPECT_LT(result.hausdorff_m, 1e-12);  // what lies inside the other body is no movement
}

TEST(RepairSurface, SaysHowFarTheSurfaceMoved) {
  TriangleMesh mesh = cube();
  append(mesh, testing::box_surface(Vec3::Constant(0.02), Vec3::Constant(0.04)));
  RepairSettings settings;
  settings.several_bodies = true;
  const RepairResult result = repair_surface("paw", mesh, settings);
  EXPECT_GT(result.hausdorff_m, 1e-6);  // the shared corner was pulled apart
  EXPECT_LT(result.hausdorff_m, 1e-5);
  EXPECT_NEAR((result.hausdorff_place_m - Vec3::Constant(0.02)).norm(), 0.0, 1e-3);
  settings.tolerance = 1e-6;
  EXPECT_THAT(refusal_of(mesh, settings), HasSubstr("would move by"));
}

TEST(CheckSize, RefusesMillimetres) {
  TriangleMesh mesh = cube();
  EXPECT_NO_THROW(check_size("belly", mesh));
  for (Vec3& p : mesh.positions_m) p *= 1e3;
  EXPECT_THROW(check_size("belly", mesh), Error);
}

TEST(FindDefect, NamesThePlaceOfTheFirstCrossing) {
  TriangleMesh mesh = cube();
  EXPECT_FALSE(find_defect(mesh));
  append(mesh, testing::box_surface(Vec3::Constant(0.01), Vec3::Constant(0.03)));
  const auto defect = find_defect(mesh);
  ASSERT_TRUE(defect);
  EXPECT_THAT(defect->problem, HasSubstr("cross each other"));
}

TEST(FindDefect, FindsASharedVertex) {
  TriangleMesh mesh = cube();
  TriangleMesh other = testing::box_surface(Vec3::Constant(0.02), Vec3::Constant(0.04));
  append(mesh, other);
  for (auto& triangle : mesh.triangles) {
    for (int& v : triangle) v = v == 8 ? 7 : v;  // the first box's last corner is the second's first
  }
  mesh.positions_m[8] = mesh.positions_m[15];
  for (auto& triangle : mesh.triangles) {
    for (int& v : triangle) v = v == 15 ? 8 : v;
  }
  mesh.positions_m.pop_back();
  const auto defect = find_defect(mesh);
  ASSERT_TRUE(defect);
  EXPECT_THAT(defect->problem, HasSubstr("fan"));
}

}  // namespace
}  // namespace myotact::prepare

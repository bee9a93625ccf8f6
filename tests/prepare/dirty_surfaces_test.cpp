// Every kind of dirt on every body: what comes out is right or is refused with its cause; nothing crashes or hangs.

#include "prepare/dirty_surfaces.h"

#include <cmath>
#include <ctime>
#include <iostream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "prepare/repair/repair_surface.h"
#include "prepare/repair/surface_check.h"
#include "prepare/surface/surface_pieces.h"

namespace myotact::prepare {
namespace {

using geometry::TriangleMesh;
using testing::DirtyKind;
using testing::Expected;
using ::testing::HasSubstr;
using testing::TubeBody;

/// No repair of a part may take longer, in time of the processor [s], which other programs do not lengthen; without
/// optimisation and with sanitizers it takes a hundred times as long.
#if defined(__SANITIZE_ADDRESS__) || !defined(NDEBUG)
constexpr double kLongest_s = 200.0;
#else
constexpr double kLongest_s = 10.0;
#endif

std::string text_of(const std::vector<RepairStep>& steps) {
  std::string text;
  for (const RepairStep& step : steps) text += (text.empty() ? "" : ", ") + fmt::format("{} {}", step.count, step.what);
  return text;
}

/// 2 for a ball, 0 for a ring.
int euler_characteristic(const TriangleMesh& mesh) {
  return static_cast<int>(mesh.positions_m.size()) - static_cast<int>(mesh.triangles.size()) / 2;
}

void check_repaired(const DirtyKind& kind, const TubeBody& body, const TriangleMesh& raw, const RepairResult& result) {
  const TriangleMesh& mesh = result.mesh;
  const auto defect = find_defect(mesh);
  EXPECT_FALSE(defect) << defect->problem;
  EXPECT_EQ(pieces_of(mesh).size(), 1u);
  const double clean_m3 = geometry::enclosed_volume_m3(body.mesh) * std::pow(kind.unit, 3);
  const double volume_m3 = geometry::enclosed_volume_m3(mesh);
  EXPECT_GT(volume_m3, 0.0);
  if (kind.volume > 0.0) {
    EXPECT_NEAR(volume_m3 / clean_m3, kind.volume, kind.volume_tolerance);
  }
  if (kind.expected == Expected::Untouched) {
    EXPECT_TRUE(result.steps.empty()) << text_of(result.steps);
    EXPECT_EQ(mesh.positions_m, raw.positions_m);
    EXPECT_EQ(mesh.triangles, raw.triangles);
  } else {
    EXPECT_THAT(text_of(result.steps), HasSubstr(kind.cause));
  }
}

class DirtySurfaces : public ::testing::Test {
 protected:
  void check(const DirtyKind& kind, const TubeBody& body) {
    SCOPED_TRACE(kind.name + " on the " + body.name);
    std::mt19937 random(7);
    const TriangleMesh raw = kind.make(body, random);
    const auto start = std::clock();
    std::string outcome;
    try {
      const RepairResult result = repair_surface("belly", raw);
      outcome = result.steps.empty() ? "untouched" : "repaired: " + text_of(result.steps);
      outcome += fmt::format("; moved {:.1e} m, volume {:+.2f} %", result.hausdorff_m,
                             100.0 * (geometry::enclosed_volume_m3(result.mesh) / std::pow(kind.unit, 3) /
                                          geometry::enclosed_volume_m3(body.mesh) -
                                      1.0));
      EXPECT_NE(kind.expected, Expected::Refused) << "was accepted";
      check_repaired(kind, body, raw, result);
    } catch (const Error& error) {
      outcome = std::string("refused: ") + error.what();
      EXPECT_EQ(kind.expected, Expected::Refused) << error.what();
      EXPECT_EQ(error.status(), ExitStatus::BadData);
      EXPECT_THAT(error.what(), HasSubstr("belly"));
      EXPECT_THAT(error.what(), HasSubstr(kind.cause));
    }
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    EXPECT_LT(seconds, kLongest_s);
    std::cout << fmt::format("{:<36} {:<7} {:6.3f} s  {}\n", kind.name, body.name, seconds, outcome) << std::flush;
  }
};

/// On each of the bodies.
class DirtyBodies : public DirtySurfaces, public ::testing::WithParamInterface<int> {
 protected:
  void check_all(const std::vector<DirtyKind>& kinds) {
    const TubeBody body = testing::dirty_bodies()[static_cast<std::size_t>(GetParam())];
    for (const DirtyKind& kind : kinds) check(kind, body);
  }
};

TEST_P(DirtyBodies, DefectsOfOneBodyAreRepairedOrNamed) {
  check_all(testing::body_defects());
}

TEST_P(DirtyBodies, PiecesCrossingsAndUnitsAreRepairedOrNamed) {
  check_all(testing::piece_defects());
}

INSTANTIATE_TEST_SUITE_P(SphereMuscleSheet, DirtyBodies, ::testing::Range(0, 3));

TEST_F(DirtySurfaces, LoneSurfacesAreRepairedOrNamed) {
  for (const DirtyKind& kind : testing::lone_surfaces()) check(kind, testing::sphere_body());
}

TEST_F(DirtySurfaces, ThereAreEnoughKinds) {
  EXPECT_GE(testing::body_defects().size() + testing::piece_defects().size() + testing::lone_surfaces().size(), 45u);
}

TEST_F(DirtySurfaces, ARingStaysARing) {
  for (const DirtyKind& kind : testing::lone_surfaces()) {
    if (kind.name != "a torus with a hole") continue;
    std::mt19937 random;
    const TriangleMesh raw = kind.make(testing::sphere_body(), random);
    EXPECT_EQ(euler_characteristic(repair_surface("ring", raw).mesh), 0);
  }
}

TEST_F(DirtySurfaces, TheSameInputGivesTheSameBits) {
  for (const DirtyKind& kind : testing::body_defects()) {
    if (kind.expected != Expected::Repaired) continue;
    std::mt19937 first(3), second(3);
    const RepairResult a = repair_surface("belly", kind.make(testing::muscle_body(), first));
    const RepairResult b = repair_surface("belly", kind.make(testing::muscle_body(), second));
    EXPECT_EQ(a.mesh.positions_m, b.mesh.positions_m) << kind.name;
    EXPECT_EQ(a.mesh.triangles, b.mesh.triangles) << kind.name;
  }
}

}  // namespace
}  // namespace myotact::prepare

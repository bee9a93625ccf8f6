#include "view/render/skin_tissue.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/at.h"
#include "core/data_folder.h"
#include "geometry/plain_surfaces.h"
#include "support/synthetic_specimen.h"
#include "view/render/attachment_areas.h"
#include "view/render/strand_coordinates.h"

namespace myotact::view {
namespace {

/// Largest change of a value along an edge, over the edge's length.
double steepest_1_m(const geometry::TriangleMesh& surface, const std::vector<float>& values) {
  double steepest = 0.0;
  for (const auto& triangle : surface.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = at(triangle[k]), b = at(triangle[(k + 1) % 3]);
      const double length_m = (surface.positions_m[a] - surface.positions_m[b]).norm();
      steepest = std::max(steepest, std::abs(double(values[a]) - double(values[b])) / std::max(length_m, 1e-9));
    }
  }
  return steepest;
}

TEST(SkinTissue, ABarsTendonBeginsWhereItsTetsSayAndRisesTowardsTheInsertion) {
  const myotact::testing::BarShape shape{{-0.09, 0.0, 0.03}, 0.12, 0.02, {12, 2, 2}, 5};  // cells of 10 mm
  const auto muscle = myotact::testing::bar_muscle("bar", shape);
  const SkinTissue tissue = skin_tissue(muscle, nullptr);
  constexpr double kBorder_m = -0.09 + 7 * 0.01;
  for (std::size_t i = 0; i < tissue.tendons.size(); ++i) {
    const double beyond_m = muscle.skin.positions_m[i].x() - kBorder_m;
    EXPECT_GE(tissue.tendons[i], 0.0f);
    EXPECT_LE(tissue.tendons[i], 1.0f);
    if (beyond_m < -0.011) {
      EXPECT_LT(tissue.tendons[i], 0.1f);
    }
    if (beyond_m > 0.031) {
      EXPECT_GT(tissue.tendons[i], 0.9f);
    }
    EXPECT_GT(tissue.fibres[i].x(), 0.999);
  }
}

TEST(SkinTissue, InEveryMuscleOfTheLimbsTendonIsAShareAndBlends) {
  for (const char* name : {"canine_elbow", "canine_forelimb", "canine_hindlimb"}) {
    const auto specimen = anatomy::load_specimen(data_folder() / "meshes" / name);
    int with_both = 0;
    for (std::size_t m = 0; m < specimen.muscles.size(); ++m) {
      const anatomy::Muscle& muscle = specimen.muscles[m];
      const SkinTissue tissue = skin_tissue(muscle, line_of(specimen, static_cast<int>(m)));
      const auto [least, most] = std::minmax_element(tissue.tendons.begin(), tissue.tendons.end());
      EXPECT_GE(*least, 0.0f) << muscle.key;
      EXPECT_LE(*most, 1.0f) << muscle.key;
      // Rounding of float: edges of 0.1 mm and more.
      EXPECT_LE(steepest_1_m(muscle.skin, tissue.tendons), 1.01 / kTendonBlend_m) << muscle.key;
      for (const Vec3& fibre : tissue.fibres) ASSERT_NEAR(fibre.norm(), 1.0, 1e-9) << muscle.key;
      with_both += *least < 0.05f && *most > 0.9f ? 1 : 0;
    }
    EXPECT_GT(with_both, static_cast<int>(specimen.muscles.size()) / 2) << name;
  }
}

TEST(SkinTissue, ASlopeIsLimitedToTheDistanceAlongTheEdges) {
  const geometry::TriangleMesh plane = geometry::make_plane(0.1, 20);  // squares of 5 mm
  std::vector<float> values(plane.positions_m.size(), 1.0f);
  std::size_t corner = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (plane.positions_m[i].x() + plane.positions_m[i].y() <
        plane.positions_m[corner].x() + plane.positions_m[corner].y()) {
      corner = i;
    }
  }
  values[corner] = 0.0f;
  constexpr double kWay_m = 0.05;
  limit_slope(plane, kWay_m, values);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Vec3 way = plane.positions_m[i] - plane.positions_m[corner];
    const bool on_a_side = way.x() < 1e-9 || way.y() < 1e-9;
    if (on_a_side) {
      EXPECT_NEAR(values[i], std::min(way.norm() / kWay_m, 1.0), 1e-4);
    }
    EXPECT_GE(values[i], std::min(way.norm() / kWay_m, 1.0) - 1e-4);  // no way is shorter than the straight one
  }
}

TEST(SkinTissue, NeighboursAlongTheFibresLieAheadAndBehind) {
  const auto muscle = myotact::testing::bar_muscle("bar", {});
  const SkinTissue tissue = skin_tissue(muscle, nullptr);
  const auto neighbours = neighbours_along(muscle.skin, tissue.fibres);
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    const auto x = [&](int j) { return muscle.skin.positions_m[at(j)].x(); };
    EXPECT_GE(x(neighbours[i][0]), x(neighbours[i][1]));
    const bool inside_an_end = x(neighbours[i][0]) == x(neighbours[i][1]);  // all its edges lie in the end's face
    EXPECT_TRUE(!inside_an_end || std::abs(std::abs(x(static_cast<int>(i)) + 0.03) - 0.06) < 1e-9);
  }
}

TEST(StrandCoordinates, ChangeAcrossTheFibresByAMetreAMetreAndHardlyAlongThem) {
  const auto muscle = myotact::testing::bar_muscle("bar", {{-0.09, 0.0, 0.03}, 0.12, 0.02, {24, 4, 4}});
  const std::vector<Vec3> fibres(muscle.skin.positions_m.size(), Vec3::UnitX());
  const auto strands_m = strand_coordinates(muscle.skin, fibres);
  double along = 0.0, across = 0.0;  // of ways along and across
  int ways_along = 0, ways_across = 0;
  for (const auto& triangle : muscle.skin.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = at(triangle[k]), b = at(triangle[(k + 1) % 3]);
      const Vec3 way = muscle.skin.positions_m[b] - muscle.skin.positions_m[a];
      const bool in_middle = std::abs(muscle.skin.positions_m[a].x() + 0.03) < 0.04;  // the ends are cut strands
      const double change = double(glm::length(strands_m[b] - strands_m[a])) / way.norm();
      if (!in_middle) continue;
      if (std::abs(way.normalized().x()) > 0.999) {
        along += change;
        ++ways_along;
      } else if (std::abs(way.normalized().x()) < 0.001) {
        across += change;
        ++ways_across;
      }
    }
  }
  ASSERT_GT(ways_along, 100);
  ASSERT_GT(ways_across, 100);
  EXPECT_LT(along / ways_along, 0.15);
  EXPECT_NEAR(across / ways_across, 1.0, 0.15);
}

}  // namespace
}  // namespace myotact::view

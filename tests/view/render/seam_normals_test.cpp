#include "view/render/seam_normals.h"

#include <gtest/gtest.h>

#include "support/synthetic_specimen.h"
#include "view/look/posing.h"

namespace myotact::view {
namespace {

/// Two halves of a box of 80 x 20 x 20 mm, cut across at x = 0: both have the cut's face.
class Halves : public ::testing::Test {
 protected:
  Halves() {
    for (const double x_m : {-0.04, 0.0}) {
      halves_.push_back(myotact::testing::boundary_surface(
          myotact::testing::box_mesh({x_m, -0.01, -0.01}, {0.04, 0.02, 0.02}, {4, 4, 4})));
    }
    for (const auto& half : halves_) {
      surfaces_.push_back(&half);
      for (const Vec3& p : half.positions_m) positions_m_.push_back(to_glm(p));
    }
  }
  bool at_cut(std::size_t i) const { return std::abs(positions_m_[i].x) < 1e-6f; }
  /// On the edge round the cut, but on none of the box's own edges.
  bool on_seam_of_a_flat_side(std::size_t i) const {
    const glm::vec3 p = glm::abs(positions_m_[i]);
    return at_cut(i) && (p.y > 0.0099f) != (p.z > 0.0099f);
  }

  std::vector<geometry::TriangleMesh> halves_;
  std::vector<const geometry::TriangleMesh*> surfaces_;
  std::vector<glm::vec3> positions_m_, normals_;
};

TEST_F(Halves, AtTheSeamNormalsAreThoseOfTheWholeBox) {
  const SeamNormals seams(surfaces_);
  seams.compute(positions_m_, normals_);
  int on_seam = 0;
  for (std::size_t i = 0; i < positions_m_.size(); ++i) {
    EXPECT_NEAR(glm::length(normals_[i]), 1.0f, 1e-5f);
    if (!on_seam_of_a_flat_side(i)) continue;
    ++on_seam;
    const glm::vec3 p = positions_m_[i];
    const glm::vec3 side = std::abs(p.y) > 0.0099f ? glm::vec3(0, p.y, 0) : glm::vec3(0, 0, p.z);
    EXPECT_GT(glm::dot(normals_[i], glm::normalize(side)), 0.99999f);  // the edge of one half alone: 0.71
    EXPECT_TRUE(seams.at_seam()[i]);
  }
  EXPECT_EQ(on_seam, 2 * 4 * 3);
}

TEST_F(Halves, VerticesAtOnePlaceHaveTheSameNormalBitForBit) {
  SeamNormals(surfaces_).compute(positions_m_, normals_);
  const std::size_t first = halves_[0].positions_m.size();
  int pairs = 0;
  for (std::size_t i = 0; i < first; ++i) {
    for (std::size_t j = first; j < positions_m_.size(); ++j) {
      if (positions_m_[i] != positions_m_[j] || !SeamNormals(surfaces_).at_seam()[i]) continue;
      EXPECT_EQ(normals_[i], normals_[j]);
      ++pairs;
    }
  }
  EXPECT_EQ(pairs, 16);  // round a face of 4 x 4 squares
}

TEST_F(Halves, InsideTheFaceThatBothHaveEachKeepsItsOwn) {
  SeamNormals(surfaces_).compute(positions_m_, normals_);
  for (std::size_t i = 0; i < positions_m_.size(); ++i) {
    const glm::vec3 p = glm::abs(positions_m_[i]);
    if (!at_cut(i) || p.y > 0.0099f || p.z > 0.0099f) continue;
    EXPECT_NEAR(normals_[i].x, i < halves_[0].positions_m.size() ? 1.0f : -1.0f, 1e-5f);
  }
}

TEST_F(Halves, CarriedApartTheyAreTwo) {
  const SeamNormals seams(surfaces_);
  const std::size_t first = halves_[0].positions_m.size();
  std::vector<glm::vec3> apart_m = positions_m_;
  for (std::size_t i = first; i < apart_m.size(); ++i) {
    apart_m[i] += glm::vec3(0.0f, 1.5f * SeamNormals::kTornApart_m, 0.0f);
  }
  // One of them bends upward: the other's normals no longer follow.
  for (std::size_t i = first; i < apart_m.size(); ++i) apart_m[i].z += 0.5f * apart_m[i].x;
  seams.compute(apart_m, normals_);
  for (std::size_t i = 0; i < first; ++i) {
    if (on_seam_of_a_flat_side(i) && positions_m_[i].z > 0.0099f) {
      EXPECT_GT(normals_[i].z, 0.99999f);
    }
  }
}

TEST(SeamNormals, OfASurfaceAloneAreItsVertexNormals) {
  const auto muscle = myotact::testing::bar_muscle("bar", {});
  const std::vector<const geometry::TriangleMesh*> surfaces{&muscle.skin};
  std::vector<glm::vec3> positions_m, normals;
  for (const Vec3& p : muscle.skin.positions_m) positions_m.push_back(to_glm(p));
  SeamNormals(surfaces).compute(positions_m, normals);
  const auto expected = geometry::vertex_normals(muscle.skin);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    EXPECT_LT(glm::distance(normals[i], to_glm(expected[i])), 1e-4f);
  }
}

}  // namespace
}  // namespace myotact::view

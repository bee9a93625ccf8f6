#include "view/render/ground_shadow.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "support/synthetic_specimen.h"
#include "view/view_frame.h"

namespace myotact::view {
namespace {

class GroundShadow : public ::testing::Test {
 protected:
  DrawMesh at(float ground_m) const {
    DrawMesh mesh;
    add_ground_shadow(mesh, specimen_, frame_, ground_m);
    return mesh;
  }
  float lowest_m() const {
    double lowest = 1.0;
    for (const auto& bone : specimen_.bones) {
      for (const Vec3& p : bone.surface.positions_m) lowest = std::min(lowest, p.z());
    }
    return static_cast<float>(lowest);
  }

  anatomy::Specimen specimen_ = myotact::testing::hinged_bones();  // along x through the origin
  messages::SceneFrame frame_ = myotact::testing::frame_at_rest(specimen_);
};

TEST_F(GroundShadow, IsDarkestBelowWhatStandsThereAndFadesToNothing) {
  const DrawMesh shadow = at(lowest_m());
  ASSERT_FALSE(shadow.indices.empty());
  const auto darker = [](const DrawVertex& a, const DrawVertex& b) { return a.colour.a < b.colour.a; };
  const DrawVertex middle = *std::max_element(shadow.vertices.begin(), shadow.vertices.end(), darker);
  EXPECT_NEAR(middle.position.y, 0.0f, 1e-3f);
  EXPECT_NEAR(middle.position.z, lowest_m(), 1e-6f);
  EXPECT_GT(middle.colour.a, 0.3f);
  EXPECT_LT(std::min_element(shadow.vertices.begin(), shadow.vertices.end(), darker)->colour.a, 1e-6f);
  float wide_m = 0.0f, long_m = 0.0f;
  for (const DrawVertex& vertex : shadow.vertices) {
    wide_m = std::max(wide_m, std::abs(vertex.position.y));
    long_m = std::max(long_m, std::abs(vertex.position.x - middle.position.x));
  }
  EXPECT_GT(long_m, 2.0f * wide_m);  // as the bones lie
  for (const std::uint32_t i : shadow.indices) ASSERT_LT(i, shadow.vertices.size());
}

TEST_F(GroundShadow, IsWeakerTheHigherTheLimbAndGoneWhereNothingIsNear) {
  const auto darkest = [](const DrawMesh& mesh) {
    float most = 0.0f;
    for (const DrawVertex& vertex : mesh.vertices) most = std::max(most, vertex.colour.a);
    return most;
  };
  EXPECT_GT(darkest(at(lowest_m())), darkest(at(lowest_m() - 0.02f)));
  EXPECT_GT(darkest(at(lowest_m() - 0.02f)), 0.0f);
  EXPECT_TRUE(at(lowest_m() - 0.05f).vertices.empty());
}

}  // namespace
}  // namespace myotact::view

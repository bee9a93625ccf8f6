#include "view/pictures/limb_model.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/synthetic_specimen.h"
#include "view/look/start_view.h"

namespace myotact::view {
namespace {

const std::vector<std::pair<std::string, std::string>>& extras_of(const geometry::GlbScene& model, std::size_t group) {
  return model.groups[group].nodes.at(0).extras;
}

TEST(LimbModel, HasEveryBoneAndMuscleWithKeyAndUnitNormals) {
  const anatomy::Specimen specimen = testing::antagonist_hinge();
  const geometry::GlbScene model = limb_model(specimen, {}, start_view(specimen, 1.0f));
  ASSERT_EQ(model.groups.size(), 2u);
  EXPECT_EQ(model.groups[0].nodes.size(), specimen.bones.size());
  ASSERT_EQ(model.groups[1].nodes.size(), specimen.muscles.size());
  EXPECT_EQ(extras_of(model, 0)[0], (std::pair<std::string, std::string>("key", specimen.bones[0].key)));
  EXPECT_EQ(extras_of(model, 1)[0], (std::pair<std::string, std::string>("key", specimen.muscles[0].key)));
  for (const geometry::GlbGroup& group : model.groups) {
    for (const geometry::GlbNode& node : group.nodes) {
      ASSERT_EQ(node.normals.size(), node.positions_m.size());
      for (const auto& n : node.normals) EXPECT_NEAR(std::hypot(n[0], n[1], n[2]), 1.0f, 1e-4f);
    }
  }
}

TEST(LimbModel, StandsAsInTheFrame) {
  const anatomy::Specimen specimen = testing::antagonist_hinge();
  messages::SceneFrame frame;
  frame.body_poses.assign(specimen.bodies.size(), {1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0});
  for (const anatomy::Muscle& muscle : specimen.muscles) {
    frame.skins_world_m.emplace_back(muscle.skin.positions_m.size(), std::array<float, 3>{7.0f, 8.0f, 9.0f});
  }
  const geometry::GlbScene model = limb_model(specimen, frame, start_view(specimen, 1.0f));
  EXPECT_NEAR(model.groups[0].nodes[0].positions_m[0][0], specimen.bones[0].surface.positions_m[0].x() + 0.5, 1e-6);
  EXPECT_EQ(model.groups[1].nodes[0].positions_m[0], (std::array<float, 3>{7.0f, 8.0f, 9.0f}));
}

TEST(LimbModel, LeavesOutWhatIsHiddenAndFadesWhatIsFaded) {
  const anatomy::Specimen specimen = testing::antagonist_hinge();
  ViewState view = start_view(specimen, 1.0f);
  view.muscles[0].hidden = true;
  view.bones[0].faded = true;
  const geometry::GlbScene model = limb_model(specimen, {}, view);
  EXPECT_EQ(model.groups[1].nodes.size(), specimen.muscles.size() - 1);
  const int faded = model.groups[0].nodes[0].surfaces[0].material,
            whole = model.groups[0].nodes[1].surfaces[0].material;
  EXPECT_LT(model.materials[static_cast<std::size_t>(faded)].colour[3], 0.5f);
  EXPECT_EQ(model.materials[static_cast<std::size_t>(whole)].colour[3], 1.0f);
}

}  // namespace
}  // namespace myotact::view

// What is painted on muscles: fibres, attachments, colours and what they mean.

#include <algorithm>

#include <gtest/gtest.h>

#include "support/synthetic_specimen.h"
#include "view/charts/colour_map.h"
#include "view/look/posing.h"
#include "view/look/start_view.h"
#include "view/overlay/scene_overlay.h"
#include "view/render/attachment_areas.h"
#include "view/render/fibre_strokes.h"
#include "view/render/muscle_colour.h"
#include "view/ui/text.h"
#include "view/view_frame.h"

namespace myotact::view {
namespace {

class MuscleDrawing : public ::testing::Test {
 protected:
  MuscleTint tint(MuscleColour colour, std::size_t m = 0) const {
    return tint_muscles(specimen_, frame_, colour, 0)[m];
  }

  anatomy::Specimen specimen_ = myotact::testing::antagonist_hinge();  // bars of 120 mm along x
  messages::SceneFrame frame_ = myotact::testing::frame_at_rest(specimen_);
};

TEST_F(MuscleDrawing, StrokesRunAlongTheFibresAndNoneWhereFibresEndInTheSkin) {
  const anatomy::Muscle& muscle = specimen_.muscles[0];
  const auto strokes = fibre_strokes(muscle);
  ASSERT_GT(strokes.size(), 100u);
  for (const FibreStroke& stroke : strokes) {
    const auto& triangle = muscle.skin.triangles[static_cast<std::size_t>(stroke.triangle)];
    glm::vec3 ends[2] = {glm::vec3(0.0f), glm::vec3(0.0f)};
    for (int corner = 0; corner < 3; ++corner) {
      const glm::vec3 p =
          to_glm(muscle.skin.positions_m[static_cast<std::size_t>(triangle[static_cast<std::size_t>(corner)])]);
      for (std::size_t end = 0; end < 2; ++end) ends[end] += stroke.shares[end][corner] * p;
    }
    const glm::vec3 way = ends[1] - ends[0];
    EXPECT_GT(way.x, 0.99f * glm::length(way));  // from origin to insertion, not across
    EXPECT_GT(glm::length(way), 3e-3f);
    // The caps, whose plane the fibres pierce, stay bare.
    EXPECT_TRUE(ends[0].x > -0.095f && ends[1].x < 0.035f);
    EXPECT_FALSE(std::abs(ends[0].x - ends[1].x) < 1e-4f);
  }
}

TEST_F(MuscleDrawing, OriginAndInsertionAreTheEndsOfTheBar) {
  const anatomy::Muscle& muscle = specimen_.muscles[0];
  const auto areas = attachment_areas(muscle, line_of(specimen_, 0));
  constexpr double kHalfCell_m = 0.01;  // the nodes that hang on bones are those of the ends, 20 mm from the next
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const double from_origin_m = muscle.skin.positions_m[i].x() + 0.09;
    const double from_insertion_m = 0.03 - muscle.skin.positions_m[i].x();
    if (from_origin_m < 0.99 * kHalfCell_m) {
      EXPECT_EQ(areas[i], AttachmentEnd::Origin);
    } else if (from_insertion_m < 0.99 * kHalfCell_m) {
      EXPECT_EQ(areas[i], AttachmentEnd::Insertion);
    } else if (std::min(from_origin_m, from_insertion_m) > 1.01 * kHalfCell_m) {
      EXPECT_EQ(areas[i], AttachmentEnd::None);
    }
  }
}

TEST_F(MuscleDrawing, AtRestIsCalmAndFullIsTheEndOfTheScaleWithTheDensestStripes) {
  EXPECT_EQ(tint(MuscleColour::Activation).colour, kIdleMuscle);
  EXPECT_EQ(tint(MuscleColour::Activation).stripe_m, 0.0f);
  EXPECT_EQ(tint(MuscleColour::Activation).share, 0.0f);  // the muscle's own look
  frame_.activations[0] = 1.0;
  EXPECT_EQ(tint(MuscleColour::Activation).colour, red_yellow(1.0));
  EXPECT_GT(tint(MuscleColour::Activation).share, 0.5f);
  const float densest_m = tint(MuscleColour::Activation).stripe_m;
  frame_.activations[0] = 0.4;
  EXPECT_NEAR(tint(MuscleColour::Activation).stripe_m, 2.5f * densest_m, 1e-6f);
  EXPECT_EQ(tint(MuscleColour::Activation, 1).colour, kIdleMuscle);
}

TEST_F(MuscleDrawing, SignsHaveTheirColours) {
  frame_.stretches = {1.3, 0.7};
  EXPECT_GT(tint(MuscleColour::Stretch, 0).colour.r, tint(MuscleColour::Stretch, 0).colour.b);
  EXPECT_GT(tint(MuscleColour::Stretch, 1).colour.b, tint(MuscleColour::Stretch, 1).colour.r);
  frame_.joints[0].muscles[0].stiffness_Nm_rad = 3.0;
  frame_.joints[0].muscles[1].stiffness_Nm_rad = -1.0;
  EXPECT_EQ(tint(MuscleColour::StiffnessShare, 0).colour, blue_orange(0.75));
  EXPECT_EQ(tint(MuscleColour::StiffnessShare, 1).colour, blue_orange(-0.25));
}

TEST_F(MuscleDrawing, FlexorsAndExtensorsDifferInColourAndPattern) {
  const MuscleTint flexor = tint(MuscleColour::Kind, 0), extensor = tint(MuscleColour::Kind, 1);
  EXPECT_GT(glm::distance(flexor.colour, extensor.colour), 0.5f);
  EXPECT_NE(flexor.stripe_m, extensor.stripe_m);
}

TEST_F(MuscleDrawing, EveryColourHasALegendWithTextsInBothLanguages) {
  for (const char* language : {"en", "de"}) {
    ui::set_language(language);
    for (int c = 0; c <= static_cast<int>(MuscleColour::Pressure); ++c) {
      ViewState view = start_view(specimen_, 1.0f);
      view.colour = static_cast<MuscleColour>(c);
      view.attachments = true;
      const Legend legend = legend_of(specimen_, view);
      EXPECT_TRUE(ui::has_text(legend.title_key)) << legend.title_key;
      EXPECT_TRUE(*legend.unit_key == '\0' || ui::has_text(legend.unit_key)) << legend.unit_key;
      for (const auto& entry : legend.entries) EXPECT_TRUE(ui::has_text(entry.key)) << entry.key;
      EXPECT_NE(legend.scale.empty(), legend.lowest < legend.highest);
    }
  }
  ui::set_language("en");
}

TEST(SceneOverlay, LengthsOfTheScaleBarAreRound) {
  EXPECT_DOUBLE_EQ(round_length_m(0.073), 0.05);
  EXPECT_DOUBLE_EQ(round_length_m(0.021), 0.02);
  EXPECT_DOUBLE_EQ(round_length_m(0.0199), 0.01);
}

}  // namespace
}  // namespace myotact::view

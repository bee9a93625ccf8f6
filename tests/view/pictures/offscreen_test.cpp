#include "view/pictures/offscreen.h"

#include <array>
#include <cstdlib>
#include <memory>
#include <set>

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/synthetic_specimen.h"
#include "view/look/limb_bounds.h"
#include "view/look/start_view.h"
#include "view/view_frame.h"

namespace myotact::view {
namespace {

using myotact::testing::frame_at_rest;

constexpr float kAspect = 4.0f / 3.0f;

class Offscreen : public ::testing::Test {
 protected:
  void SetUp() override {
    try {
      renderer_ = std::make_unique<OffscreenRenderer>(specimen_, 160, 120);
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }
  Image picture(double activation, const char* view) {
    return renderer_->render(frame_at_rest(specimen_, activation), looking(view));
  }
  ViewState looking(const char* from) const {
    ViewState view = start_view(specimen_, kAspect);
    view.camera = *standard_view(from, true, bounds_of(specimen_), kAspect);
    return view;
  }
  static std::size_t different_pixels(const Image& a, const Image& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
      count += std::abs(a.rgb[i] - b.rgb[i]) + std::abs(a.rgb[i + 1] - b.rgb[i + 1]) > 12 ? 1 : 0;
    }
    return count;
  }

  anatomy::Specimen specimen_ = myotact::testing::antagonist_hinge();
  std::unique_ptr<OffscreenRenderer> renderer_;
};

TEST_F(Offscreen, PictureIsNotBlank) {
  const Image image = picture(0.0, "lateral");
  std::set<std::array<std::uint8_t, 3>> colours;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3)
    colours.insert({image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]});
  EXPECT_GT(colours.size(), 50u);
}

TEST_F(Offscreen, MusclesChangeColourWithActivationAndViewsDiffer) {
  const Image rest = picture(0.0, "lateral");
  EXPECT_EQ(different_pixels(rest, picture(0.0, "lateral")), 0u);
  EXPECT_GT(different_pixels(rest, picture(1.0, "lateral")), 200u);
  EXPECT_GT(different_pixels(rest, picture(0.0, "cranial")), 200u);
}

TEST_F(Offscreen, ABoneInHandIsMarkedWhereItIsHeld) {
  messages::SceneFrame frame = frame_at_rest(specimen_, 0.0);
  frame.tools.resize(1);
  messages::ToolFrame& tool = frame.tools.front();
  tool.radius_m = 3e-3;
  tool.tool_world_m = tool.proxy_world_m = {0.25, 0.0, 0.0};
  tool.grip_world_m = {0.2, 0.0, 0.03};  // above the bone's end, where nothing else is
  const ViewState camera = looking("lateral");
  const Image empty_hand = renderer_->render(frame, camera);
  tool.grabbed_body = 1;
  EXPECT_GT(different_pixels(empty_hand, renderer_->render(frame, camera)), 10u);
}

TEST_F(Offscreen, EachHandAndEachShapeLooksItsOwn) {
  messages::SceneFrame frame = frame_at_rest(specimen_, 0.0);
  frame.tools.resize(2);
  for (messages::ToolFrame& tool : frame.tools) tool.radius_m = 6e-3;
  frame.tools[0].tool_world_m = frame.tools[0].proxy_world_m = {0.15, 0.0, 0.03};
  frame.tools[1].tool_world_m = frame.tools[1].proxy_world_m = {-0.1, 0.0, 0.08};
  frame.tools[1].left = true;
  const ViewState camera = looking("lateral");
  const Image balls = renderer_->render(frame, camera);
  frame.tools[1].left = false;
  EXPECT_GT(different_pixels(balls, renderer_->render(frame, camera)), 10u);  // of another colour
  frame.tools[1].left = true;
  for (const messages::ToolShape shape : {messages::ToolShape::Point, messages::ToolShape::Clamp}) {
    frame.tools[1].shape = shape;
    EXPECT_GT(different_pixels(balls, renderer_->render(frame, camera)), 10u);
  }
  frame.tools.resize(1);
  EXPECT_GT(different_pixels(balls, renderer_->render(frame, camera)), 10u);  // both were there
}

}  // namespace
}  // namespace myotact::view

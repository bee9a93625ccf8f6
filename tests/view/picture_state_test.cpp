// What a picture without a window shows of each state of the view: counted in pixels.

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>

#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "core/error.h"
#include "view/look/limb_bounds.h"
#include "view/look/picking.h"
#include "view/look/show_options.h"
#include "view/look/start_view.h"
#include "view/pictures/offscreen.h"
#include "view/view_frame.h"

namespace myotact::view {
namespace {

constexpr int kWidth = 360, kHeight = 480;
constexpr float kAspect = static_cast<float>(kWidth) / static_cast<float>(kHeight);

struct Pixel {
  int r = 0, g = 0, b = 0;
};

Pixel at(const Image& image, int x, int y) {
  const auto i = 3 * static_cast<std::size_t>(y * image.width + x);
  return {image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
}

template <typename Holds>
int count(const Image& image, const Holds& holds) {
  int pixels = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) pixels += holds(at(image, x, y)) ? 1 : 0;
  }
  return pixels;
}

int different(const Image& a, const Image& b) {
  int pixels = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const Pixel p = at(a, x, y), q = at(b, x, y);
      pixels += std::abs(p.r - q.r) + std::abs(p.g - q.g) + std::abs(p.b - q.b) > 24 ? 1 : 0;
    }
  }
  return pixels;
}

// Colours by their hue: the light changes their brightness.
bool is_blue(const Pixel& p) {
  return p.b > p.r + 40 && p.b > p.g + 10;
}
bool is_orange(const Pixel& p) {
  return p.r > p.g + 35 && p.g > p.b + 25;
}
bool is_outline(const Pixel& p) {
  return std::abs(p.r - 194) < 12 && std::abs(p.g - 46) < 12 && std::abs(p.b - 133) < 12;
}

class PictureState : public ::testing::Test {
 protected:
  void SetUp() override {
    specimen_ = anatomy::load_specimen(data_folder() / "meshes" / "canine_elbow");
    frame_ = myotact::testing::frame_at_rest(specimen_);
    view_ = start_view(specimen_, kAspect);
    view_.lines = false;
    try {
      renderer_ = std::make_unique<OffscreenRenderer>(specimen_, kWidth, kHeight);
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }
  Image draw(const SceneExtras& extras = {}) { return renderer_->render(frame_, view_, extras); }
  Image shown(const std::vector<std::string>& options) {
    ViewState view = view_;
    apply_show_options(options, specimen_, view);
    return renderer_->render(frame_, view);
  }
  int muscle(const char* key) const { return anatomy::find_muscle(specimen_, key); }

  anatomy::Specimen specimen_;
  messages::SceneFrame frame_;
  ViewState view_;
  std::unique_ptr<OffscreenRenderer> renderer_;
};

TEST_F(PictureState, HiddenPartsAndLayersAreGoneAndFadedOnesShineThrough) {
  const Image whole = draw();
  EXPECT_GT(different(whole, shown({"muscles=none"})), 3000);
  EXPECT_GT(different(whole, shown({"layers=deep,bones"})), 3000);
  EXPECT_EQ(different(shown({"muscles=none", "bones=none"}), shown({"layers=none"})), 0);
  const Image faded = shown({"faded=triceps_brachii_long"});
  EXPECT_GT(different(whole, faded), 1000);
  EXPECT_GT(different(faded, shown({"muscles=biceps_brachii,brachialis,triceps_brachii_lateral,triceps_brachii_medial,"
                                    "triceps_brachii_accessory,anconeus"})),
            500);
}

TEST_F(PictureState, AtRestNoMuscleLooksActiveInAnyColour) {
  for (const char* colour : {"activation", "tension", "pressure"}) {
    const Image rest = shown({std::string("colour=") + colour});
    EXPECT_EQ(count(rest, is_blue), 0) << colour;
    EXPECT_LT(count(rest, is_orange), 10) << colour;  // pixels in which flesh and bone mix
  }
}

TEST_F(PictureState, EachColourShowsItsQuantityOnTheMuscleThatHasIt) {
  const auto m = static_cast<std::size_t>(muscle("triceps_brachii_long"));
  const auto changes = [&](const char* colour, auto&& change) {
    const std::vector<std::string> options{std::string("colour=") + colour};
    const messages::SceneFrame before = frame_;
    const Image rest = shown(options);
    change(frame_);
    const Image set = shown(options);
    frame_ = before;
    EXPECT_GT(different(rest, set), 1000) << colour;
    EXPECT_LT(different(rest, set), 12000) << colour;  // and on no other
    return set;
  };
  changes("activation", [m](auto& frame) { frame.activations[m] = 1.0; });
  changes("tension", [m](auto& frame) { frame.tensions_N[m] = 400.0; });
  EXPECT_GT(count(changes("stretch", [m](auto& frame) { frame.stretches[m] = 1.35; }), is_orange), 1000);
  EXPECT_GT(count(changes("stretch", [m](auto& frame) { frame.stretches[m] = 0.65; }), is_blue), 1000);
  changes("volume_error", [m](auto& frame) { frame.volume_ratios[m] = 1.04; });
  changes("stiffness_share", [m](auto& frame) { frame.joints[0].muscles[m].stiffness_Nm_rad = 1.0; });
  const Image kinds = shown({"colour=kind"});
  EXPECT_GT(count(kinds, is_blue), 100);     // flexors, at the cranial edge
  EXPECT_GT(count(kinds, is_orange), 3000);  // extensors
}

TEST_F(PictureState, PressureIsMappedWhereItIs) {
  view_.colour = MuscleColour::Pressure;
  std::vector<std::vector<float>> pressures_Pa;
  for (const auto& skin : frame_.skins_world_m) pressures_Pa.emplace_back(skin.size(), 0.0f);
  const Image rest = draw();
  SceneExtras extras;
  extras.pressures_Pa = pressures_Pa;
  EXPECT_EQ(different(rest, draw(extras)), 0);
  const auto m = static_cast<std::size_t>(muscle("triceps_brachii_long"));
  std::fill(pressures_Pa[m].begin(), pressures_Pa[m].end(), kPressureRange_Pa);
  const Image pressed = draw(extras);
  EXPECT_GT(different(rest, pressed), 1000);
  EXPECT_GT(count(pressed, [](const Pixel& p) { return p.r > 150 && p.g > 130 && p.b < 110; }), 800);  // yellow
}

TEST_F(PictureState, TheOutlineRunsRoundWhatIsSelectedEvenWhenOthersHideIt) {
  EXPECT_EQ(count(draw(), is_outline), 0);
  view_.selected_muscle = muscle("anconeus");  // under the lateral head
  EXPECT_GT(count(draw(), is_outline), 20);
  view_.selected_muscle = muscle("triceps_brachii_long");
  const int round = count(draw(), is_outline);
  EXPECT_GT(round, 150);
  EXPECT_LT(round, 2500);  // a rim, no filling
  view_.muscles[static_cast<std::size_t>(view_.selected_muscle)].hidden = true;
  EXPECT_EQ(count(draw(), is_outline), 0);
  SceneExtras hovering;
  hovering.hovered = {PartKind::Bone, 0};
  EXPECT_GT(different(draw(), draw(hovering)), 100);
}

TEST_F(PictureState, ASectionTakesWhatLiesBeyondItAndShowsTheInside) {
  const Image empty = shown({"muscles=none", "bones=none"});
  const int whole = different(draw(), empty);
  EXPECT_EQ(different(shown({"section=dorsal:0"}), empty), 0);
  EXPECT_LT(different(shown({"section=dorsal:1"}), draw()), 20);  // the inside peeps out at silhouettes
  const int upper = different(shown({"section=ventral:0.5"}), empty);
  const int lower = different(shown({"section=dorsal:0.5"}), empty);
  EXPECT_NEAR(upper + lower, whole, 0.03 * whole);
  EXPECT_GT(different(shown({"section=left:0.5"}), draw()), 1000);
}

TEST_F(PictureState, FibresLinesAttachmentsAndGlowAreDrawn) {
  const Image plain = draw();
  EXPECT_GT(different(plain, shown({"fibres=on"})), 1000);
  EXPECT_GT(different(plain, shown({"lines=on"})), 100);
  const Image attached = shown({"attachments=on"});
  EXPECT_GT(count(attached, is_orange), 300);  // origins
  EXPECT_GT(count(attached, is_blue), 100);    // insertions
  frame_.tools.resize(1);
  messages::ToolFrame& tool = frame_.tools[0];
  tool.radius_m = 1e-3;
  const auto& p = frame_.skins_world_m[static_cast<std::size_t>(muscle("triceps_brachii_long"))][100];
  tool.tool_world_m = tool.proxy_world_m = {double(p[0]), double(p[1]), double(p[2])};
  tool.force_world_N = {0.0, 2.0, 0.0};
  const Image with_arrow = draw();
  tool.in_contact = true;
  EXPECT_GT(different(with_arrow, draw()), 100);
}

TEST_F(PictureState, TextIsWrittenOverThePictureAndNoNameWhileNamesAreHidden) {
  const Image bare = draw();
  const Image with_legend = renderer_->render_with_text(frame_, view_);
  EXPECT_GT(different(bare, with_legend), 300);
  view_.labels = true;
  const Image named = renderer_->render_with_text(frame_, view_);
  EXPECT_GT(different(with_legend, named), 500);
  view_.names_hidden = true;
  EXPECT_EQ(different(with_legend, renderer_->render_with_text(frame_, view_)), 0);
}

TEST_F(PictureState, WhatIsPickedIsWhatThePictureShowsThere) {
  // Each muscle in turn is the only one of another colour: where the picture changes, picking must name it.
  int agree = 0, asked = 0;
  const Image rest = draw();
  for (std::size_t m = 0; m < specimen_.muscles.size(); ++m) {
    frame_.activations[m] = 1.0;
    const Image lit = draw();
    frame_.activations[m] = 0.0;
    for (int y = 2; y < kHeight; y += 3) {
      for (int x = 2; x < kWidth; x += 3) {
        const Pixel p = at(rest, x, y), q = at(lit, x, y);
        if (std::abs(p.r - q.r) + std::abs(p.g - q.g) + std::abs(p.b - q.b) < 60) continue;
        const Ray ray = ray_through(view_.camera, (static_cast<float>(x) + 0.5f) / kWidth,
                                    (static_cast<float>(y) + 0.5f) / kHeight, kAspect);
        const auto hit = pick(specimen_, frame_, view_, renderer_->superficial(), ray);
        ++asked;
        agree += hit && hit->part == Part{PartKind::Muscle, static_cast<int>(m)} ? 1 : 0;
      }
    }
  }
  EXPECT_GT(asked, 500);
  EXPECT_GT(agree, 0.97 * asked);  // pixels on an edge show two parts
}

TEST(PictureCost, BothLimbsStayWithinDrawCallsAndBytes) {
  for (const char* name : {"canine_elbow", "canine_forelimb"}) {
    const auto specimen = anatomy::load_specimen(data_folder() / "meshes" / name);
    const auto frame = myotact::testing::frame_at_rest(specimen);
    try {
      OffscreenRenderer renderer(specimen, kWidth, kHeight);
      ViewState view = start_view(specimen, kAspect);
      view.fibres = view.attachments = true;
      view.selected_bone = 0;
      SceneExtras extras;
      extras.hovered = {PartKind::Muscle, 0};
      renderer.render(frame, view, extras);
      EXPECT_GT(renderer.statistics().draw_calls, 5) << name;
      EXPECT_LE(renderer.statistics().draw_calls, 60) << name;
      EXPECT_LE(renderer.statistics().uploaded_bytes, 4u << 20) << name;
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }
}

}  // namespace
}  // namespace myotact::view

#include "view/ui/controls.h"

#include <array>
#include <functional>

#include <gtest/gtest.h>

#include "core/error.h"
#include "view/unseen_window.h"

namespace myotact::view::ui {
namespace {

/// A panel of whatever a test draws, and a pointer over it.
class PanelControls : public ::testing::Test {
 protected:
  void draw() {
    window_.picture([&] {
      ImGui::SetNextWindowPos(ImVec2(100.0f, 100.0f));
      ImGui::SetNextWindowSize(ImVec2(400.0f, 300.0f));
      ImGui::Begin("panel");
      paint_();
      ImGui::End();
    });
  }
  /// Where a control is, as the picture before the last one noted it.
  ControlPlace place_of(const std::string& key) {
    draw();
    draw();
    begin_controls();
    for (const ControlPlace& place : controls_of_last_picture()) {
      if (place.key == key) return place;
    }
    ADD_FAILURE() << key << " is not there";
    return {};
  }
  void point_at(float x, float y) {
    ImGui::GetIO().MousePos = ImVec2(x, y);
    draw();
  }
  void point_at(const std::string& key) {
    const ControlPlace place = place_of(key);
    point_at(place.x + 0.5f * place.width, place.y + 0.5f * place.height);
  }
  void set_button(bool down) {
    ImGui::GetIO().MouseDown[0] = down;
    draw();
  }
  void click(const std::string& key) {
    point_at(key);
    set_button(true);
    set_button(false);
  }

  myotact::testing::UnseenWindow window_;
  std::function<void()> paint_ = [] {};
};

TEST_F(PanelControls, StayInHandWhileTheLanguageChanges) {
  bool held = false;
  double value = 0.25;
  paint_ = [&] {
    held = hold_button("devices.clutch");
    slider("demonstrate.common", value, {0.0f, 1.0f});
  };
  point_at("devices.clutch");
  set_button(true);
  ASSERT_TRUE(held);
  set_language("de");
  ASSERT_STRNE(tr("devices.clutch"), load_catalogue("en").at("devices.clutch").c_str());
  draw();
  EXPECT_TRUE(held) << "a hand on a device would jump";
  set_button(false);
  const ControlPlace track = place_of("demonstrate.common");
  point_at(track.x + 0.3f * track.width, track.y + 4.0f);
  set_button(true);
  set_language("en");
  point_at(track.x + 0.8f * track.width, track.y + 4.0f);
  EXPECT_NEAR(value, 0.8, 0.03);
}

TEST_F(PanelControls, ATextThatIsTooLongKeepsItsBeginning) {
  const std::string name = "M. triceps brachii, caput accessorium";
  std::string narrow, wide, none, german;
  float room = 0.0f;
  paint_ = [&] {
    room = 0.6f * ImGui::CalcTextSize(name.c_str()).x;
    narrow = shortened(name, room);
    wide = shortened(name, 2.0f * room);
    none = shortened(name, 0.0f);
    german = shortened("ääääää", 0.8f * ImGui::CalcTextSize("ääääää").x);
    room -= ImGui::CalcTextSize(narrow.c_str()).x;
  };
  draw();
  EXPECT_EQ(wide, name);
  EXPECT_EQ(none, "...");
  EXPECT_GE(room, 0.0f) << narrow << " is too wide";
  EXPECT_TRUE(narrow.ends_with("...") && name.starts_with(narrow.substr(0, narrow.size() - 3))) << narrow;
  EXPECT_EQ(german.size() % 2, 1u) << "three points after whole characters of two bytes: " << german;
}

TEST_F(PanelControls, ASliderReachesBothEndsAndSaysWhereItsTrackIs) {
  double value = 3.0;
  bool moved = false;
  paint_ = [&] { moved = slider("demonstrate.common", value, {-2.0f, 6.0f}) || moved; };
  const ControlPlace track = place_of("demonstrate.common");
  EXPECT_EQ(track.value, "3");
  EXPECT_LT(track.x + track.width, 500.0f);
  const float y = track.y + 0.5f * track.height;
  point_at(track.x + 0.75f * track.width, y);
  EXPECT_FALSE(moved);
  set_button(true);
  EXPECT_NEAR(value, 4.0, 0.15);  // the knob has a width of its own
  point_at(track.x, y);
  EXPECT_EQ(value, -2.0);
  point_at(track.x + track.width + 300.0f, y);
  EXPECT_EQ(value, 6.0) << "held, and dragged beyond its end";
  set_button(false);
  point_at(track.x + 0.25f * track.width, y);
  EXPECT_EQ(value, 6.0) << "no longer held";
}

TEST_F(PanelControls, ASliderThatNobodyMovesKeepsItsNumberToTheLastBit) {
  double value = 0.1;
  paint_ = [&] { slider("demonstrate.common", value, {0.0f, 1.0f}); };
  point_at("demonstrate.common");
  EXPECT_EQ(value, 0.1) << "which no float is";
}

TEST_F(PanelControls, AChoiceIsMadeByItsTextAndToldByItsKey) {
  constexpr std::array kOptions = {"demonstrate.tissue.fem", "demonstrate.tissue.line", "demonstrate.tissue.rigid"};
  int value = 0, changes = 0;
  paint_ = [&] { changes += choice("demonstrate.tissue", value, kOptions) ? 1 : 0; };
  click("demonstrate.tissue");
  click("demonstrate.tissue.rigid");
  EXPECT_EQ(value, 2);
  EXPECT_EQ(changes, 1);
  EXPECT_EQ(place_of("demonstrate.tissue").value, "demonstrate.tissue.rigid");
  click("demonstrate.tissue");
  click("demonstrate.tissue.rigid");
  EXPECT_EQ(changes, 1) << "it was that already";
  value = 7;  // of a list that was longer
  EXPECT_EQ(place_of("demonstrate.tissue").value, "");
  click("demonstrate.tissue");
  click("demonstrate.tissue.line");
  EXPECT_EQ(value, 1);
}

TEST_F(PanelControls, WhatIsScrolledOutOfSightIsNotPointedOut) {
  bool first = false;
  paint_ = [&] {
    checkbox("demonstrate.gravity", first);
    for (int i = 0; i < 60; ++i) text("demonstrate.levels");
    button("devices.stop");
  };
  EXPECT_EQ(place_of("demonstrate.gravity").value, "off");
  click("demonstrate.gravity");
  EXPECT_TRUE(first);
  draw();
  draw();
  begin_controls();
  ASSERT_EQ(controls_of_last_picture().size(), 1u);
  EXPECT_EQ(controls_of_last_picture()[0].value, "on");
}

TEST(Texts, ALanguageThatIsNotThereLeavesTheOneInForce) {
  set_language("de");
  const std::string german = tr("devices.clutch");
  EXPECT_THROW(set_language("xx"), Error);
  EXPECT_EQ(language(), "de");
  EXPECT_EQ(tr("devices.clutch"), german);
  set_language("en");
  EXPECT_NE(tr("devices.clutch"), german);
}

TEST(Texts, AKeyWithoutATextIsShownAndStaysGood) {
  const char* shown = tr("no.such.key");
  EXPECT_FALSE(has_text("no.such.key"));
  for (int i = 0; i < 1000; ++i) tr("no.such.key." + std::to_string(i));
  EXPECT_STREQ(shown, "no.such.key");
  EXPECT_EQ(tr("no.such.key"), shown);
}

}  // namespace
}  // namespace myotact::view::ui

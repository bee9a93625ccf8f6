#include <functional>
#include <utility>

#include <gtest/gtest.h>

#include "view/hinge_window.h"
#include "view/panels/bookmark_list.h"
#include "view/panels/demonstrate_panel.h"
#include "view/panels/feel_panel.h"
#include "view/panels/find_panel.h"
#include "view/panels/timeline_panel.h"

// What a person's clicks in panels ask for.

namespace myotact::view {
namespace {

class ClickedPanel : public myotact::testing::HingeWindow {
 protected:
  ClickedPanel() : HingeWindow(1.5f) {
    ImGuiIO& io = ImGui::GetIO();
    io.KeyMap[ImGuiKey_Enter] = kEnter;
    io.KeyMap[ImGuiKey_KeyPadEnter] = kNumberPadEnter;
    facts_.name = facts_.file = "hinge";
    facts_.tissue = "fem";
    facts_.scenes = {"hinge"};
    frame_.sequence = 1;
  }

  void draw() {
    window_.picture([&] {
      scene_.hear(frame_, 0.0);
      PanelContext context = HingeWindow::context();
      ImGui::SetNextWindowPos(ImVec2(100.0f, 0.0f));
      ImGui::SetNextWindowSize(ImVec2(460.0f, 800.0f));
      ImGui::Begin("panel");
      panel_(context);
      ImGui::End();
    });
    if (asks_.bookmarks) marks_.bookmarks = *std::exchange(asks_.bookmarks, std::nullopt);
  }
  /// All places of a control in the last picture, the first one at the top.
  std::vector<ui::ControlPlace> places_of(const std::string& key) {
    draw();
    draw();
    ui::begin_controls();
    std::vector<ui::ControlPlace> places;
    for (const ui::ControlPlace& place : ui::controls_of_last_picture()) {
      if (place.key == key) places.push_back(place);
    }
    return places;
  }
  void click(const std::string& key, std::size_t which = 0, float share = 0.5f) {
    const auto places = places_of(key);
    ASSERT_LT(which, places.size()) << key;
    const ui::ControlPlace& at = places[which];
    ImGui::GetIO().MousePos = ImVec2(at.x + share * at.width, at.y + 0.5f * at.height);
    draw();
    for (const bool down : {true, false}) {
      ImGui::GetIO().MouseDown[0] = down;
      draw();
    }
  }
  void type_and_enter(const char* text, int enter = kEnter) {
    for (int i = 0; i < 3; ++i) draw();  // until the keyboard is given to the line of text
    ImGui::GetIO().AddInputCharactersUTF8(text);
    draw();
    for (const bool down : {true, false}) {
      ImGui::GetIO().KeysDown[enter] = down;
      draw();
    }
  }
  std::vector<std::string> bookmark_names() const {
    std::vector<std::string> names;
    for (const Bookmark& bookmark : marks_.bookmarks) names.push_back(bookmark.name);
    return names;
  }

  static constexpr int kEnter = 13, kNumberPadEnter = 14;
  std::function<void(PanelContext&)> panel_;
};

class ClickedBookmarks : public ClickedPanel {
 protected:
  ClickedBookmarks() {
    panel_ = [this](PanelContext& context) { list_.draw(context); };
    for (const char* name : {"one", "two", "three"}) {
      ViewState view = view_;
      view.camera.distance_m = 1.0f + static_cast<float>(marks_.bookmarks.size());
      view.labels = true;
      marks_.bookmarks.push_back({name, saved_view(view, specimen_)});
    }
  }
  BookmarkList list_;
};

TEST_F(ClickedBookmarks, OneIsMadeOfWhatIsSeenUnderTheNameThatWasTyped) {
  view_.camera.distance_m = 0.625f;
  view_.muscles[1].hidden = true;
  click("session.bookmark_name");
  type_and_enter("Zoë");
  EXPECT_EQ(bookmark_names(), (std::vector<std::string>{"one", "two", "three", "Zoë"}));
  EXPECT_EQ(marks_.bookmarks.back().view, saved_view(view_, specimen_));
  click("session.bookmark_add");
  ASSERT_EQ(marks_.bookmarks.size(), 5u);
  EXPECT_FALSE(marks_.bookmarks.back().name.empty()) << "without a name it gets one";
}

TEST_F(ClickedBookmarks, AClickTurnsThereAndShowsTheRestAtOnce) {
  const Camera before = view_.camera;
  click("session.bookmark.1");
  ASSERT_TRUE(asks_.turn_to);
  EXPECT_EQ(asks_.turn_to->distance_m, 2.0f);
  EXPECT_EQ(view_.camera, before) << "the window turns it there";
  EXPECT_TRUE(view_.labels);
  EXPECT_EQ(asks_.message, "");
}

TEST_F(ClickedBookmarks, WhatWasDeletedCanBeHadBack) {
  const Bookmark second = marks_.bookmarks[1];
  EXPECT_TRUE(places_of("session.bring_back").empty());
  click("session.delete", 1);
  EXPECT_EQ(bookmark_names(), (std::vector<std::string>{"one", "three"}));
  click("session.bring_back");
  ASSERT_EQ(marks_.bookmarks.size(), 3u);
  EXPECT_EQ(marks_.bookmarks[2], second);
  EXPECT_TRUE(places_of("session.bring_back").empty()) << "once";
}

TEST_F(ClickedBookmarks, ARenamedOneStaysInItsPlaceAndItsView) {
  const SavedView first = marks_.bookmarks[0].view;
  click("session.rename", 0);
  type_and_enter("side");
  ASSERT_EQ(marks_.bookmarks.size(), 3u);
  EXPECT_NE(marks_.bookmarks[0].name.find("side"), std::string::npos) << marks_.bookmarks[0].name;
  EXPECT_EQ(marks_.bookmarks[0].view, first);
  EXPECT_EQ(marks_.bookmarks[1].name, "two");
  EXPECT_EQ(marks_.bookmarks[2].name, "three");
}

TEST_F(ClickedBookmarks, OneTooManyIsSaid) {
  while (add_bookmark(marks_.bookmarks, {"more", {}})) {
  }
  panel_ = [this](PanelContext& context) {
    ImGui::SetScrollY(1e6f);
    list_.draw(context);
  };
  click("session.bookmark_add");
  EXPECT_EQ(marks_.bookmarks.size(), kMostBookmarks);
  EXPECT_NE(asks_.message.find("200"), std::string::npos) << asks_.message;
}

class ClickedTools : public ClickedPanel {
 protected:
  ClickedTools() {
    facts_.device_peaks_N = {3.3, 3.3};
    frame_.tools.resize(2);
    frame_.tools[1].hand = 1;
    frame_.tools[1].shape = messages::ToolShape::Clamp;
    frame_.tools[1].left = true;
    panel_ = [this](PanelContext& context) { feel_.draw(context); };
  }
  FeelPanel feel_{specimen_};
};

TEST_F(ClickedTools, EachHandIsGivenTheOneThatIsChosenForIt) {
  EXPECT_TRUE(places_of("feel.tool").empty()) << "two hands are told apart";
  EXPECT_EQ(places_of("feel.tool_right").at(0).value, "feel.tool.ball");
  EXPECT_EQ(places_of("feel.tool_left").at(0).value, "feel.tool.clamp") << "as the scene says";
  click("feel.tool_left");
  click("feel.tool.point");
  const auto commands = scene_.take_commands();
  ASSERT_EQ(commands.size(), 1u);
  const auto& order = std::get<messages::ChooseTool>(commands[0].order);
  EXPECT_EQ(order.tool, 1);
  EXPECT_EQ(order.shape, messages::ToolShape::Point);
  EXPECT_EQ(places_of("feel.tool_left").at(0).value, "feel.tool.point") << "at once";
}

TEST_F(ClickedTools, OfAServersSceneAndARecordingNoneIsOffered) {
  facts_.is_served = true;
  EXPECT_TRUE(places_of("feel.tool_right").empty());
  facts_.is_served = false;
  facts_.replay_s = 3.0;
  EXPECT_TRUE(places_of("feel.tool_right").empty());
}

class ClickedTimeline : public ClickedPanel {
 protected:
  ClickedTimeline() {
    panel_ = [this](PanelContext& context) { timeline_.draw_go_on(context, {600.0f, 0.0f, 600.0f, 700.0f}); };
    frame_.joints.resize(1);
    for (int i = 0; i < 10; ++i) {
      frame_.time_s = 0.02 * i;
      frame_.sequence = static_cast<std::uint64_t>(i) + 1;
      frame_.joints[0].angle_rad = 0.1 * i;
      frame_.control.drive = Drive::Levels;
      frame_.control.flexors = 0.1 * i;
      timeline_.choose(frame_);
    }
  }
  TimelinePanel timeline_;
};

TEST_F(ClickedTimeline, OfTheMomentThatIsLookedAtAllIsAskedForThatIsKnown) {
  EXPECT_TRUE(places_of("keep.go_on").empty()) << "the present is no earlier moment";
  timeline_.step(-4);
  timeline_.choose(frame_);
  click("keep.go_on");
  ASSERT_TRUE(asks_.go_on);
  EXPECT_EQ(asks_.go_on->joints, 1u);
  EXPECT_DOUBLE_EQ(asks_.go_on->angles_rad[0], 0.5);
  EXPECT_EQ(asks_.go_on->muscles, frame_.activations.size());
  EXPECT_DOUBLE_EQ(asks_.go_on->control.flexors, 0.5);
  EXPECT_FALSE(timeline_.looks_back());
}

TEST_F(ClickedTimeline, AServersSceneIsNotSetBackFromHere) {
  facts_.is_served = true;
  timeline_.step(-4);
  timeline_.choose(frame_);
  EXPECT_TRUE(places_of("keep.go_on").empty());
}

class ClickedDemonstration : public ClickedPanel {
 protected:
  ClickedDemonstration() {
    facts_.presets = {{"first", 0.5, 0.0}, {"second", 0.25, 0.125}};
    frame_.control = in_force(0.25, 0.75);
    panel_ = [this](PanelContext& context) { demonstrate_.draw(context); };
  }
  static messages::ControlState in_force(double common, double difference) {
    messages::ControlState state;
    state.drive = Drive::Balance;
    state.common = common;
    state.difference = difference;
    return state;
  }
  void hear(const messages::ControlState& state) {
    frame_.control = state;
    ++frame_.sequence;
    draw();
  }
  DemonstratePanel demonstrate_;
};

TEST_F(ClickedDemonstration, ASliderLeavesTheOthersNumberToTheLastBit) {
  click("demonstrate.common", 0, 0.99f);
  const auto commands = scene_.take_commands();
  ASSERT_FALSE(commands.empty());
  const auto& order = std::get<messages::CoContract>(commands.back().order);
  EXPECT_EQ(order.common, 1.0);
  EXPECT_EQ(order.difference, 0.75) << "beyond the slider's own ends: the script or a client may ask for it";
}

TEST_F(ClickedDemonstration, TwoStoredStatesAreSwitchedBetween) {
  click("demonstrate.show_a");
  EXPECT_TRUE(scene_.take_commands().empty()) << "nothing is stored yet";
  click("demonstrate.store_a");
  hear(in_force(0.5, 0.0));
  click("demonstrate.store_b");
  EXPECT_TRUE(scene_.take_commands().empty());
  EXPECT_EQ(places_of("demonstrate.show_a")[0].value, "off");
  EXPECT_EQ(places_of("demonstrate.show_b")[0].value, "on");
  click("demonstrate.show_a");
  const auto commands = scene_.take_commands();
  ASSERT_EQ(commands.size(), 1u);
  EXPECT_EQ(std::get<messages::CoContract>(commands[0].order).common, 0.25);
  EXPECT_EQ(std::get<messages::CoContract>(commands[0].order).difference, 0.75);
  EXPECT_EQ(places_of("demonstrate.show_a")[0].value, "on");
  click("demonstrate.show_a");
  EXPECT_TRUE(scene_.take_commands().empty()) << "it is that already";
}

TEST_F(ClickedDemonstration, StatesThatAWorkBringsAreFeltInTurn) {
  hear(in_force(0.25, 0.75));
  demonstrate_.keep({scene_state_of(in_force(0.25, 0.75)), scene_state_of(in_force(0.5, 0.0))});
  EXPECT_TRUE(demonstrate_.feel_other(scene_));
  const auto commands = scene_.take_commands();
  ASSERT_EQ(commands.size(), 1u);
  EXPECT_EQ(std::get<messages::CoContract>(commands[0].order).common, 0.5) << "A is in force";
  click("demonstrate.store_b");
  EXPECT_EQ(demonstrate_.kept()[1], scene_state_of(scene_.state()));
}

TEST_F(ClickedDemonstration, AReadyStateHoldsThePostureWhereBothSidesAreEqual) {
  for (const std::size_t i : {0u, 1u}) {
    const Preset& preset = facts_.presets[i];
    click(preset.name);
    const auto commands = scene_.take_commands();
    ASSERT_EQ(commands.size(), 2u) << preset.name;
    EXPECT_EQ(std::get<messages::CoContract>(commands[0].order).common, preset.common);
    EXPECT_EQ(std::get<messages::CoContract>(commands[0].order).difference, preset.difference);
    EXPECT_EQ(std::get<messages::HoldPosture>(commands[1].order).on, i == 0);
    EXPECT_EQ(places_of(preset.name)[0].value, "on");
  }
}

TEST_F(ClickedPanel, ASearchIsEndedByEitherEnterAndSelectsTheFirst) {
  for (const int enter : {kEnter, kNumberPadEnter}) {
    FindPanel find;
    panel_ = [&](PanelContext& context) { find.draw(context); };
    view_.selected_muscle = -1;
    find.focus();
    type_and_enter("extensor", enter);
    EXPECT_EQ(view_.selected_muscle, 1) << enter;
  }
}

TEST_F(ClickedPanel, TheListOfNamesTellsNoneWhileOneIsAskedFor) {
  FindPanel find;
  panel_ = [&](PanelContext& context) { find.draw(context); };
  EXPECT_EQ(places_of("find.flexor").size(), 1u);
  click("find.flexor");
  EXPECT_EQ(view_.selected_muscle, 0);
  click("find.shown.extensor");
  EXPECT_TRUE(view_.muscles[1].hidden);
  view_.names_hidden = true;
  draw();
  draw();
  ui::begin_controls();
  EXPECT_TRUE(ui::controls_of_last_picture().empty());
  EXPECT_FALSE(find.hovered());
}

}  // namespace
}  // namespace myotact::view

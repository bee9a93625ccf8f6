#include "view/panels/device_part.h"

#include <filesystem>
#include <regex>
#include <string>

#include <gtest/gtest.h>
#include <imgui.h>

#include "core/file.h"
#include "support/source_folder.h"
#include "support/synthetic_specimen.h"
#include "view/panels/feel_panel.h"
#include "view/panels/news_strip.h"
#include "view/ui/controls.h"
#include "view/ui/font.h"
#include "view/ui/text.h"
#include "view/view_frame.h"

namespace myotact::view {
namespace {

using messages::DevicePhase;

constexpr const char* kUnplugged = "Plug the Falcon in again, with its power.";

/// The panel in a window that nobody sees.
class DevicePart : public ::testing::Test {
 protected:
  DevicePart() {
    ImGui::CreateContext();
    ImGui::GetIO().DisplaySize = ImVec2(1280.0f, 800.0f);
    ImGui::GetIO().IniFilename = nullptr;
    ui::add_font(15.0f);
    ImGui::GetIO().Fonts->Build();
    ui::set_language("en");
    frame_.tools.resize(1);
    facts_.device_peaks_N = {8.0};
  }
  ~DevicePart() override {
    ui::set_language("en");
    ImGui::DestroyContext();
  }

  /// One picture, and what it notes of its controls.
  void draw() {
    ImGui::GetIO().DeltaTime = 0.02f;
    ImGui::NewFrame();
    ui::begin_controls();
    controls_.clutch = false;
    PanelContext context{specimen_, frame_, facts_, readings_, news_,  part_facts_, marks_,
                         {},        false,  view_,  controls_, scene_, asks_};
    ImGui::SetNextWindowPos(ImVec2(880.0f, 0.0f));
    ImGui::SetNextWindowSize(ImVec2(400.0f, 800.0f));
    ImGui::Begin("tasks");
    panel_.draw(context);
    ImGui::End();
    std::string message;
    strip_.draw(context, {0.0f, 0.0f, 800.0f, 700.0f}, message);
    ImGui::Render();
  }
  std::vector<std::string> values_of(const std::string& key) {
    std::vector<std::string> values;
    ui::begin_controls();  // what was noted is now of the last picture
    for (const ui::ControlPlace& place : ui::controls_of_last_picture()) {
      if (place.key == key) values.push_back(place.value);
    }
    return values;
  }
  std::vector<std::string> shown(const std::string& key) {
    draw();
    draw();
    return values_of(key);
  }
  /// Puts the pointer on a control; a press and a release each take a picture.
  void point_at(const std::string& key) {
    draw();
    draw();
    ui::begin_controls();
    for (const ui::ControlPlace& place : ui::controls_of_last_picture()) {
      if (place.key == key) ImGui::GetIO().MousePos = ImVec2(place.x + 4.0f, place.y + 4.0f);
    }
    draw();
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

  anatomy::Specimen specimen_ = myotact::testing::antagonist_hinge();
  messages::SceneFrame frame_ = myotact::testing::frame_at_rest(specimen_);
  SceneFacts facts_;
  JointReadings readings_;
  SessionNews news_;
  anatomy::FactsByKey part_facts_;
  Marks marks_;
  ViewState view_;
  ViewControls controls_;
  SceneControls scene_{{}};
  WindowAsks asks_;
  FeelPanel panel_{specimen_};
  NewsStrip strip_;
};

TEST_F(DevicePart, TellsEachDevicesHandPhaseRateWarmthAndWhatToDo) {
  news_.devices = {{"falcon", false, {DevicePhase::Lost, 0.0, -1.0, kUnplugged}},
                   {"inverse3", true, {DevicePhase::Ready, 998.4, 0.62, ""}}};
  const auto devices = shown("devices.device");
  ASSERT_EQ(devices.size(), 2u);
  EXPECT_EQ(devices[0], "falcon, right hand: interrupted");
  EXPECT_EQ(devices[1], "inverse3, left hand: ready, 998 Hz");
  EXPECT_EQ(shown("devices.hint"), std::vector<std::string>{kUnplugged});
  EXPECT_EQ(shown("devices.warmth"), std::vector<std::string>{"0.62"});  // the Falcon does not tell
  ui::set_language("de");
  EXPECT_EQ(shown("devices.hint"), std::vector<std::string>{"Stecken Sie den Falcon wieder ein, auch sein Netzteil."});
  news_.devices[0].report.hint = "A sentence that nobody translated.";
  EXPECT_EQ(shown("devices.hint"), std::vector<std::string>{"A sentence that nobody translated."});
}

TEST_F(DevicePart, EveryPhaseHasItsWordsInEveryLanguage) {
  for (const std::string& language : ui::languages()) {
    ui::set_language(language);
    for (const DevicePhase phase : {DevicePhase::Closed, DevicePhase::Opening, DevicePhase::NeedsCalibration,
                                    DevicePhase::Ready, DevicePhase::Lost}) {
      EXPECT_TRUE(ui::has_text(std::string("devices.") + phase_name(phase))) << phase_name(phase);
      EXPECT_EQ(sentence_about({"x", false, {phase}}).find("devices."), std::string::npos);
    }
  }
}

TEST_F(DevicePart, TheStripTellsOnlyWhatWaitsForAPerson) {
  news_.devices = {{"falcon", false, {DevicePhase::Lost, 0.0, -1.0, kUnplugged}},
                   {"touch", true, {DevicePhase::NeedsCalibration}},
                   {"omega", false, {DevicePhase::Ready, 1000.0}},
                   {"sigma", false, {DevicePhase::Opening}}};
  EXPECT_EQ(shown("news.device"),
            (std::vector<std::string>{"falcon, right hand: interrupted. " + std::string(kUnplugged),
                                      "touch, left hand: to be calibrated."}));
  news_.devices.erase(news_.devices.begin(), news_.devices.begin() + 2);
  EXPECT_TRUE(shown("news.device").empty());
}

TEST_F(DevicePart, StopsTheForcesAndEnablesThemOnceTheyAreStopped) {
  news_.devices = {{"falcon", false, {DevicePhase::Ready, 1000.0}}};
  click("devices.arm");
  EXPECT_EQ(scene_.take_forces_on(), std::nullopt);  // greyed: there is nothing to enable
  click("devices.stop");
  EXPECT_EQ(scene_.take_forces_on(), false);
  frame_.tools[0].forces_stopped = true;
  click("devices.stop");
  EXPECT_EQ(scene_.take_forces_on(), false);
  click("devices.arm");
  EXPECT_EQ(scene_.take_forces_on(), true);
  EXPECT_EQ(scene_.take_forces_on(), std::nullopt);  // once
}

TEST_F(DevicePart, TheClutchIsHeldForAsLongAsTheButtonIs) {
  news_.devices = {{"falcon", false, {DevicePhase::Ready, 1000.0}}};
  point_at("devices.clutch");
  EXPECT_FALSE(controls_.clutch);
  set_button(true);
  for (int picture = 0; picture < 3; ++picture) {
    draw();
    EXPECT_TRUE(controls_.clutch) << picture;
  }
  EXPECT_FALSE(values_of("devices.clutched").empty());
  set_button(false);
  EXPECT_FALSE(controls_.clutch);
  EXPECT_TRUE(shown("devices.clutched").empty());
  news_.devices[0].clutched = true;  // by its own button
  EXPECT_EQ(shown("devices.clutched").size(), 1u);
  EXPECT_FALSE(controls_.clutch);
}

TEST_F(DevicePart, WithoutADeviceTheClutchIsGreyAndNothingElseIsAsked) {
  point_at("devices.clutch");
  set_button(true);
  EXPECT_FALSE(controls_.clutch);
  EXPECT_EQ(shown("devices.clutch").size(), 1u);
  EXPECT_TRUE(shown("devices.stop").empty());
  EXPECT_TRUE(shown("news.device").empty());
}

TEST(DeviceHints, OfEveryDriverAreTranslated) {
  namespace fs = std::filesystem;
  // What a driver says to a person begins with a capital and ends with a full stop; errors do neither.
  const std::regex hint(R"re("([A-Z][^"]* [^"]*\.)")re");
  const ui::Catalogue english = ui::load_catalogue("en");
  int hints = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(source_folder()) / "src/device/drivers")) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string source = read_file(entry.path());
    for (std::sregex_iterator it(source.begin(), source.end(), hint), end; it != end; ++it, ++hints) {
      EXPECT_TRUE(english.contains("hint." + (*it)[1].str()))
          << entry.path() << ": assets/languages lack hint." << (*it)[1];
    }
  }
  EXPECT_GT(hints, 20);
}

}  // namespace
}  // namespace myotact::view

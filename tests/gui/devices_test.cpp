#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "device/drivers/inverse/fake_inverse_service.h"
#include "gui/gui_program.h"
#include "support/temporary_folder.h"

// What the window shows of devices on the table, and what a person does to them there. The devices are those of
// device_window.cpp, and an Inverse3 of a service of the test's.

namespace myotact {
namespace {

using nlohmann::json;
using testing::GuiProgram;

class DevicesTest : public testing::GuiTest {};

bool clutched(const json& state) {
  return state["scene"]["clutch"].get<bool>();
}

bool stopped(const json& state) {
  return state["frame"]["tools"][0]["forces_stopped"].get<bool>();
}

/// How far the tool goes along each axis of the world, as twenty reports of different times tell [m].
std::array<double, 3> reach_of_tool(const GuiProgram& gui) {
  std::array<double, 3> lowest, highest, reach{};
  lowest.fill(1e9);
  highest.fill(-1e9);
  int told = 0;
  double last_s = -1.0;
  gui.wait_until([&](const json& state) {
    if (state["frame"]["time_s"].get<double>() == last_s) return false;
    last_s = state["frame"]["time_s"].get<double>();
    const auto tool_m = state["frame"]["tools"][0]["tool_world_m"].get<std::array<double, 3>>();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lowest[axis] = std::min(lowest[axis], tool_m[axis]);
      highest[axis] = std::max(highest[axis], tool_m[axis]);
    }
    return ++told == 20;
  });
  for (std::size_t axis = 0; axis < 3; ++axis) reach[axis] = highest[axis] - lowest[axis];
  return reach;
}

std::string box_text(const json& state, const std::string& control) {
  for (const json& shown : state["controls"]) {
    if (shown["key"] == control) return shown["box"].dump();
  }
  return "";
}

TEST_F(DevicesTest, OneThatIsGoneIsToldOnEveryTabAndInEveryLanguage) {
  GuiProgram gui("devices", "", "", MYOTACT_DEVICE_WINDOW);
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.shows("devices.warmth"); }));
  EXPECT_EQ(gui.value_of("devices.hint"), "Plug the Falcon in again, with its power.");
  EXPECT_EQ(gui.value_of("devices.warmth"), "0.62");
  EXPECT_EQ(gui.state()["devices"][0]["phase"], "lost");
  EXPECT_EQ(gui.state()["devices"][1]["hand"], "left");
  gui.screenshot("english");
  gui.resize(900, 600);
  EXPECT_TRUE(gui.shows("devices.hint") && gui.shows("devices.stop") && gui.shows("devices.clutch"));
  gui.screenshot("english_small");
  gui.resize(1280, 800);
  gui.key("ctrl+6");
  EXPECT_TRUE(gui.wait_until([&](const json&) { return !gui.shows("devices.hint") && gui.shows("news.device"); }));
  gui.click("comfort.language");
  gui.click("comfort.language.de");
  EXPECT_TRUE(gui.wait_until([&](const json&) {
    return gui.value_of("news.device").find("Stecken Sie den Falcon wieder ein") != std::string::npos;
  }));
  gui.key("ctrl+1");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.shows("devices.hint"); }));
  gui.screenshot("german");
  gui.resize(900, 600);
  gui.screenshot("german_small");
}

TEST_F(DevicesTest, TheClutchIsHeldByButtonOrKeyAndNotByALetterThatIsTyped) {
  GuiProgram gui("devices_clutch", "", "", MYOTACT_DEVICE_WINDOW);
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.shows("devices.clutch"); }));
  const json at = json::parse(box_text(gui.state(), "devices.clutch"));
  gui.move_to(at[0].get<double>() + 5.0, at[1].get<double>() + 5.0);
  EXPECT_FALSE(clutched(gui.state()));
  gui.press();
  EXPECT_TRUE(gui.wait_until(clutched));
  EXPECT_TRUE(gui.shows("devices.clutched"));
  gui.screenshot("held");
  gui.release();
  EXPECT_TRUE(gui.wait_until([](const json& state) { return !clutched(state); }));
  gui.key_down("c");
  EXPECT_TRUE(gui.wait_until(clutched));
  gui.key_up("c");
  EXPECT_TRUE(gui.wait_until([](const json& state) { return !clutched(state); }));
  gui.click("find.search");
  gui.key_down("c");
  EXPECT_FALSE(clutched(gui.state()));
  gui.key_up("c");
}

TEST_F(DevicesTest, ForcesAreStoppedAndEnabledBesideTheDevices) {
  GuiProgram gui("devices_stop", "", "", MYOTACT_DEVICE_WINDOW);
  gui.click("devices.arm");  // nothing to enable
  EXPECT_FALSE(stopped(gui.state()));
  gui.click("devices.stop");
  EXPECT_TRUE(gui.wait_until(stopped));
  EXPECT_TRUE(gui.shows("toolbar.forces_on"));
  gui.click("devices.stop");  // once more changes nothing
  EXPECT_TRUE(stopped(gui.state()));
  gui.click("devices.arm");
  EXPECT_TRUE(gui.wait_until([](const json& state) { return !stopped(state); }));
}

TEST_F(DevicesTest, WithoutAnyTheClutchDoesNothing) {
  GuiProgram gui("no_devices", "particle");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.shows("devices.clutch"); }));
  EXPECT_TRUE(gui.state()["devices"].empty());
  gui.key_down("c");
  EXPECT_FALSE(clutched(gui.state()));
  gui.key_up("c");
  const json at = json::parse(box_text(gui.state(), "devices.clutch"));
  gui.move_to(at[0].get<double>() + 5.0, at[1].get<double>() + 5.0);
  gui.press();
  EXPECT_FALSE(clutched(gui.state()));
  gui.release();
}

TEST_F(DevicesTest, AnInverse3IsFeltClutchedStoppedLostAndFoundAgain) {
  device::inverse::FakeInverseService service({"049D"});
  const std::string port = std::to_string(service.port());
  GuiProgram gui("device_inverse3",
                 "spring --device left=inverse3 --set placement.inverse3.scale=0.3 --set inverse3.port=" + port +
                     " --set inverse3.version_port=" + port);  // so little that the spring never keeps the gate shut
  const auto phase_is = [](const char* phase) {
    return [phase](const json& state) { return !state["devices"].empty() && state["devices"][0]["phase"] == phase; };
  };
  const auto is_felt = [&](const json&) { return service.received().last_N.norm() > 0.001; };
  const auto is_not_felt = [&](const json&) { return service.received().last_N.norm() == 0.0; };
  ASSERT_TRUE(gui.wait_until(phase_is("ready")));
  EXPECT_EQ(gui.state()["devices"][0]["hand"], "left");
  EXPECT_TRUE(gui.wait_until(is_felt));
  gui.screenshot("felt");
  gui.key_down("c");
  EXPECT_TRUE(gui.wait_until(is_not_felt));
  EXPECT_TRUE(gui.shows("devices.clutched"));
  gui.key_up("c");
  EXPECT_TRUE(gui.wait_until(is_felt));
  service.set_manner(device::inverse::Manner::Silence);
  EXPECT_TRUE(gui.wait_until(phase_is("lost")));
  EXPECT_TRUE(gui.wait_until([&](const json&) { return gui.shows("devices.hint"); }));
  gui.screenshot("lost");
  service.set_manner(device::inverse::Manner::States);
  EXPECT_TRUE(gui.wait_until(phase_is("ready")));
  EXPECT_TRUE(gui.wait_until(is_felt));
  EXPECT_TRUE(gui.wait_until([&](const json&) { return !gui.shows("devices.hint"); }));
  gui.let_draw();  // the buttons have moved
  gui.click("devices.stop");
  EXPECT_TRUE(gui.wait_until(is_not_felt));
}

/// The scene of an Inverse3, from its start by a click on Record.
struct RecordedSpring {
  explicit RecordedSpring(const std::string& name)
      : gui(name, "spring --device inverse3 --set inverse3.port=" + std::to_string(service.port()) +
                      " --set inverse3.version_port=" + std::to_string(service.port())) {}

  double felt_N() const { return service.received().last_N.norm(); }
  bool becomes_felt() const {
    return gui.wait_until([&](const json&) { return felt_N() > 0.001; });
  }
  bool begins_anew() {
    gui.let_draw();
    gui.click("keep.record");
    return gui.wait_until([](const json& state) {
      return state["recording"].get<bool>() && !state["opening"].get<bool>() &&
             state["frame"]["time_s"].get<double>() > 0.2;
    });
  }

  device::inverse::FakeInverseService service{{"049D"}};
  GuiProgram gui;
};

TEST_F(DevicesTest, AStopOutlivesItsScene) {
  RecordedSpring spring("device_stopped");
  ASSERT_TRUE(spring.becomes_felt());
  spring.service.set_buttons(R"("button_3":true)");  // the device's own stop
  EXPECT_TRUE(spring.gui.wait_until(stopped));
  spring.service.set_buttons(R"("button_3":false)");
  ASSERT_TRUE(spring.begins_anew());
  EXPECT_TRUE(stopped(spring.gui.state()));
  EXPECT_EQ(spring.felt_N(), 0.0);
  spring.gui.let_draw();
  spring.gui.click("devices.arm");
  EXPECT_TRUE(spring.becomes_felt());
}

TEST_F(DevicesTest, AStopThatWasEndedDoesNotComeBackWithAScene) {
  RecordedSpring spring("device_enabled");
  ASSERT_TRUE(spring.becomes_felt());
  spring.gui.click("devices.stop");
  EXPECT_TRUE(spring.gui.wait_until(stopped));
  spring.gui.let_draw();
  spring.gui.click("devices.arm");
  EXPECT_TRUE(spring.becomes_felt());
  ASSERT_TRUE(spring.begins_anew());
  EXPECT_FALSE(stopped(spring.gui.state()));
  EXPECT_TRUE(spring.becomes_felt());
}

/// A Touch of the tests' own libHD.
TEST_F(DevicesTest, OneThatNoLongerStartsLeavesTheSceneToTheMouseUntilItIsPluggedInAgain) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path unplugged = folder.path() / "unplugged";
  GuiProgram gui("device_unplugged", "spring --device touch --set touch.library=" FAKE_LIBHD,
                 "FAKE_HD_UNPLUGGED=" + unplugged.string());
  const auto phase_is = [](const char* phase) {
    return [phase](const json& state) { return !state["devices"].empty() && state["devices"][0]["phase"] == phase; };
  };
  const auto goes_on = [](const json& state) {
    return state["opening"] == false && state["recording"] == true && state["frame"]["time_s"].get<double>() > 0.2;
  };
  ASSERT_TRUE(gui.wait_until(phase_is("ready")));
  std::ofstream(unplugged).close();
  ASSERT_TRUE(gui.wait_until(phase_is("lost")));
  gui.let_draw();
  gui.click("keep.record");  // the scene from its start
  EXPECT_TRUE(gui.wait_until([&](const json& state) { return goes_on(state) && state["devices"].empty(); }));
  EXPECT_NE(gui.value_of("news.message").find("The mouse leads until you open a scene again."), std::string::npos);
  EXPECT_FALSE(stopped(gui.state()));
  gui.screenshot("mouse");
  std::filesystem::remove(unplugged);
  gui.let_draw();
  gui.click("keep.stop_recording");
  ASSERT_TRUE(gui.wait_until([](const json& state) { return state["recording"] == false; }));
  gui.let_draw();
  gui.click("keep.record");
  EXPECT_TRUE(gui.wait_until([&](const json& state) { return goes_on(state) && phase_is("ready")(state); }));
}

TEST_F(DevicesTest, TheHandsAxesAreThePicturesAfterItWasTurned) {
  device::inverse::FakeInverseService service({"049D"});
  const std::string port = std::to_string(service.port());
  GuiProgram gui("device_turned",
                 "spring --device inverse3 --set inverse3.port=" + port + " --set inverse3.version_port=" + port);
  ASSERT_TRUE(gui.wait_until(
      [](const json& state) { return !state["devices"].empty() && state["devices"][0]["phase"] == "ready"; }));
  const auto lateral_m = reach_of_tool(gui);  // the hand goes to and fro to its right
  EXPECT_GT(lateral_m[0], 0.01);
  EXPECT_LT(lateral_m[1], 0.003);
  gui.click("toolbar.cranial");
  gui.key_down("c");  // no force: the hand's axes follow the picture's
  EXPECT_TRUE(gui.wait_until([](const json& state) { return !state["turning"].get<bool>(); }));
  gui.let_draw();
  gui.key_up("c");
  const auto cranial_m = reach_of_tool(gui);
  EXPECT_LT(cranial_m[0], 0.003);
  EXPECT_GT(cranial_m[1], 0.01);
}

}  // namespace
}  // namespace myotact

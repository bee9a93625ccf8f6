#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gui/gui_program.h"

// How a person looks at the limb through the panel for it, and that undo takes a look back.

namespace myotact {
namespace {

using nlohmann::json;
using testing::GuiProgram;

class SeePanel : public testing::GuiTest {};

TEST_F(SeePanel, LayersNamesAndASectionAreSetAndTakenBack) {
  GuiProgram gui("see", "elbow --set tissue.default=line");
  gui.click("tasks.see");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.shows("see.labels"); }));
  EXPECT_EQ(gui.value_of("see.labels"), "off");
  gui.click("see.labels");
  const auto value_becomes = [&](const char* control, const char* value) {
    return gui.wait_until([&](const json&) { return gui.value_of(control) == value; });
  };
  EXPECT_TRUE(value_becomes("see.labels", "on"));
  EXPECT_FALSE(gui.shows("see.section_depth"));
  gui.click("see.section");
  EXPECT_TRUE(gui.wait_until([&](const json&) { return gui.shows("see.section_depth"); }));
  gui.screenshot("section");
  gui.click("toolbar.undo");
  EXPECT_TRUE(gui.wait_until([&](const json&) { return !gui.shows("see.section_depth"); }));
  EXPECT_EQ(gui.value_of("see.labels"), "on");
  gui.click("toolbar.undo");
  EXPECT_TRUE(value_becomes("see.labels", "off"));
}

}  // namespace
}  // namespace myotact

#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "gui/gui_program.h"
#include "support/source_folder.h"

// A window on a scene that a server simulates.

namespace myotact {
namespace {

using nlohmann::json;
using testing::GuiProgram;

class MirrorWindowTest : public testing::GuiTest {};

/// `myotact serve` on this machine; port 0 takes a free one.
struct ServerProgram {
  explicit ServerProgram(int wanted_port, const std::string& options = "") {
    program = std::make_unique<testing::Child>(
        MYOTACT_PROGRAM " serve particle --port " + std::to_string(wanted_port) + options, log);
    for (int i = 0; i < 300 && port == 0; ++i) {
      testing::pause_s(0.1);
      std::ifstream lines(log);
      for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("tcp ")) port = std::stoi(line.substr(line.rfind(':') + 1));
      }
    }
  }
  ~ServerProgram() {
    program.reset();
    std::filesystem::remove(log);
  }

  std::filesystem::path log =
      std::filesystem::temp_directory_path() / ("myotact_mirror_" + std::to_string(::getpid()) + ".log");
  std::unique_ptr<testing::Child> program;
  int port = 0;
};

double time_s(const json& state) {
  return state["frame"]["time_s"];
}

TEST_F(MirrorWindowTest, AnInstructorsWindowLeadsLosesItsServerAndFindsItAgain) {
  auto server = std::make_unique<ServerProgram>(0);
  const int port = server->port;
  ASSERT_NE(port, 0);
  GuiProgram gui("mirror", "--role instructor --device mouse --connect 127.0.0.1:" + std::to_string(port));
  ASSERT_TRUE(gui.wait_until([](const json& s) { return s["scene_name"] == "particle" && time_s(s) > 0.5; }));
  ASSERT_TRUE(gui.wait_until([](const json& s) { return !s["frame"]["tools"].empty(); }));  // the mouse is a hand of it
  gui.click("toolbar.pause");
  ASSERT_TRUE(gui.wait_until([](const json& s) { return s["scene"]["paused"] == true; }));
  testing::pause_s(0.5);
  const double paused_s = time_s(gui.state());
  testing::pause_s(1.0);
  EXPECT_EQ(time_s(gui.state()), paused_s);
  gui.click("toolbar.play");
  EXPECT_TRUE(gui.wait_until([&](const json& s) { return time_s(s) > paused_s + 0.2; }));

  ::kill(server->program->id(), SIGKILL);
  const auto says_so = [](const json& s) {
    return s["frame"]["notice"].get<std::string>().find("no connection") != std::string::npos;
  };
  EXPECT_TRUE(gui.wait_until(says_so));
  gui.screenshot("lost");
  server.reset();
  server = std::make_unique<ServerProgram>(port);
  EXPECT_TRUE(gui.wait_until([&](const json& s) { return !says_so(s) && time_s(s) > 0.2; }));
  EXPECT_TRUE(gui.program().running());
}

TEST_F(MirrorWindowTest, AClassIsJoinedFromTheStartPage) {
  const ServerProgram server(0);
  ASSERT_NE(server.port, 0);
  GuiProgram gui("start_join", "--set tissue.default=line");
  const auto fill = [&](const char* field, const std::string& text) {
    gui.click(field);
    gui.type(text);
    EXPECT_TRUE(gui.wait_until([&](const json&) { return gui.value_of(field) == text; })) << gui.value_of(field);
  };
  gui.click("start.join");
  fill("start.join.address", "127.0.0.1:" + std::to_string(server.port));
  fill("start.join.token", "no token");
  gui.screenshot("join");
  gui.click("start.join.now");
  EXPECT_TRUE(gui.wait_until([&](const json& s) {  // refused in a sentence, and the limb stays
    return gui.value_of("news.message").find("32 hexadecimal digits") != std::string::npos &&
           s["scene_name"] == "elbow";
  }));
  gui.click("toolbar.start");
  gui.click("start.join");
  fill("start.join.address", "127.0.0.1:" + std::to_string(server.port));
  gui.tap("Return");
  EXPECT_TRUE(gui.wait_until([](const json& s) { return s["scene_name"] == "particle" && time_s(s) > 0.2; }));
}

TEST_F(MirrorWindowTest, BigTypeShowsAClassTheWayIn) {
  if (!std::filesystem::exists(source_folder() + "/web/dist/index.html")) {
    GTEST_SKIP() << "the page of a class is not built: tools/build_web.sh";
  }
  const ServerProgram server(0, " --web --websocket-port 0");
  ASSERT_NE(server.port, 0);
  GuiProgram gui("class_way_in", "--role instructor --connect 127.0.0.1:" + std::to_string(server.port));
  ASSERT_TRUE(gui.wait_until([](const json& s) { return s["scene_name"] == "particle"; }));
  gui.key("F9");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.shows("class.qr"); }));
  EXPECT_EQ(gui.value_of("class.link").find("http://127.0.0.1:"), 0u) << gui.value_of("class.link");
  EXPECT_EQ(gui.value_of("class.present"), "In: 0, hands up: 0");
  gui.screenshot("way_in");
}

}  // namespace
}  // namespace myotact

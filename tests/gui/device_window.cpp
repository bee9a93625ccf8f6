#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <thread>

#include "anatomy/specimen.h"
#include "support/source_folder.h"
#include "view/view_frame.h"
#include "view/window/window.h"

// The program's window over a limb at rest, with two devices on the table that nobody has: a Falcon that is gone, in
// the right hand, and an Inverse3 at work in the left one. Takes what GuiProgram gives the program.

namespace myotact {
namespace {

std::vector<view::DeviceNews> table() {
  return {{"falcon", false, {messages::DevicePhase::Lost, 0.0, -1.0, "Plug the Falcon in again, with its power."}},
          {"inverse3", true, {messages::DevicePhase::Ready, 998.0, 0.62, ""}}};
}

messages::SceneFrame held_limb(const anatomy::Specimen& specimen) {
  messages::SceneFrame frame = testing::frame_at_rest(specimen);
  frame.tools.resize(2);
  for (messages::ToolFrame& tool : frame.tools) tool.radius_m = 3e-3;
  frame.tools[0].tool_world_m = frame.tools[0].proxy_world_m = {0.2, 0.2, 0.3};
  frame.tools[1].tool_world_m = frame.tools[1].proxy_world_m = {0.1, 0.2, 0.35};
  frame.tools[1].left = true;
  frame.tools[1].force_world_N = {0.0, 0.8, 0.0};
  return frame;
}

/// All forces as the person wants them.
class Gate {
 public:
  bool stopped(std::optional<bool> forces_on) {
    stopped_ = !forces_on.value_or(!stopped_);
    return stopped_;
  }

 private:
  bool stopped_ = false;
};

void run(const std::filesystem::path& report) {
  const anatomy::Specimen specimen =
      anatomy::load_specimen(std::filesystem::path(source_folder()) / "meshes" / "canine_elbow");
  messages::SceneFrame frame = held_limb(specimen);
  view::Window window;
  view::WindowSettings settings;
  settings.facts.title = "Myotact";
  settings.facts.device_peaks_N = {8.0, 3.0};
  window.open(specimen, settings);
  view::SessionNews news{false, 0.0};
  news.devices = table();
  Gate gate;
  while (!window.should_close()) {
    window.set_news(news);
    window.draw(frame);
    const bool stopped = gate.stopped(window.take_forces_on());
    for (messages::ToolFrame& tool : frame.tools) tool.forces_stopped = stopped;
    const std::filesystem::path next = report.string() + ".next";
    std::ofstream(next) << window.describe(frame);
    std::filesystem::rename(next, report);
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
  }
}

}  // namespace
}  // namespace myotact

int main(int count, char** arguments) {
  for (int i = 1; i + 1 < count; ++i) {
    if (std::string(arguments[i]) == "--report-state") myotact::run(arguments[i + 1]);
  }
}

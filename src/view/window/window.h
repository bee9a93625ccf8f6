#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "anatomy/specimen.h"
#include "messages/scene_frame.h"
#include "view/panels/panel.h"
#include "view/state/joint_readings.h"
#include "view/state/view_controls.h"

namespace myotact::view {

struct WindowSize {
  int width = 1280, height = 800;  // pixels
};

/// Of a scene that is opened.
struct WindowSettings {
  SceneFacts facts;
  messages::ControlState start;                // what is in force until a frame states it
  std::array<double, 3> hand_start_world_m{};  // where the mouse takes the hand up
  std::optional<SavedWork> work = {};          // that it begins with
};

/// The window: scene, panels, mouse and keys. Everything on the thread that made it.
class Window {
 public:
  /// Shows that a scene is being prepared, until open(). Throws Error Unavailable without a display or without OpenGL
  /// 3.3.
  /// `offers_start`: asks first what the person came for, while the scene is being prepared.
  explicit Window(const WindowSize& size = {}, bool offers_start = false);
  ~Window();

  /// Another scene, or the same one from its start; then view and settings stay. The specimen outlives its being shown.
  void open(const anatomy::Specimen& specimen, const WindowSettings& settings);
  /// Handles input, draws one picture, waits for the display. Returns what the person holds and moves.
  const ViewControls& draw(const messages::SceneFrame& frame);
  /// What the person asked of the scene since the last call.
  std::vector<messages::Command> take_commands();
  /// Whether the forces of all devices are to be enabled or stopped, once; none: as they are.
  std::optional<bool> take_forces_on();
  /// What the panel shows about the joint from the next picture on.
  void set_readings(const JointReadings& readings);
  void set_news(const SessionNews& news);
  /// How far the cap of a device that rotates the view is pushed: right, up, towards the person, each -1 .. 1. Once a
  /// picture.
  void push_view(const std::array<double, 3>& cap);
  /// A sentence for the person, in English or in the language of the window, shown until it has been read.
  void show_message(const std::string& message);
  /// The scene that the person wants to be opened, once.
  std::optional<SceneWish> take_wish();
  bool should_close() const;
  /// The next picture is also written to this PNG.
  void save_next_picture(const std::filesystem::path& path);
  /// What the last picture showed, as JSON: view, scene and where every control is (pixels of the window). For programs
  /// that assist a person, and for tests.
  std::string describe(const messages::SceneFrame& frame);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace myotact::view

#pragma once

#include <vector>

struct GLFWwindow;

namespace myotact::view {

/// The GLFW library and one window with a current OpenGL 3.3 context, for as long as this lives. The thread that made
/// it.
class GlfwWindow {
 public:
  /// Throws Error Unavailable without a display or without OpenGL 3.3.
  GlfwWindow(const char* title, int width, int height);
  ~GlfwWindow();
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;

  GLFWwindow* get() const { return window_; }

  struct KeyPress {
    int key = 0, mods = 0;  // GLFW_KEY_*, GLFW_MOD_*
  };
  /// Keys that went down since the last call: none is lost however slow the pictures are.
  std::vector<KeyPress> take_presses();
  bool is_down(int key) const;
  /// Over the whole screen, or back.
  void toggle_full_screen();

 private:
  struct Place {
    int x = 0, y = 0, width = 0, height = 0;
  };

  std::vector<KeyPress> presses_;
  Place before_;  // full screen; empty: it is not
  GLFWwindow* window_ = nullptr;
};

}  // namespace myotact::view

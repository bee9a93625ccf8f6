#pragma once

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

 private:
  GLFWwindow* window_ = nullptr;
};

}  // namespace myotact::view

#include "view/glfw_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "core/error.h"

namespace myotact::view {

GlfwWindow::GlfwWindow(const char* title, int width, int height) {
  const Error unavailable(ExitStatus::Unavailable,
                          "no display to open a window on (DISPLAY or WAYLAND_DISPLAY), or no OpenGL 3.3; \"myotact "
                          "run elbow\" works without one");
  if (glfwInit() != GLFW_TRUE) throw unavailable;
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_SAMPLES, 4);
  window_ = glfwCreateWindow(width, height, title, nullptr, nullptr);
  if (window_ == nullptr) {
    glfwTerminate();
    throw unavailable;
  }
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
}

GlfwWindow::~GlfwWindow() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

}  // namespace myotact::view

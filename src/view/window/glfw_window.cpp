#include "view/window/glfw_window.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <utility>

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <stb/stb_image.h>

#include "core/data_folder.h"
#include "core/error.h"

namespace myotact::view {

namespace {

constexpr int kSamples = 4;  // a pixel, against jagged edges

GLFWwindow* open_window(const char* title, int width, int height, int samples) {
  glfwWindowHint(GLFW_SAMPLES, samples);
  GLFWwindow* window = glfwCreateWindow(width, height, title, nullptr, nullptr);
  if (window != nullptr) glfwMakeContextCurrent(window);
  return window;
}

/// A window that is larger than its screen hides its edges there.
void fit_to_screen(int& width, int& height) {
  GLFWmonitor* screen = glfwGetPrimaryMonitor();
  if (screen == nullptr) return;
  int x = 0, y = 0, room_across = 0, room_down = 0;
  glfwGetMonitorWorkarea(screen, &x, &y, &room_across, &room_down);
  if (room_across > 0) width = std::min(width, room_across);
  if (room_down > 0) height = std::min(height, room_down);
}

/// Mesa's renderers without a graphics card, and Chromium's.
bool draws_in_software() {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string_view renderer = name != nullptr ? name : "";
  constexpr std::array kSoftware = {"llvmpipe", "softpipe", "swrast", "SwiftShader"};
  return std::any_of(kSoftware.begin(), kSoftware.end(),
                     [&](const char* word) { return renderer.find(word) != std::string_view::npos; });
}

/// The icon of the menu's entry; where it is not found the desktop's own stays.
void set_icon(GLFWwindow* window) {
  const std::filesystem::path data = data_folder();
  for (const auto& file : {data / "assets/desktop/myotact-48.png",  // in the sources, and installed
                           data.parent_path() / "icons/hicolor/48x48/apps/myotact.png"}) {
    constexpr int kRgba = 4;
    GLFWimage icon{};
    icon.pixels = stbi_load(file.c_str(), &icon.width, &icon.height, nullptr, kRgba);
    if (icon.pixels == nullptr) continue;
    glfwSetWindowIcon(window, 1, &icon);
    stbi_image_free(icon.pixels);
    return;
  }
}

}  // namespace

GlfwWindow::GlfwWindow(const char* title, int width, int height) {
  const Error unavailable(ExitStatus::Unavailable,
                          "no display to open a window on (DISPLAY or WAYLAND_DISPLAY), or no OpenGL 3.3; \"myotact "
                          "run elbow\" works without one");
  if (glfwInit() != GLFW_TRUE) throw unavailable;
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  // By these a desktop knows the program, and shows the name and icon of its menu entry.
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "Myotact");
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "myotact");
  fit_to_screen(width, height);
  window_ = open_window(title, width, height, kSamples);
  if (window_ != nullptr && draws_in_software()) {
    // There the samples cost three times the whole picture.
    glfwDestroyWindow(window_);
    window_ = open_window(title, width, height, 0);
  }
  if (window_ == nullptr) {
    glfwTerminate();
    throw unavailable;
  }
  set_icon(window_);
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(window_, this);
  // Before the panels' library, which calls on what it finds.
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int mods) {
    constexpr int kMods = GLFW_MOD_SHIFT | GLFW_MOD_CONTROL | GLFW_MOD_ALT;
    if (action != GLFW_PRESS) return;
    static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window))->presses_.push_back({key, mods & kMods});
  });
}

std::vector<GlfwWindow::KeyPress> GlfwWindow::take_presses() {
  return std::exchange(presses_, {});
}

bool GlfwWindow::is_down(int key) const {
  return glfwGetKey(window_, key) == GLFW_PRESS;
}

void GlfwWindow::toggle_full_screen() {
  if (before_.width > 0) {
    glfwSetWindowMonitor(window_, nullptr, before_.x, before_.y, before_.width, before_.height, GLFW_DONT_CARE);
    before_ = {};
    return;
  }
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  if (mode == nullptr) return;
  glfwGetWindowPos(window_, &before_.x, &before_.y);
  glfwGetWindowSize(window_, &before_.width, &before_.height);
  glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

GlfwWindow::~GlfwWindow() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

}  // namespace myotact::view

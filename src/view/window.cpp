#include "view/window.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <vector>

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>

#include "core/error.h"
#include "messages/device.h"
#include "view/camera.h"
#include "view/key_bindings.h"
#include "view/offscreen.h"
#include "view/panels.h"
#include "view/scene_renderer.h"

namespace myotact::view {

namespace {

constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr float kFontSize = 15.0f;
constexpr float kDepthStep_m = 0.005f;  // of the hand, a click of the wheel

/// The GLFW library and one window with a current context.
class GlfwWindow {
 public:
  explicit GlfwWindow(const WindowSettings& settings) {
    const Error unavailable(ExitStatus::Unavailable,
                            "no display to open a window on (DISPLAY or WAYLAND_DISPLAY), or no OpenGL 3.3; \"myotact "
                            "run elbow\" works without one");
    if (glfwInit() != GLFW_TRUE) throw unavailable;
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_SAMPLES, 4);
    window_ = glfwCreateWindow(settings.width, settings.height, settings.title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) {
      glfwTerminate();
      throw unavailable;
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
  }
  ~GlfwWindow() {
    glfwDestroyWindow(window_);
    glfwTerminate();
  }
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;

  GLFWwindow* get() const { return window_; }

 private:
  GLFWwindow* window_ = nullptr;
};

class ImGuiSession {
 public:
  explicit ImGuiSession(GLFWwindow* window) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().LogFilename = nullptr;
    if (std::filesystem::exists(kFont)) ImGui::GetIO().Fonts->AddFontFromFileTTF(kFont, kFontSize);
    ImGui::StyleColorsDark();
    ImGui::GetStyle().WindowRounding = 0.0f;
    ImGui::GetStyle().FrameRounding = 3.0f;
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    ImGui_ImplOpenGL3_Init("#version 330");
  }
  ~ImGuiSession() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
  }
  ImGuiSession(const ImGuiSession&) = delete;
  ImGuiSession& operator=(const ImGuiSession&) = delete;
};

const char* view_of(KeyAction action) {
  switch (action) {
    case KeyAction::Lateral:
      return "lateral";
    case KeyAction::Medial:
      return "medial";
    case KeyAction::Cranial:
      return "cranial";
    case KeyAction::Caudal:
      return "caudal";
    case KeyAction::Dorsal:
      return "dorsal";
    case KeyAction::Palmar:
      return "palmar";
    default:
      return nullptr;
  }
}

}  // namespace

struct Window::Impl {
  Impl(const anatomy::Specimen& given, const WindowSettings& settings)
      : specimen(&given), window(settings), imgui(window.get()), renderer(given), bounds(bounds_of(given)) {
    panels.device_peaks_N = settings.device_peaks_N;
    panels.note = settings.note;
    panels.joint = settings.joint;
    controls = settings.start;
    controls.hand_world_m = settings.hand_start_world_m;
    look("lateral");
  }

  void look(const char* name) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float aspect = display.x > kPanelWidth && display.y > 0.0f ? (display.x - kPanelWidth) / display.y : 1.0f;
    camera = standard_view(name, specimen->side != "right", bounds, aspect).value_or(camera);
  }

  void act(KeyAction action) {
    switch (action) {
      case KeyAction::Help:
        panels.help = !panels.help;
        return;
      case KeyAction::PauseOrPlay:
        controls.paused = !controls.paused;
        return;
      case KeyAction::Step:
        ++controls.steps;
        return;
      case KeyAction::Reset:
        ++controls.resets;
        return;
      case KeyAction::FrameAll:
        look("lateral");
        return;
      case KeyAction::StopForces:
        ++controls.stops;
        return;
      case KeyAction::EnableForces:
        ++controls.arms;
        return;
      case KeyAction::Screenshot:
        screenshot = "myotact.png";
        return;
      case KeyAction::GrabLine:
      case KeyAction::GrabBone:
        return;  // held: read in move_hand()
      default:
        look(view_of(action));
        return;
    }
  }

  void handle_keys() {
    const bool types = ImGui::GetIO().WantTextInput;
    for (const KeyBinding& binding : key_bindings()) {
      if (types && binding.action != KeyAction::StopForces) continue;  // a stop goes before anything else
      if (ImGui::IsKeyPressed(binding.key, false)) act(binding.action);
    }
  }

  bool is_down(KeyAction action) const {
    return std::any_of(key_bindings().begin(), key_bindings().end(), [&](const KeyBinding& binding) {
      return binding.action == action && glfwGetKey(window.get(), binding.key) == GLFW_PRESS;
    });
  }

  /// With Ctrl held the mouse moves the hand in the plane of the picture, the wheel in its depth.
  void move_hand(const ImVec2& motion, float wheel) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float metres_a_pixel = 2.0f * camera.distance_m * std::tan(0.5f * Camera::kFieldOfView_rad) / display.y;
    const glm::vec3 step = metres_a_pixel * (motion.x * camera.right_world() - motion.y * camera.up_world()) +
                           kDepthStep_m * wheel * camera.forward_world();
    for (int k = 0; k < 3; ++k) controls.hand_world_m[static_cast<std::size_t>(k)] += static_cast<double>(step[k]);
  }

  void handle_mouse() {
    const ImGuiIO& io = ImGui::GetIO();
    controls.hand_moves = io.KeyCtrl;
    controls.hand_buttons = 0;
    if (is_down(KeyAction::GrabLine)) controls.hand_buttons |= messages::kGrabButton;
    if (is_down(KeyAction::GrabBone)) controls.hand_buttons |= messages::kGrabBoneButton;
    if (io.WantCaptureMouse) return;
    if (io.KeyCtrl) {
      move_hand(io.MouseDelta, io.MouseWheel);
      return;
    }
    if (ImGui::IsMouseDragging(ImGuiMouseButton_Left, 0.0f))
      camera.orbit(-0.008f * io.MouseDelta.x, 0.008f * io.MouseDelta.y);
    if (ImGui::IsMouseDragging(ImGuiMouseButton_Right, 0.0f)) {
      camera.pan(io.MouseDelta.x / io.DisplaySize.y, -io.MouseDelta.y / io.DisplaySize.y);
    }
    if (io.MouseWheel != 0.0f) camera.zoom(std::pow(0.9f, io.MouseWheel));
  }

  /// Read before the buffers are swapped: afterwards their content is undefined.
  void save_picture(int width, int height) {
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
    write_png(*screenshot, flipped(width, height, pixels));
    screenshot.reset();
  }

  const anatomy::Specimen* specimen;
  GlfwWindow window;
  ImGuiSession imgui;
  SceneRenderer renderer;
  ViewBox bounds;
  Camera camera;
  PanelState panels;
  ViewControls controls;
  std::optional<std::filesystem::path> screenshot;
};

Window::Window(const anatomy::Specimen& specimen, const WindowSettings& settings)
    : impl_(std::make_unique<Impl>(specimen, settings)) {}

Window::~Window() = default;

void Window::set_readings(const JointReadings& readings) {
  impl_->panels.readings = readings;
}

bool Window::should_close() const {
  return glfwWindowShouldClose(impl_->window.get()) == GLFW_TRUE;
}

void Window::save_next_picture(const std::filesystem::path& path) {
  impl_->screenshot = path;
}

const ViewControls& Window::draw(const messages::SceneFrame& frame) {
  glfwPollEvents();
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  draw_panels(*impl_->specimen, frame, impl_->panels, impl_->controls);
  impl_->handle_keys();
  impl_->handle_mouse();
  ImGui::Render();
  int width = 0, height = 0;
  glfwGetFramebufferSize(impl_->window.get(), &width, &height);
  const float scale = static_cast<float>(width) / std::max(ImGui::GetIO().DisplaySize.x, 1.0f);
  impl_->renderer.draw(frame, impl_->camera, std::max(width - static_cast<int>(kPanelWidth * scale), 1), height);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  if (impl_->screenshot) impl_->save_picture(width, height);
  glfwSwapBuffers(impl_->window.get());
  return impl_->controls;
}

}  // namespace myotact::view

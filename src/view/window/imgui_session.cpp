#include "view/window/imgui_session.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>

#include "view/ui/font.h"
#include "view/ui/layout.h"

namespace myotact::view {

namespace {

constexpr float kFontSize = 15.0f;  // pixels
constexpr float kLargestDisplayScale = 3.0f;

}  // namespace

ImGuiSession::ImGuiSession(GLFWwindow* window) : window_(window) {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().LogFilename = nullptr;
  ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  ImGui::GetIO().MouseDoubleClickTime = 0.5f;  // seconds; slow pictures see clicks late
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  ImGui_ImplOpenGL3_Init("#version 330");
  set_scale(1.0f);
}

void ImGuiSession::set_scale(float scale) {
  float across = 1.0f, down = 1.0f;
  glfwGetWindowContentScale(window_, &across, &down);
  const float display = std::clamp(across, 1.0f, kLargestDisplayScale);
  int width = 0, height = 0;
  glfwGetWindowSize(window_, &width, &height);
  const float largest =
      std::floor(largest_em(static_cast<float>(width), static_cast<float>(height))) / (kFontSize * display);
  const float wanted = (scale <= 1.0f ? scale : std::clamp(largest, 1.0f, scale)) * display;
  if (wanted == drawn_scale_) return;
  if (drawn_scale_ > 0.0f) ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui::GetIO().Fonts->Clear();
  has_font_ = ui::add_font(std::round(kFontSize * wanted));
  if (drawn_scale_ > 0.0f) ImGui_ImplOpenGL3_CreateFontsTexture();
  drawn_scale_ = wanted;
  ImGuiStyle scaled;
  scaled.WindowRounding = 0.0f;
  scaled.FrameRounding = scaled.GrabRounding = scaled.TabRounding = 5.0f;
  scaled.PopupRounding = 6.0f;
  scaled.FramePadding = ImVec2(7.0f, 3.0f);
  scaled.ItemSpacing = ImVec2(7.0f, 5.0f);
  scaled.ScaleAllSizes(wanted);
  std::copy(std::begin(ImGui::GetStyle().Colors), std::end(ImGui::GetStyle().Colors), std::begin(scaled.Colors));
  ImGui::GetStyle() = scaled;
}

ImGuiSession::~ImGuiSession() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void ImGuiSession::begin() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void ImGuiSession::end() {
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace myotact::view

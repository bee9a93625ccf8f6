#include "view/pictures/headless_imgui.h"

#include <imgui.h>
#include <imgui_impl_opengl3.h>

#include "view/ui/font.h"

namespace myotact::view {

HeadlessImGui::HeadlessImGui(int width, int height, float font_px) {
  other_ = ImGui::GetCurrentContext();
  context_ = ImGui::CreateContext();
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.DisplaySize = ImVec2(static_cast<float>(width), static_cast<float>(height));
  ui::add_font(font_px);
  ImGui_ImplOpenGL3_Init("#version 330");
  ImGui::SetCurrentContext(other_);
}

HeadlessImGui::~HeadlessImGui() {
  other_ = ImGui::GetCurrentContext();
  ImGui::SetCurrentContext(context_);
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext(context_);
  ImGui::SetCurrentContext(other_);
}

void HeadlessImGui::begin() {
  other_ = ImGui::GetCurrentContext();
  ImGui::SetCurrentContext(context_);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
}

ImDrawList* HeadlessImGui::list() {
  return ImGui::GetBackgroundDrawList();
}

void HeadlessImGui::end() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  ImGui::SetCurrentContext(other_);
}

}  // namespace myotact::view

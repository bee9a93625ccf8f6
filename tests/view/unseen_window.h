#pragma once

#include <imgui.h>

#include "view/ui/controls.h"
#include "view/ui/font.h"
#include "view/ui/text.h"

namespace myotact::testing {

/// A window of 1280 x 800 pixels that nobody sees, in English, without OpenGL: one for a test.
class UnseenWindow {
 public:
  UnseenWindow() {
    ImGui::CreateContext();
    ImGui::GetIO().DisplaySize = ImVec2(1280.0f, 800.0f);
    ImGui::GetIO().IniFilename = nullptr;
    view::ui::add_font(15.0f);
    ImGui::GetIO().Fonts->Build();
    view::ui::set_language("en");
  }
  ~UnseenWindow() {
    view::ui::set_language("en");
    ImGui::DestroyContext();
  }
  UnseenWindow(const UnseenWindow&) = delete;
  UnseenWindow& operator=(const UnseenWindow&) = delete;

  /// One picture, a fiftieth of a second after the last.
  template <typename Paint>
  void picture(const Paint& paint) {
    ImGui::GetIO().DeltaTime = 0.02f;
    ImGui::NewFrame();
    view::ui::begin_controls();
    paint();
    ImGui::Render();
  }
};

}  // namespace myotact::testing

#include "view/ui/font.h"

#include <filesystem>

#include <imgui.h>

namespace myotact::view::ui {

namespace {

constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

}  // namespace

void add_font(float height_px) {
  if (std::filesystem::exists(kFont)) ImGui::GetIO().Fonts->AddFontFromFileTTF(kFont, height_px);
}

}  // namespace myotact::view::ui

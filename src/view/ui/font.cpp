#include "view/ui/font.h"

#include <filesystem>
#include <system_error>

#include <imgui.h>

namespace myotact::view::ui {

bool add_font(float height_px, const char* file) {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  std::error_code refused;
  if (std::filesystem::is_regular_file(file, refused)) {
    fonts.AddFontFromFileTTF(file, height_px);
    return true;
  }
  ImFontConfig built_in;
  built_in.SizePixels = height_px;
  fonts.AddFontDefault(&built_in);
  return false;
}

}  // namespace myotact::view::ui

#include "view/ui/font.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <system_error>

#include <imgui.h>

#include "view/ui/icons.h"

namespace myotact::view::ui {

namespace {

bool is_there(const char* file) {
  std::error_code refused;
  return std::filesystem::is_regular_file(file, refused);
}

/// Into the font that was added last.
void add_icons(float height_px) {
  if (!is_there(kIconFont)) return;
  constexpr float kSmaller = 0.93f;  // they are wider and taller than letters of the same height
  ImFontConfig icons;
  icons.MergeMode = true;
  icons.GlyphMinAdvanceX = height_px;  // one under the other, they stand in a column
  ImGui::GetIO().Fonts->AddFontFromFileTTF(kIconFont, kSmaller * height_px, &icons, icon_ranges());
}

/// In the order of Type, after the text.
void add_bold(float height_px) {
  if (!is_there(kBoldFont)) return;
  constexpr std::array kSizes = {1.0f, 1.35f, 2.2f};  // of the text's height
  for (const float size : kSizes) ImGui::GetIO().Fonts->AddFontFromFileTTF(kBoldFont, std::round(size * height_px));
}

}  // namespace

bool add_font(float height_px, std::span<const char* const> files) {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  const auto found = std::find_if(files.begin(), files.end(), is_there);
  if (found != files.end()) {
    fonts.AddFontFromFileTTF(*found, height_px);
    add_icons(height_px);
    add_bold(height_px);
    return true;
  }
  ImFontConfig built_in;
  built_in.SizePixels = height_px;
  fonts.AddFontDefault(&built_in);
  return false;
}

void push_type(Type type) {
  const ImVector<ImFont*>& fonts = ImGui::GetIO().Fonts->Fonts;
  const auto wanted = static_cast<int>(type);
  ImGui::PushFont(fonts[wanted < fonts.Size ? wanted : 0]);
}

}  // namespace myotact::view::ui

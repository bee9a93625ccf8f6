#include "view/session/settings.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <initializer_list>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <imgui.h>
#include <unistd.h>

#include "core/file.h"
#include "view/ui/font.h"
#include "view/ui/theme.h"

namespace myotact::view {
namespace {

/// WCAG 2.1: relative luminance of an sRGB colour.
double luminance(const ImVec4& c) {
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  return 0.2126 * linear(c.x) + 0.7152 * linear(c.y) + 0.0722 * linear(c.z);
}

ImVec4 over(const ImVec4& top, const ImVec4& below) {
  const auto mix = [&](float a, float b) { return top.w * a + (1.0f - top.w) * b; };
  return {mix(top.x, below.x), mix(top.y, below.y), mix(top.z, below.z), 1.0f};
}

class Themes : public ::testing::TestWithParam<ui::Theme> {};

TEST_P(Themes, EveryTextStandsOut) {
  ImGui::CreateContext();
  ui::apply_theme(GetParam());
  for (const float behind : {0.0f, 1.0f}) {  // windows let a little of what is behind them through
    const ImVec4 window = over(ImGui::GetStyleColorVec4(ImGuiCol_WindowBg), {behind, behind, behind, 1.0f});
    for (const ui::TextPair& pair : ui::text_pairs()) {
      const ImVec4 ground = over(ImGui::GetStyleColorVec4(pair.ground), window);
      const double a = luminance(over(ImGui::GetStyleColorVec4(pair.text), ground)), b = luminance(ground);
      EXPECT_GE((std::max(a, b) + 0.05) / (std::min(a, b) + 0.05), 4.5)
          << ImGui::GetStyleColorName(pair.text) << " on " << ImGui::GetStyleColorName(pair.ground);
    }
  }
  ImGui::DestroyContext();
}

INSTANTIATE_TEST_SUITE_P(Both, Themes, ::testing::Values(ui::Theme::Dark, ui::Theme::Light, ui::Theme::Contrast));

TEST(Font, WithoutItsFileIsTheBuiltInOneInTheSameHeight) {
  for (const char* file : {"/no/such/font.ttf", "/tmp"}) {
    ImGui::CreateContext();
    EXPECT_FALSE(ui::add_font(24.0f, std::array{file}));
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    ASSERT_TRUE(fonts.Build());
    ASSERT_EQ(fonts.Fonts.Size, 1);
    EXPECT_EQ(fonts.Fonts[0]->FontSize, 24.0f);
    for (const ImWchar letter : std::initializer_list<ImWchar>{0x41, 0xe4, 0xdf})
      EXPECT_NE(fonts.Fonts[0]->FindGlyphNoFallback(letter), nullptr);
    ImGui::DestroyContext();
  }
}

/// A folder of its own: tests run beside each other.
std::filesystem::path folder_of_test() {
  return std::filesystem::path(::testing::TempDir()) / fmt::format("myotact_settings_{}", ::getpid());
}

struct SettingsFile : ::testing::Test {
  ~SettingsFile() override { std::filesystem::remove_all(folder); }
  std::filesystem::path folder = folder_of_test();
  std::filesystem::path file = folder / "settings.json";
  std::string message;
};

TEST_F(SettingsFile, IsReadAsItWasWritten) {
  EXPECT_EQ(read_settings(file), Settings{});
  const Settings liked{"de", true, 1.25, true, true, true, MousePreset::Blender, {{"search", "Ctrl+K"}}};
  write_settings(liked, file);
  EXPECT_EQ(settings_or_defaults(file, message), liked);
  EXPECT_EQ(message, "");
}

TEST_F(SettingsFile, ThatCannotBeUsedIsSetAside) {
  make_writable_folder(folder);
  for (const char* text : {"", "{\"schema\": 1, \"langu", "{\"schema\": 2}", "{\"schema\": 1, \"langauge\": \"de\"}",
                           "{\"schema\": 1, \"theme\": \"pink\"}", "[]", "{\"schema\": 1, \"mouse\": \"two\"}",
                           "{\"schema\": 1, \"keys\": {\"search\": \"H\"}}",
                           "{\"schema\": 1, \"keys\": {\"search\": \"Ctrl\"}}", "{\"schema\": 1, \"keys\": 3}"}) {
    message.clear();
    write_file(file, text);
    EXPECT_EQ(settings_or_defaults(file, message), Settings{}) << text;
    EXPECT_NE(message.find("settings.json.broken"), std::string::npos) << message;
    EXPECT_FALSE(std::filesystem::exists(file));
    EXPECT_EQ(read_file(file.string() + ".broken"), text);
  }
}

}  // namespace
}  // namespace myotact::view

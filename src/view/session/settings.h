#pragma once

#include <filesystem>
#include <string>

#include "view/input/key_choice.h"
#include "view/input/mouse_preset.h"

namespace myotact::view {

/// What a person likes, kept from one start to the next.
struct Settings {
  std::string language = "en";  // a folder of assets/languages
  bool light = false;           // theme
  double scale = 1.0;           // of everything written and clicked on, kSmallestScale .. kLargestScale
  bool free_orbit = false;      // a drag rotates the limb any way
  bool tour_done = false;       // or skipped
  bool tone = false;            // that rises with the force
  MousePreset mouse = MousePreset::ThreeButton;
  ChosenKeys keys = {};  // in place of the first ones

  friend bool operator==(const Settings&, const Settings&) = default;
};

inline constexpr double kSmallestScale = 0.75, kLargestScale = 2.0;

/// $XDG_CONFIG_HOME/myotact/settings.json, or ~/.config/... in its place; empty without a home.
std::filesystem::path settings_file();

/// The defaults where there is no such file. Throws Error BadData, or what reading throws.
Settings read_settings(const std::filesystem::path& file);
/// The same from the text of one; `file` is only named in errors.
Settings parse_settings(const std::string& text, const std::string& file);
/// What write_settings() writes.
std::string settings_text(const Settings& settings);
/// As read_settings(), but a file that cannot be used is renamed to FILE.broken and `message` reports it.
Settings settings_or_defaults(const std::filesystem::path& file, std::string& message);
/// Makes the folder. Throws Error InputOutput.
void write_settings(const Settings& settings, const std::filesystem::path& file);

/// To the window: its language, and the colours of the current ImGui context. The scale is ImGuiSession's.
void apply(const Settings& settings);

}  // namespace myotact::view

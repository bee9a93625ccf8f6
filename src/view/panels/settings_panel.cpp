#include "view/panels/settings_panel.h"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "view/ui/controls.h"
#include "view/ui/retold.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

bool choose_language(Settings& settings) {
  const std::vector<std::string> codes = ui::languages();
  std::vector<std::string> keys;
  for (const std::string& code : codes) keys.push_back(fmt::format("comfort.language.{}", code));
  std::vector<const char*> options;
  for (const std::string& key : keys) options.push_back(key.c_str());
  int chosen = static_cast<int>(std::find(codes.begin(), codes.end(), settings.language) - codes.begin());
  if (!ui::choice("comfort.language", chosen, options)) return false;
  settings.language = codes[static_cast<std::size_t>(chosen)];
  return true;
}

}  // namespace

void SettingsPanel::draw(Settings& settings, std::string& message) {
  constexpr std::array kThemes = {"comfort.theme.dark", "comfort.theme.light"};
  int theme = settings.light ? 1 : 0;
  bool changed = choose_language(settings);
  if (ui::choice("comfort.theme", theme, kThemes)) {
    settings.light = theme == 1;
    changed = true;
  }
  double scale = dragged_scale_.value_or(settings.scale);
  const ui::Range range{static_cast<float>(kSmallestScale), static_cast<float>(kLargestScale)};
  if (ui::slider("comfort.scale", scale, range, "%.2f")) dragged_scale_ = scale;
  if (dragged_scale_ && !ui::is_held()) {
    settings.scale = std::clamp(*dragged_scale_, kSmallestScale, kLargestScale);
    dragged_scale_.reset();
    changed = true;
  }
  constexpr std::array kMice = {"mouse.three_button", "mouse.trackpad", "mouse.blender"};  // as in MousePreset
  int mouse = static_cast<int>(settings.mouse);
  if (ui::choice("comfort.mouse", mouse, kMice)) {
    settings.mouse = static_cast<MousePreset>(mouse);
    changed = true;
  }
  changed = ui::checkbox("comfort.free_orbit", settings.free_orbit) || changed;
  changed = ui::checkbox("comfort.tone", settings.tone) || changed;
  if (ui::button("comfort.tour")) {
    settings.tour_done = false;
    changed = true;
  }
  changed = keys_.draw(settings.keys) || changed;
  if (changed) keep(settings, message);
}

bool SettingsPanel::take_key(const KeyPressed& pressed, Settings& settings, std::string& message) {
  if (!keys_.waits()) return false;
  if (keys_.take(pressed, settings.keys)) keep(settings, message);
  return true;
}

void keep(const Settings& settings, std::string& message) {
  apply(settings);
  try {
    write_settings(settings, settings_file());
  } catch (const Error& failure) {
    message = ui::retold(failure.what());
  }
}

}  // namespace myotact::view

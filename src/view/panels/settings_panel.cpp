#include "view/panels/settings_panel.h"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "view/ui/controls.h"
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

void draw_settings_panel(Settings& settings, std::string& message) {
  constexpr std::array kThemes = {"comfort.theme.dark", "comfort.theme.light"};
  int theme = settings.light ? 1 : 0;
  bool changed = choose_language(settings);
  if (ui::choice("comfort.theme", theme, kThemes)) {
    settings.light = theme == 1;
    changed = true;
  }
  if (!changed) return;
  apply(settings);
  try {
    write_settings(settings, settings_file());
  } catch (const Error& failure) {
    message = failure.what();
  }
}

}  // namespace myotact::view

#include "view/session/settings.h"

#include <algorithm>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/file.h"
#include "core/json_reader.h"
#include "core/user_folder.h"
#include "view/ui/retold.h"
#include "view/ui/text.h"
#include "view/ui/theme.h"

namespace myotact::view {

namespace {

constexpr int kSchema = 1;
const std::vector<std::string> kMice = {"three_button", "trackpad", "blender"};  // as in MousePreset

}  // namespace

std::filesystem::path settings_file() {
  const std::filesystem::path own = user_config_folder();
  return own.empty() ? own : own / "settings.json";
}

Settings read_settings(const std::filesystem::path& file) {
  if (file.empty() || !std::filesystem::exists(file)) return {};
  return parse_settings(read_file(file), file.string());
}

Settings parse_settings(const std::string& text, const std::string& file) {
  Settings settings;
  const nlohmann::json json = parse_json(text, file);
  JsonObject object{JsonValue(json, file)};
  object.at("schema").integer_between(kSchema, kSchema);
  if (const auto language = object.find("language")) settings.language = language->one_of(ui::languages());
  if (const auto theme = object.find("theme")) settings.light = theme->one_of({"dark", "light"}) == "light";
  if (const auto scale = object.find("scale")) settings.scale = scale->number_between(kSmallestScale, kLargestScale);
  settings.free_orbit = object.boolean_or("free_orbit", settings.free_orbit);
  settings.tone = object.boolean_or("tone", settings.tone);
  settings.tour_done = object.boolean_or("tour_done", settings.tour_done);
  if (const auto mouse = object.find("mouse")) {
    const auto place = std::find(kMice.begin(), kMice.end(), mouse->one_of(kMice)) - kMice.begin();
    settings.mouse = static_cast<MousePreset>(place);
  }
  if (const auto keys = object.find("keys")) settings.keys = chosen_keys(*keys);
  object.finish();
  return settings;
}

Settings settings_or_defaults(const std::filesystem::path& file, std::string& message) {
  try {
    return read_settings(file);
  } catch (const Error& failure) {
    const auto aside = set_aside(file);
    message = aside ? ui::tr("comfort.set_aside", ui::retold(failure.what()), aside->string())
                    : ui::tr("comfort.unusable", ui::retold(failure.what()), file.string() + ".broken");
    return {};
  }
}

void write_settings(const Settings& settings, const std::filesystem::path& file) {
  if (file.empty()) {
    throw Error(ExitStatus::InputOutput, "there is no folder for your settings: set HOME or XDG_CONFIG_HOME to one");
  }
  make_writable_folder(file.parent_path());
  write_file(file, settings_text(settings));
}

std::string settings_text(const Settings& settings) {
  const nlohmann::json json = {{"schema", kSchema},
                               {"language", settings.language},
                               {"theme", settings.light ? "light" : "dark"},
                               {"scale", settings.scale},
                               {"free_orbit", settings.free_orbit},
                               {"tone", settings.tone},
                               {"tour_done", settings.tour_done},
                               {"mouse", kMice[static_cast<std::size_t>(settings.mouse)]},
                               {"keys", settings.keys}};
  return json.dump(2) + "\n";
}

void apply(const Settings& settings) {
  ui::set_language(settings.language);
  ui::apply_theme(settings.light ? ui::Theme::Light : ui::Theme::Dark);
}

}  // namespace myotact::view

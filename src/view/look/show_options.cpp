#include "view/look/show_options.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"

namespace myotact::view {

namespace {

constexpr int kSmallest_px = 16, kLargest_px = 8192;  // of a picture: what OpenGL draws everywhere

/// One setting in the making: how it was written, for messages.
struct Setting {
  std::string text, value;
  const anatomy::Specimen& specimen;
  ViewState& view;

  Error wrong(const std::string& why) const { return {ExitStatus::Usage, fmt::format("--show {}: {}", text, why)}; }
  /// Place of a word among those known.
  std::size_t one_of(const std::string& word, const std::vector<std::string>& known) const {
    const auto found = std::find(known.begin(), known.end(), word);
    if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
    throw wrong(fmt::format("there is no \"{}\" here; the nearest is \"{}\", of: {}", word, nearest_word(word, known),
                            join(known)));
  }
  bool on() const { return one_of(value, {"off", "on"}) == 1; }
};

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == at) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

double number_or(const std::string& text, double otherwise) {
  return parse_number(text).value_or(otherwise);
}

template <typename Parts>
std::vector<std::string> keys_of(const Parts& parts) {
  std::vector<std::string> keys;
  for (const auto& part : parts) keys.push_back(part.key);
  return keys;
}

/// For each of the known words whether it is among those asked for; "all" and "none" besides.
std::vector<bool> chosen(const Setting& setting, const std::vector<std::string>& known) {
  if (setting.value == "all") return std::vector<bool>(known.size(), true);
  std::vector<bool> among(known.size(), false);
  if (setting.value == "none") return among;
  for (const std::string& word : split(setting.value, ',')) among[setting.one_of(word, known)] = true;
  return among;
}

void show_only(const std::vector<bool>& among, std::vector<PartLook>& looks) {
  for (std::size_t i = 0; i < looks.size(); ++i) looks[i].hidden = !among[i];
}

/// Muscles first.
std::vector<std::string> keys_of_all_parts(const anatomy::Specimen& specimen) {
  std::vector<std::string> keys = keys_of(specimen.muscles);
  const std::vector<std::string> bones = keys_of(specimen.bones);
  keys.insert(keys.end(), bones.begin(), bones.end());
  return keys;
}

void fade(const Setting& setting) {
  const std::vector<bool> among = chosen(setting, keys_of_all_parts(setting.specimen));
  const std::size_t muscles = setting.specimen.muscles.size();
  for (std::size_t i = 0; i < among.size(); ++i) {
    PartLook& look = i < muscles ? setting.view.muscles[i] : setting.view.bones[i - muscles];
    look.faded = among[i];
  }
}

void select(const Setting& setting) {
  const auto i = static_cast<int>(setting.one_of(setting.value, keys_of_all_parts(setting.specimen)));
  const auto muscles = static_cast<int>(setting.specimen.muscles.size());
  setting.view.selected_muscle = i < muscles ? i : -1;
  setting.view.selected_bone = i < muscles ? -1 : i - muscles;
}

void choose_layers(const Setting& setting) {
  const std::vector<bool> among = chosen(setting, {"superficial", "deep", "bones"});
  setting.view.layers = {among[0] ? 1.0f : 0.0f, among[1] ? 1.0f : 0.0f, among[2] ? 1.0f : 0.0f};
}

void choose_section(const Setting& setting) {
  const std::vector<std::string> parts = split(setting.value, ':');
  const double share = number_or(parts.size() == 2 ? parts[1] : "", -1.0);
  if (!(share >= 0.0 && share <= 1.0)) {
    throw setting.wrong("must be a side and a share 0 .. 1, for example section=cranial:0.5");
  }
  // The world's axes: x cranial, y left, z up. What lies beyond the place goes.
  const auto side = setting.one_of(parts[0], {"cranial", "caudal", "left", "right", "dorsal", "ventral"});
  const bool flipped = side % 2 == 1;
  setting.view.section = {true, flipped, static_cast<int>(side / 2), static_cast<float>(flipped ? 1.0 - share : share)};
}

struct Known {
  const char* name;
  std::function<void(const Setting&)> apply;
};

const std::vector<Known>& known_settings() {
  static const std::vector<Known> known = {
      {"muscles", [](const Setting& s) { show_only(chosen(s, keys_of(s.specimen.muscles)), s.view.muscles); }},
      {"bones", [](const Setting& s) { show_only(chosen(s, keys_of(s.specimen.bones)), s.view.bones); }},
      {"faded", fade},
      {"select", select},
      {"layers", choose_layers},
      {"colour",
       [](const Setting& s) {
         s.view.colour = static_cast<MuscleColour>(s.one_of(
             s.value, {"kind", "activation", "tension", "stretch", "volume_error", "stiffness_share", "pressure"}));
       }},
      {"names",
       [](const Setting& s) {
         s.view.names = static_cast<NameStyle>(s.one_of(s.value, {"english", "latin", "both"}));
       }},
      {"section", choose_section},
      {"labels", [](const Setting& s) { s.view.labels = s.on(); }},
      {"lines", [](const Setting& s) { s.view.lines = s.on(); }},
      {"fibres", [](const Setting& s) { s.view.fibres = s.on(); }},
      {"attachments", [](const Setting& s) { s.view.attachments = s.on(); }}};
  return known;
}

}  // namespace

void apply_show_options(std::span<const std::string> options, const anatomy::Specimen& specimen, ViewState& view) {
  std::vector<std::string> names;
  for (const Known& known : known_settings()) names.emplace_back(known.name);
  for (const std::string& option : options) {
    const std::size_t equals = option.find('=');
    const std::string name = option.substr(0, equals);
    const Setting setting{option, equals == std::string::npos ? "" : option.substr(equals + 1), specimen, view};
    const std::size_t which = setting.one_of(name, names);
    if (setting.value.empty()) throw setting.wrong("must be what=value, for example labels=on");
    known_settings()[which].apply(setting);
  }
}

Camera camera_of(const std::string& view, const anatomy::Specimen& specimen, const ViewBox& box, float aspect) {
  if (const auto camera = standard_view(view, specimen.side != "right", box, aspect)) return *camera;
  const std::vector<std::string> angles = split(view, ',');
  constexpr double kWrong = 1e9;
  const double azimuth_deg = number_or(angles[0], kWrong);
  const double elevation_deg = number_or(angles.size() == 2 ? angles[1] : "", kWrong);
  if (!(std::abs(azimuth_deg) <= 360.0) || !(std::abs(elevation_deg) <= 90.0)) {
    static const std::vector<std::string> kViews = {"lateral", "medial", "cranial", "caudal", "dorsal", "palmar"};
    throw Error(ExitStatus::Usage,
                fmt::format("--view {}: must be one of {} (nearest: {}), or azimuth,elevation in degrees, -360 .. 360 "
                            "and -90 .. 90, for example 90,15",
                            view, join(kViews), nearest_word(view, kViews)));
  }
  constexpr double kRadians = std::numbers::pi / 180.0;
  Camera camera;
  camera.orbit(static_cast<float>(azimuth_deg * kRadians), static_cast<float>(elevation_deg * kRadians));
  return framed(camera, box, aspect);
}

PictureSize picture_size_of(const std::string& text) {
  const std::vector<std::string> sides = split(text, 'x');
  const double width = number_or(sides[0], 0.0), height = number_or(sides.size() == 2 ? sides[1] : "", 0.0);
  const auto fits = [](double px) { return px >= kSmallest_px && px <= kLargest_px && px == static_cast<int>(px); };
  if (!fits(width) || !fits(height)) {
    throw Error(ExitStatus::Usage, fmt::format("--size {}: must be width x height in pixels, {} .. {}, for example "
                                               "1280x720",
                                               text, kSmallest_px, kLargest_px));
  }
  return {static_cast<int>(width), static_cast<int>(height)};
}

}  // namespace myotact::view

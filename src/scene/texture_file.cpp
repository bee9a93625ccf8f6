#include "scene/texture_file.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/data_folder.h"
#include "core/error.h"
#include "core/text.h"
#include "haptics/effects/autoregression.h"

namespace myotact::scene {

namespace {

using haptics::VibrationGrid;
using haptics::VibrationNode;

const std::vector<std::string> kTissues = {"muscle", "tendon", "fascia", "bone", "fat", "skin"};  // as messages::Tissue
constexpr std::size_t kMostWaves = 16, kMostNodesAnAxis = 16;
/// A coefficient nearer to 1 is a resonance below 0.02 Hz, or a slip.
constexpr double kLargestReflection = 0.9999;
constexpr double kMostAboveCap = 0.05;

std::filesystem::path textures_folder() {
  return data_folder() / "assets" / "textures";
}

void read_relief(const JsonValue& value, haptics::TextureSet& set) {
  JsonObject fields(value);
  fields.find("why");
  const JsonValue waves = fields.at("waves");
  for (const JsonValue& element : waves.elements()) {
    JsonObject wave(element);
    wave.find("why");
    set.relief.push_back({wave.at("wavelength_m").number_between(3e-4, 0.05),
                          wave.at("angle_rad").number_between(-6.3, 6.3), wave.at("height_m").number_between(0.0, 5e-4),
                          wave.number_or("phase_rad", 0.0)});
    wave.finish();
  }
  if (set.relief.size() > kMostWaves) throw waves.error(fmt::format("has more than {} waves", kMostWaves));
  fields.finish();
}

std::vector<double> read_axis(const JsonValue& value, double highest) {
  std::vector<double> axis;
  for (const JsonValue& element : value.elements()) {
    axis.push_back(element.number_between(1e-4, highest));
    if (axis.size() > 1 && !(axis.back() > axis[axis.size() - 2]))
      throw element.error("must be above the one before it");
  }
  if (axis.empty() || axis.size() > kMostNodesAnAxis) {
    throw value.error(fmt::format("has {} values; must have 1 to {}", axis.size(), kMostNodesAnAxis));
  }
  return axis;
}

VibrationNode read_node(const JsonValue& value, int& order) {
  JsonObject fields(value);
  fields.find("why");
  VibrationNode node;
  node.rms_N = fields.at("rms_N").number_between(0.0, haptics::kTextureCap_N);
  const JsonValue list = fields.at("reflection");
  const std::vector<JsonValue> coefficients = list.elements();
  fields.finish();
  const auto count = static_cast<int>(coefficients.size());
  if (count > VibrationNode::kMaxOrder) {
    throw list.error(fmt::format("has {} coefficients; must have at most {}", count, VibrationNode::kMaxOrder));
  }
  if (order >= 0 && count != order) {
    throw list.error(fmt::format("has {} coefficients, the nodes before it {}; all must have as many", count, order));
  }
  order = count;
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    node.reflection[i] = coefficients[i].number_between(-kLargestReflection, kLargestReflection);
  }
  const double above = haptics::power_above(std::span(node.reflection.data(), coefficients.size()),
                                            haptics::kTextureCap_Hz, haptics::kTextureRate_Hz);
  if (above > kMostAboveCap) {
    throw list.error(
        fmt::format("{:.0f} % of the power lie above {} Hz, at most {} % may: a loop of 1 kHz does not render "
                    "it; fit it again with tools/fit-texture, which takes it out",
                    100.0 * above, to_text(haptics::kTextureCap_Hz), to_text(100.0 * kMostAboveCap)));
  }
  return node;
}

void read_vibration(const JsonValue& value, haptics::TextureSet& set) {
  JsonObject fields(value);
  fields.find("why");
  fields.at("rate_Hz").number_between(haptics::kTextureRate_Hz, haptics::kTextureRate_Hz);
  VibrationGrid& grid = set.vibration;
  grid.force_N = read_axis(fields.at("force_N"), 100.0);
  grid.speed_m_s = read_axis(fields.at("speed_m_s"), 10.0);
  int order = -1;
  for (const JsonValue& row : fields.at("nodes").elements(grid.force_N.size())) {
    for (const JsonValue& node : row.elements(grid.speed_m_s.size())) grid.nodes.push_back(read_node(node, order));
  }
  grid.order = order;
  fields.finish();
}

void read_knock(const JsonValue& value, haptics::TextureSet& set) {
  JsonObject fields(value);
  fields.find("why");
  set.knock.frequency_Hz = fields.at("frequency_Hz").number_between(1.0, haptics::kTextureCap_Hz);
  set.knock.decay_s = fields.at("decay_s").number_between(1e-3, 0.2);
  set.knock.gain_Ns_m = fields.at("gain_Ns_m").number_between(0.0, 20.0);
  fields.finish();
}

std::vector<std::string> known_textures() {
  std::vector<std::string> names;
  std::error_code missing;
  for (const auto& entry : std::filesystem::directory_iterator(textures_folder(), missing)) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

TextureFile read_texture(const std::filesystem::path& path) {
  const nlohmann::json json = read_json(path);
  JsonObject root(JsonValue(json, path.string()));
  root.at("schema").integer_between(1, 1);
  TextureFile file;
  const std::string tissue = root.at("tissue").one_of(kTissues);
  file.tissue = static_cast<messages::Tissue>(std::find(kTissues.begin(), kTissues.end(), tissue) - kTissues.begin());
  root.find("note");
  if (const auto relief = root.find("relief")) read_relief(*relief, file.set);
  if (const auto vibration = root.find("vibration")) read_vibration(*vibration, file.set);
  if (const auto knock = root.find("knock")) read_knock(*knock, file.set);
  root.finish();
  return file;
}

haptics::TextureSettings own_textures() {
  haptics::TextureSettings settings;
  for (const std::string& name : known_textures()) {
    TextureFile file = read_texture(textures_folder() / (name + ".json"));
    settings.by_tissue[static_cast<std::size_t>(file.tissue)] = std::move(file.set);
  }
  return settings;
}

haptics::TextureSettings textures_asked_for(const JsonValue& value) {
  if (value.raw().is_boolean()) return value.boolean() ? own_textures() : haptics::TextureSettings{};
  if (!value.raw().is_string()) throw value.error("must be true, false, or the name or path of a texture");
  const std::string name = value.string();
  const std::vector<std::string> known = known_textures();
  std::filesystem::path path = textures_folder() / (name + ".json");
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    path = std::filesystem::path(value.file()).parent_path() / name;
    std::error_code failure;
    if (!std::filesystem::is_regular_file(path, failure)) {
      throw value.error(fmt::format("\"{}\" is no texture and no file; known: {} (nearest: \"{}\")", name, join(known),
                                    nearest_word(name, known)));
    }
  }
  haptics::TextureSettings settings;
  settings.by_tissue.fill(read_texture(path).set);
  return settings;
}

}  // namespace myotact::scene

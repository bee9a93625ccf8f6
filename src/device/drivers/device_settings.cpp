#include "device/drivers/device_settings.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/file.h"
#include "core/json_reader.h"
#include "core/text.h"
#include "core/user_folder.h"
#include "device/drivers/driver_table.h"

namespace myotact::device {

namespace {

constexpr int kSchema = 1;
constexpr std::array kSections = {"falcon", "force_dimension", "inverse3", "placement", "spacemouse", "touch"};

/// A vector whose numbers are within the limit, so that no invalid rotation or place reaches the loop.
Vec3 vector_within(const JsonValue& value, double limit) {
  const Vec3 vector = value.vec3();
  if (vector.cwiseAbs().maxCoeff() <= limit) return vector;
  throw value.error(fmt::format("must be three numbers between {} and {}", -limit, limit));
}

void read_falcon(const JsonValue& value, falcon::FalconSettings& settings) {
  JsonObject fields(value);
  settings.firmware = fields.string_or("firmware", settings.firmware.string());
  if (const auto scale = fields.find("counts_per_Nm")) {
    settings.exchange.counts_per_Nm = scale->number_between(kLowestFalconScale, kHighestFalconScale);
  }
  if (const auto peak = fields.find("peak_force_N")) {
    settings.exchange.peak_force_N = peak->number_between(0.1, 10.0);  // makers' and users' figures are below
  }
  fields.finish();
}

void read_force_dimension(const JsonValue& value, force_dimension::ForceDimensionSettings& settings) {
  JsonObject fields(value);
  settings.library = fields.string_or("library", settings.library);
  settings.gravity_compensation = fields.boolean_or("gravity_compensation", settings.gravity_compensation);
  settings.initialises_itself = fields.boolean_or("initialises_itself", settings.initialises_itself);
  fields.finish();
}

void read_inverse(const JsonValue& value, inverse::InverseSettings& settings) {
  JsonObject fields(value);
  if (const auto port = fields.find("port")) {
    settings.port = static_cast<std::uint16_t>(port->integer_between(1, 65535));
  }
  if (const auto port = fields.find("version_port")) {
    settings.version_port = static_cast<std::uint16_t>(port->integer_between(1, 65535));
  }
  if (const auto form = fields.find("force_key")) {
    const std::string key = form->one_of({"by_version", "values", "vector"});
    settings.form = key == "values"   ? inverse::CommandForm::Values
                    : key == "vector" ? inverse::CommandForm::Vector
                                      : inverse::CommandForm::ByVersion;
  }
  if (const auto middle = fields.find("workspace_middle_m")) {
    constexpr double kFarthest_m = 0.5;  // its arm is shorter
    settings.workspace_middle_service_m = vector_within(*middle, kFarthest_m);
  }
  if (const auto peak = fields.find("peak_force_N")) {
    settings.profile.peak_force_N = peak->number_between(0.1, 20.0);
    settings.profile.continuous_force_N = std::min(settings.profile.continuous_force_N, settings.profile.peak_force_N);
  }
  fields.finish();
}

void read_spacemouse(const JsonValue& value, spacemouse::MotionSettings& settings) {
  JsonObject fields(value);
  if (const auto mode = fields.find("mode")) {
    settings.mode =
        mode->one_of({"rate", "position"}) == "rate" ? spacemouse::MotionMode::Rate : spacemouse::MotionMode::Position;
  }
  if (const auto zone = fields.find("dead_zone")) settings.dead_zone = zone->number_between(0.0, 0.9);
  if (const auto speed = fields.find("full_speed_m_s")) settings.full_speed_m_s = speed->number_between(0.001, 0.5);
  if (const auto offset = fields.find("full_offset_m")) settings.full_offset_m = offset->number_between(0.001, 0.5);
  if (const auto reach = fields.find("half_workspace_m")) settings.half_workspace_m = reach->number_between(0.01, 1.0);
  if (const auto signs = fields.find("axis_signs")) {
    settings.axis_signs = signs->vec3();
    if (settings.axis_signs.cwiseAbs() != Vec3::Ones()) throw signs->error("must be three of 1 and -1");
  }
  fields.finish();
}

void read_touch(const JsonValue& value, touch::TouchSettings& settings) {
  JsonObject fields(value);
  settings.library = fields.string_or("library", settings.library);
  if (const auto names = fields.find("configurations")) {
    settings.configurations = names->strings();
    if (settings.configurations.empty()) throw names->error("must name one device at least; \"\" is the default one");
  }
  if (const auto stiffness = fields.find("max_stiffness_N_m")) {
    settings.max_stiffness_N_m = stiffness->number_between(10.0, 5000.0);
  }
  fields.finish();
}

TablePlacement read_placement(const JsonValue& value) {
  JsonObject fields(value);
  TablePlacement placement;
  if (const auto turn = fields.find("turn_deg")) placement.turn_deg = vector_within(*turn, 360.0);
  if (const auto scale = fields.find("scale")) placement.scale = scale->number_between(0.05, 20.0);
  if (const auto bubble = fields.find("bubble_m")) placement.bubble_radius_m = bubble->number_between(0.0, 1.0);
  fields.finish();
  return placement;
}

/// A file whose status cannot be read counts as there: reading it reports why.
bool is_there(const std::filesystem::path& file) {
  std::error_code problem;
  return !file.empty() && std::filesystem::status(file, problem).type() != std::filesystem::file_type::not_found;
}

nlohmann::json settings_json(const std::filesystem::path& file) {
  if (!is_there(file)) return {{"schema", kSchema}};
  nlohmann::json json = read_json(file);
  if (!json.is_object()) throw bad_data(file.string(), "/", "must be an object in braces");
  return json;
}

DeviceSettings settings_of(const nlohmann::json& json, const std::filesystem::path& file) {
  JsonObject root(JsonValue(json, file.string()));
  root.at("schema").integer_between(kSchema, kSchema);
  DeviceSettings settings;
  if (const auto falcon = root.find("falcon")) read_falcon(*falcon, settings.falcon);
  if (const auto dhd = root.find("force_dimension")) read_force_dimension(*dhd, settings.force_dimension);
  if (const auto inverse = root.find("inverse3")) read_inverse(*inverse, settings.inverse);
  if (const auto spacemouse = root.find("spacemouse")) read_spacemouse(*spacemouse, settings.spacemouse);
  if (const auto touch = root.find("touch")) read_touch(*touch, settings.touch);
  if (const auto placements = root.find("placement")) {
    for (const auto& [name, value] : JsonObject(*placements).entries()) {
      if (!is_on_the_table(name)) {
        throw value.error(
            fmt::format("is no device; must be one of {}, or the second of its kind as touch:2 (nearest: {})",
                        join(driver_names()), nearest_word(name, driver_names())));
      }
      settings.placements[name] = read_placement(value);
    }
  }
  root.finish();
  return settings;
}

}  // namespace

std::filesystem::path device_settings_file() {
  const std::filesystem::path own = user_config_folder();
  return own.empty() ? own : own / "devices.json";
}

bool is_device_setting(const std::string& key) {
  return std::any_of(kSections.begin(), kSections.end(),
                     [&](const char* section) { return key.starts_with(std::string(section) + "."); });
}

DeviceSettings read_device_settings(const std::filesystem::path& file, const Overrides& overrides) {
  nlohmann::json json = settings_json(file);
  settings_of(json, file);  // before anything is put over it: an error is the file's own
  override_values(json, overrides);
  return settings_of(json, "--set");
}

void keep_device_settings(const std::filesystem::path& file, const Overrides& values) {
  if (file.empty()) {
    throw Error(ExitStatus::InputOutput, "there is no folder for your settings: set HOME or XDG_CONFIG_HOME to one");
  }
  nlohmann::json json = settings_json(file);
  override_values(json, values);
  settings_of(json, file);
  make_writable_folder(file.parent_path());
  write_file(file, json.dump(2) + "\n");
}

}  // namespace myotact::device

#include "scene/recording_header.h"

#include <array>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/json_reader.h"

namespace myotact::scene {

namespace {

/// 1 knew one tool: "device" in place of "devices"; 2 did not know that a person chooses tools.
constexpr int kSchema = 3;

/// Keys of a device's profile in the header.
struct ProfileKey {
  const char* name;
  double device::DeviceProfile::*value;
};
constexpr std::array<ProfileKey, 7> kProfileKeys = {{
    {"peak_force_N", &device::DeviceProfile::peak_force_N},
    {"continuous_force_N", &device::DeviceProfile::continuous_force_N},
    {"max_stiffness_N_m", &device::DeviceProfile::max_stiffness_N_m},
    {"inertia_kg", &device::DeviceProfile::inertia_kg},
    {"viscous_Ns_m", &device::DeviceProfile::viscous_Ns_m},
    {"coulomb_N", &device::DeviceProfile::coulomb_N},
    {"resolution_m", &device::DeviceProfile::resolution_m},
}};
constexpr double kMostOfAll = 1e6;  // of any of them: no device of this world

nlohmann::json json_of(const device::DeviceProfile& profile) {
  nlohmann::json device = {{"delay_ticks", profile.delay_ticks}, {"shows_force_only", profile.shows_force_only}};
  for (const ProfileKey& key : kProfileKeys) device[key.name] = profile.*key.value;
  if (profile.motion_scale != 1.0) device["motion_scale"] = profile.motion_scale;
  return device;
}

device::DeviceProfile read_profile(const JsonValue& value) {
  device::DeviceProfile profile;
  JsonObject numbers(value);
  for (const ProfileKey& key : kProfileKeys) profile.*key.value = numbers.at(key.name).number_between(0.0, kMostOfAll);
  if (const auto scale = numbers.find("motion_scale")) profile.motion_scale = scale->number_between(0.01, 100.0);
  profile.delay_ticks = numbers.at("delay_ticks").integer_between(0, 1000);
  profile.shows_force_only = numbers.at("shows_force_only").boolean();
  numbers.finish();
  return profile;
}

void require_known_version(const JsonValue& schema) {
  if (schema.raw().is_number_integer() && schema.raw().get<std::int64_t>() > kSchema) {
    throw schema.error(
        fmt::format("the recording is of version {}, later than this program, which reads 1 to {}; use "
                    "the program that recorded it",
                    schema.raw().get<std::int64_t>(), kSchema));
  }
  schema.integer_between(1, kSchema);
}

}  // namespace

std::string recording_header(const Scene& scene, std::uint64_t seed,
                             const std::vector<device::DeviceProfile>& profiles) {
  nlohmann::json devices = nlohmann::json::array();
  for (const device::DeviceProfile& profile : profiles) devices.push_back(json_of(profile));
  const nlohmann::json header = {{"schema", kSchema},
                                 {"seed", seed},
                                 {"devices", devices},
                                 {"specimen", std::filesystem::absolute(scene.specimen_folder).string()},
                                 {"scene", scene.source_text}};
  return header.dump();
}

std::vector<device::DeviceProfile> devices_of_recording(const nlohmann::json& header,
                                                        const std::filesystem::path& file) {
  std::vector<device::DeviceProfile> profiles;
  JsonObject fields(JsonValue(header, file.string()));
  if (const auto device = fields.find("device")) profiles.push_back(read_profile(*device));
  if (const auto devices = fields.find("devices")) {
    for (const JsonValue& device : devices->elements()) profiles.push_back(read_profile(device));
  }
  if (profiles.empty()) profiles.emplace_back();
  return profiles;
}

Scene scene_of_recording(const nlohmann::json& header, const std::filesystem::path& file, const Overrides& overrides) {
  JsonObject fields(JsonValue(header, file.string()));
  require_known_version(fields.at("schema"));
  const JsonValue seed = fields.at("seed");
  if (!seed.raw().is_number_unsigned()) throw seed.error("must be a whole number of at least 0");
  fields.find("device");  // devices_of_recording
  fields.find("devices");
  Overrides all = {{"specimen", fields.at("specimen").string()}};
  for (const auto& [key, value] : overrides) all[key] = value;
  const std::string text = fields.at("scene").string();
  fields.finish();
  Scene scene = parse_scene(text, file, all);
  set_seed(scene, seed.raw().get<std::uint64_t>());
  return scene;
}

void require_fit(const Recording& recording, const Scene& scene, const std::filesystem::path& file) {
  const std::size_t muscle_count = scene.specimen.muscles.size(), joint_count = scene.specimen.joints.size();
  for (std::size_t i = 0; i < recording.steps.size(); ++i) {
    const StepRecord& step = recording.steps[i];
    const std::string place = fmt::format("step {}", i);
    if (step.excitations.size() != muscle_count || step.joint_torques_Nm.size() != joint_count) {
      throw bad_data(
          file.string(), place,
          fmt::format("is for {} muscles and {} joints; the specimen has {} and {}. Name the specimen of the "
                      "recording with --set specimen=FOLDER",
                      step.excitations.size(), step.joint_torques_Nm.size(), muscle_count, joint_count));
    }
    if (!step.gravity_m_s2.allFinite()) {
      throw bad_data(
          file.string(), place,
          fmt::format("has a gravity of {} {} {} m/s2; all must be finite. The file is damaged: record it again",
                      step.gravity_m_s2.x(), step.gravity_m_s2.y(), step.gravity_m_s2.z()));
    }
    if (step.tools.size() != scene.tools.size()) {
      throw bad_data(file.string(), place,
                     fmt::format("is of {} tools; the scene has {}", step.tools.size(), scene.tools.size()));
    }
  }
  if (recording.tools.size() > scene.tools.size()) {
    throw bad_data(file.string(), "ticks",
                   fmt::format("are of {} tools; the scene has {}", recording.tools.size(), scene.tools.size()));
  }
}

}  // namespace myotact::scene

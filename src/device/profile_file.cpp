#include "device/profile_file.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/data_folder.h"
#include "core/error.h"
#include "core/json_reader.h"
#include "core/text.h"

namespace myotact::device {

namespace {

struct ProfileKey {
  const char* name;
  double lowest, highest;
  double DeviceProfile::*value;
};
constexpr std::array kKeys = {ProfileKey{"peak_force_N", 0.1, 100.0, &DeviceProfile::peak_force_N},
                              ProfileKey{"continuous_force_N", 0.05, 100.0, &DeviceProfile::continuous_force_N},
                              ProfileKey{"max_stiffness_N_m", 1.0, 1e5, &DeviceProfile::max_stiffness_N_m},
                              ProfileKey{"inertia_kg", 1e-3, 10.0, &DeviceProfile::inertia_kg},
                              ProfileKey{"viscous_Ns_m", 0.0, 100.0, &DeviceProfile::viscous_Ns_m},
                              ProfileKey{"coulomb_N", 0.0, 5.0, &DeviceProfile::coulomb_N},
                              ProfileKey{"resolution_m", 0.0, 5e-3, &DeviceProfile::resolution_m}};
constexpr double kSmallestEdge_m = 0.01, kLargestEdge_m = 2.0;  // of a workspace
constexpr int kLongestDelay_ticks = 7;                          // SimulatedDevice keeps eight commands

std::filesystem::path profiles_folder() {
  return data_folder() / "assets" / "devices";
}

/// The value of {"value", "source"}; a quantity without a source is refused.
JsonValue sourced(JsonObject& fields) {
  if (fields.at("source").string().empty()) throw fields.at("source").error("must say where the value is from");
  const JsonValue value = fields.at("value");
  fields.finish();
  return value;
}

std::filesystem::path path_of(const std::string& name_or_path) {
  const std::vector<std::string> known = built_in_profiles();
  if (std::find(known.begin(), known.end(), name_or_path) != known.end())
    return profiles_folder() / (name_or_path + ".json");
  if (std::filesystem::exists(name_or_path)) return name_or_path;
  throw Error(ExitStatus::NoInput,
              fmt::format("there is no device profile \"{}\", neither in {} nor as a file; known: {} (nearest: {})",
                          name_or_path, profiles_folder().string(), join(known), nearest_word(name_or_path, known)));
}

}  // namespace

std::vector<std::string> built_in_profiles() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(profiles_folder()))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

DeviceProfile simulated_profile(const std::string& device) {
  const std::size_t colon = device.find(':');
  return colon == std::string::npos ? DeviceProfile{} : load_profile(device.substr(colon + 1)).profile;
}

NamedProfile load_profile(const std::string& name_or_path) {
  const std::filesystem::path path = path_of(name_or_path);
  const nlohmann::json json = read_json(path);
  JsonObject fields(JsonValue(json, path.string()));
  fields.at("schema").integer_between(1, 1);
  NamedProfile named{path.stem().string(), fields.at("title").string(), {}};
  for (const ProfileKey& key : kKeys) {
    JsonObject quantity(fields.at(key.name));
    named.profile.*key.value = sourced(quantity).number_between(key.lowest, key.highest);
  }
  JsonObject delay(fields.at("delay_ticks"));
  named.profile.delay_ticks = sourced(delay).integer_between(0, kLongestDelay_ticks);
  JsonObject workspace(fields.at("workspace_m"));
  const std::vector<JsonValue> edges = sourced(workspace).elements(named.profile.workspace_m.size());
  for (std::size_t k = 0; k < edges.size(); ++k)
    named.profile.workspace_m[k] = edges[k].number_between(kSmallestEdge_m, kLargestEdge_m);
  fields.finish();
  if (named.profile.continuous_force_N > named.profile.peak_force_N) {
    throw bad_data(path.string(), "/continuous_force_N/value",
                   fmt::format("is {}; must be in 0.05 .. {}, the peak force", named.profile.continuous_force_N,
                               named.profile.peak_force_N));
  }
  return named;
}

}  // namespace myotact::device

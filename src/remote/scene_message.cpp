#include "remote/scene_message.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/file.h"
#include "core/json_reader.h"
#include "net/wire.h"

namespace myotact::remote {

namespace {

constexpr const char* kWhere = "the server's scene";

template <typename Parts>
nlohmann::json keys_of(const Parts& parts) {
  nlohmann::json keys = nlohmann::json::array();
  for (const auto& part : parts) keys.push_back(part.key);
  return keys;
}

/// The description names the hash of every other file.
std::string hash_of(const scene::Scene& scene) {
  const std::filesystem::path description = scene.specimen_folder / "specimen.json";
  std::error_code failure;
  if (scene.specimen_folder.empty() || !std::filesystem::exists(description, failure)) return "";
  return sha256(read_file(description));
}

}  // namespace

std::string scene_message(const scene::Scene& scene, std::uint64_t seed) {
  nlohmann::json tools = nlohmann::json::array();
  for (const scene::ToolSettings& tool : scene.tools)
    tools.push_back({{"hand", tool.hand}, {"radius_m", tool.radius_m}});
  const nlohmann::json body = {{"name", scene.name},
                               {"title", scene.title},
                               {"seed", seed},
                               {"text", scene.source_text},
                               {"specimen", {{"name", scene.specimen.name}, {"sha256", hash_of(scene)}}},
                               {"muscles", keys_of(scene.specimen.muscles)},
                               {"bones", keys_of(scene.specimen.bones)},
                               {"bodies", keys_of(scene.specimen.bodies)},
                               {"joints", keys_of(scene.specimen.joints)},
                               {"tools", tools}};
  std::string message = nlohmann::json{{"scene", body}}.dump();
  if (message.size() > net::kMostControl) {
    throw Error(ExitStatus::BadData,
                fmt::format("{}: the description of the scene for clients is {} bytes; at most {}; shorten its file",
                            scene.name, message.size(), net::kMostControl));
  }
  return message;
}

scene::Scene scene_of_message(const std::string& message) {
  const nlohmann::json json = parse_json(message, kWhere);
  JsonObject outer(JsonValue(json, kWhere));
  JsonObject fields(outer.at("scene"));
  const JsonValue seed = fields.at("seed");
  if (!seed.raw().is_number_unsigned()) throw seed.error("must be a whole number of at least 0");
  JsonObject specimen(fields.at("specimen"));
  const std::string name = specimen.at("name").string(), hash = specimen.at("sha256").string();
  scene::Scene scene = scene::parse_scene(fields.at("text").string(), kWhere, {});
  if (const std::string own = hash_of(scene); own != hash) {
    throw Error(ExitStatus::BadData,
                fmt::format("{}: the specimen \"{}\" of this machine ({}) is another than the server's: SHA-256 of "
                            "specimen.json {} here, {} there; copy the server's folder",
                            kWhere, name, scene.specimen_folder.string(), own, hash));
  }
  scene::set_seed(scene, seed.raw().get<std::uint64_t>());
  return scene;
}

}  // namespace myotact::remote

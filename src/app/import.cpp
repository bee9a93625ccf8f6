#include <iostream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include "app/options.h"
#include "core/error.h"
#include "core/text.h"
#include "exchange/opensim.h"

namespace myotact::app {

namespace {

using Json = nlohmann::ordered_json;
using exchange::opensim::Import;

constexpr const char* kSceneFile = "scene.json";
constexpr double kDegrees = 57.29577951308232;

Json json_of(const Import& import, const std::filesystem::path& folder) {
  const anatomy::Specimen& specimen = import.specimen;
  Json json = {{"specimen", folder.string()},       {"scene", (folder / kSceneFile).string()},
               {"scene_joint", import.scene_joint}, {"bodies", specimen.bodies.size()},
               {"joints", specimen.joints.size()},  {"muscles", specimen.muscles.size()},
               {"bones", specimen.bones.size()},    {"coordinates", Json::array()},
               {"not_taken", Json::array()}};
  for (const auto& c : import.coordinates) {
    json["coordinates"].push_back({{"coordinate", c.coordinate},
                                   {"joint", c.joint},
                                   {"axis", c.axis},
                                   {"factor", c.factor},
                                   {"file_pose_rad", c.file_pose},
                                   {"default_rad", c.default_rad},
                                   {"range_rad", Json::array({c.range_rad.first, c.range_rad.second})}});
  }
  for (const auto& n : import.not_taken) {
    json["not_taken"].push_back(
        {{"element", n.element}, {"objects", n.objects}, {"place", n.place}, {"reason", n.reason}, {"count", n.count}});
  }
  return json;
}

/// "a, b, c and 5 more".
std::string few_of(const std::vector<std::string>& names) {
  constexpr std::size_t kFew = 4;
  if (names.size() <= kFew) return join(names);
  const std::vector<std::string> first(names.begin(), names.begin() + kFew);
  return fmt::format("{} and {} more", join(first), names.size() - kFew);
}

std::string table_of(const Import& import) {
  const anatomy::Specimen& specimen = import.specimen;
  std::string text = fmt::format("taken: {} bodies, {} joints, {} muscles, {} bones\n\n", specimen.bodies.size(),
                                 specimen.joints.size(), specimen.muscles.size(), specimen.bones.size());
  text +=
      fmt::format("{:<28} {:<24} {:>10} {:>18}  {}\n", "coordinate", "joint", "q = 0 at", "range [degrees]", "sense");
  for (const auto& c : import.coordinates) {
    const std::string joint = c.axis == 0 ? c.joint : fmt::format("{}.{}", c.joint, c.axis + 1);
    const std::string range =
        fmt::format("{:.1f} .. {:.1f}", kDegrees * c.range_rad.first, kDegrees * c.range_rad.second);
    const std::string sense = c.factor == 1.0    ? ""
                              : c.factor == -1.0 ? "turned, so that q > 0 flexes"
                                                 : fmt::format("q is {} times it", to_text(c.factor));
    text +=
        fmt::format("{:<28} {:<24} {:>10.1f} {:>18}  {}\n", c.coordinate, joint, kDegrees * c.file_pose, range, sense);
  }
  text += import.not_taken.empty() ? "\neverything in the model was taken\n" : "\nnot taken, or taken otherwise:\n";
  for (const auto& n : import.not_taken) {
    text += fmt::format("  {} of {} ({}{}){}\n", n.element, few_of(n.objects), n.place,
                        n.count > 1 ? fmt::format(" and {} more", n.count - 1) : "",
                        n.reason.empty() ? "" : ": " + n.reason);
  }
  return text;
}

}  // namespace

int import_model(const Options& options) {
  const Import import = exchange::opensim::read_model(options.file);
  anatomy::save_specimen(import.specimen, options.out, {{kSceneFile, import.scene_json}});
  std::cout << (options.json ? json_of(import, options.out).dump(1) + "\n" : table_of(import)) << std::flush;
  const std::string scene = (options.out / kSceneFile).string();
  if (import.scene_joint.empty()) {
    spdlog::info("{} is written; no joint has muscles on both sides, so its scene co-contracts nothing", scene);
  } else {
    spdlog::info("{} is written; next: myotact stiffness {}", scene, scene);
  }
  return static_cast<int>(ExitStatus::Done);
}

}  // namespace myotact::app

#include "app/class_page.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include "anatomy/part_facts.h"
#include "core/data_folder.h"
#include "core/error.h"
#include "core/file.h"
#include "core/json_reader.h"
#include "learn/lesson_file.h"
#include "learn/lesson_list.h"
#include "view/render/sky_exposure.h"
#include "view/ui/text.h"

namespace myotact::app {

namespace {

/// A whole picture of more would not fit into one frame, at 4 bytes a vertex.
constexpr std::size_t kMostVertices = 250'000;

void check_size(const anatomy::Specimen& specimen) {
  std::size_t vertices = 0;
  for (const anatomy::Muscle& muscle : specimen.muscles) vertices += muscle.skin.positions_m.size();
  if (vertices <= kMostVertices) return;
  throw Error(ExitStatus::BadData, fmt::format("{}: its skins have {} vertices; a class sees at most {}; simplify them",
                                               specimen.name, vertices, kMostVertices));
}

using Json = nlohmann::json;

constexpr const char* kJson = "application/json; charset=utf-8";

void add_page(net::WebFiles& files) {
  const std::filesystem::path folder = data_folder() / "web" / "dist";
  if (!std::filesystem::exists(folder / "index.html")) {
    throw Error(ExitStatus::NoInput,
                fmt::format("{}: the page for browsers has not been built; run tools/build_web.sh, which needs nodejs "
                            "and npm, or install the package, which brings it",
                            (folder / "index.html").string()));
  }
  const auto add = [&](const char* path, const char* name, const char* type) {
    files[path] = net::web_file(type, read_file(folder / name));
  };
  add("/", "index.html", "text/html; charset=utf-8");
  add("/app.js", "app.js", "text/javascript; charset=utf-8");
  add("/app.css", "app.css", "text/css; charset=utf-8");
  add("/licences.txt", "licences.txt", "text/plain; charset=utf-8");
}

const anatomy::MuscleGroup* group_at(const scene::Scene& scene) {
  for (const anatomy::MuscleGroup& group : scene.specimen.groups) {
    if (scene.co_contraction && group.joint == scene.co_contraction->joint) return &group;
  }
  return nullptr;
}

std::string side_of(const anatomy::MuscleGroup* group, std::size_t muscle) {
  const auto holds = [&](const std::vector<int>& muscles) {
    return std::find(muscles.begin(), muscles.end(), static_cast<int>(muscle)) != muscles.end();
  };
  if (group != nullptr && holds(group->flexors)) return "flexor";
  return group != nullptr && holds(group->extensors) ? "extensor" : "other";
}

bool is_simulated(const scene::Scene& scene, std::size_t muscle) {
  const auto& tissue = scene.settings.tissue;
  return tissue.empty() || tissue[muscle] == simulation::TissueModel::Fem ||
         tissue[muscle] == simulation::TissueModel::MassSpring;
}

Json muscles_json(const scene::Scene& scene, const anatomy::FactsByKey& facts, const view::LimbShade& shade) {
  const anatomy::MuscleGroup* group = group_at(scene);
  Json muscles = Json::array();
  for (std::size_t m = 0; m < scene.specimen.muscles.size(); ++m) {
    const anatomy::Muscle& muscle = scene.specimen.muscles[m];
    const anatomy::PartFacts& known = anatomy::facts_of(facts, muscle.key);
    muscles.push_back({{"key", muscle.key},
                       {"english", muscle.name_en},
                       {"latin", muscle.name_la},
                       {"synonyms", known.synonyms},
                       {"region", known.region},
                       {"layer", shade.superficial[m] ? "superficial" : "deep"},
                       {"group", side_of(group, m)},
                       {"function", known.function},
                       {"origin", known.origin},
                       {"insertion", known.insertion},
                       {"action", known.action},
                       {"innervation", known.innervation},
                       {"peak_force_N", muscle.peak_force_N},
                       {"optimal_fibre_m", muscle.optimal_fibre_m},
                       {"simulated", is_simulated(scene, m)}});
  }
  return muscles;
}

Json bones_json(const anatomy::Specimen& specimen, const anatomy::FactsByKey& facts) {
  Json bones = Json::array();
  for (const anatomy::Bone& bone : specimen.bones) {
    const anatomy::PartFacts& known = anatomy::facts_of(facts, bone.key);
    bones.push_back({{"key", bone.key},
                     {"english", bone.name_en},
                     {"latin", bone.name_la},
                     {"synonyms", known.synonyms},
                     {"region", known.region}});
  }
  return bones;
}

Json co_contraction_json(const scene::Scene& scene) {
  if (!scene.co_contraction) return nullptr;
  Json presets = Json::array();
  for (const scene::CoContractionPreset& preset : scene.co_contraction->presets) {
    presets.push_back({{"name", preset.name}, {"common", preset.common}, {"difference", preset.difference}});
  }
  const auto joint = static_cast<std::size_t>(scene.co_contraction->joint);
  return {{"joint", scene.specimen.joints[joint].key}, {"presets", presets}};
}

/// `version`: of page and program; a page that was opened before another one was served sees that by it.
std::string facts_json(const scene::Scene& scene, const view::LimbShade& shade, const std::string& version) {
  const anatomy::FactsByKey facts = anatomy::load_part_facts(data_folder() / "assets" / "canine" / "names.json");
  Json joints = Json::array();
  for (const anatomy::Joint& joint : scene.specimen.joints) joints.push_back({{"key", joint.key}});
  return Json{{"version", version},
              {"name", scene.name},
              {"title", scene.title},
              {"note", scene.note},
              {"muscles", muscles_json(scene, facts, shade)},
              {"bones", bones_json(scene.specimen, facts)},
              {"joints", joints},
              {"co_contraction", co_contraction_json(scene)}}
      .dump();
}

/// A byte a vertex, skins before bones: how much of the sky it sees past the others, 255 all.
std::string shade_bytes(const view::LimbShade& shade) {
  std::string bytes;
  for (const auto* parts : {&shade.muscles, &shade.bones}) {
    for (const view::LimbShade::Vertices& part : *parts) {
      for (const float seen : part.together) bytes.push_back(static_cast<char>(std::lround(255.0f * seen)));
    }
  }
  return bytes;
}

/// The lessons of this scene that can be used.
std::string lessons_json(const scene::Scene& scene) {
  Json lessons = Json::array();
  for (const learn::ListedLesson& listed : learn::list_lessons()) {
    if (!listed.complaint.empty() || listed.head.scene != scene.name) continue;
    try {
      learn::load_lesson(listed.path, scene.specimen);
      lessons.push_back(read_json(listed.path));
    } catch (const Error& broken) {
      spdlog::warn("{}; the class does not see this lesson", broken.what());
    }
  }
  return lessons.dump();
}

/// Without what only the window retells: half of all texts, which a whole class would load at once.
view::ui::Catalogue texts_of_page(const std::string& language) {
  view::ui::Catalogue texts = view::ui::load_catalogue(language);
  std::erase_if(texts,
                [](const auto& text) { return text.first.starts_with("said.") || text.first.starts_with("place."); });
  return texts;
}

}  // namespace

net::WebFiles class_page(const scene::Scene& scene) {
  check_size(scene.specimen);
  net::WebFiles files;
  add_page(files);
  const view::LimbShade shade = view::shade_limb(scene.specimen);
  files["/scene.json"] = net::web_file(kJson, facts_json(scene, shade, MYOTACT_VERSION + files["/app.js"].tag));
  files["/shade.bin"] = net::web_file("application/octet-stream", shade_bytes(shade));
  files["/lessons.json"] = net::web_file(kJson, lessons_json(scene));
  for (const std::string& language : view::ui::languages()) {
    files["/languages/" + language + ".json"] = net::web_file(kJson, Json(texts_of_page(language)).dump());
  }
  return files;
}

}  // namespace myotact::app

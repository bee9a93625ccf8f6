#include "app/export_elements.h"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include "app/export_play.h"
#include "core/error.h"
#include "core/file.h"
#include "core/json_reader.h"
#include "core/text.h"
#include "exchange/febio_limb.h"
#include "exchange/febio_write.h"

namespace myotact::app {

namespace {

void write_febio(const Options& options, const exchange::FebioText& febio) {
  write_file(options.file, febio.text);
  for (const std::string& note : febio.notes) spdlog::info("{}: {}", options.file.string(), note);
}

/// The muscles of --muscle.
std::vector<int> chosen_muscles(const Options& options, const anatomy::Specimen& specimen) {
  std::vector<int> muscles(specimen.muscles.size());
  std::iota(muscles.begin(), muscles.end(), 0);
  if (!options.muscle) return muscles;
  const int muscle = anatomy::find_muscle(specimen, *options.muscle);
  if (muscle >= 0) return {muscle};
  std::vector<std::string> keys;
  for (const anatomy::Muscle& one : specimen.muscles) keys.push_back(one.key);
  throw Error(ExitStatus::Usage, fmt::format("--muscle {}: the specimen has no such muscle (nearest: {})",
                                             *options.muscle, nearest_word(*options.muscle, keys)));
}

}  // namespace

bool is_case(const std::string& scene) {
  const std::filesystem::path file = scene;
  std::error_code ignored;
  if (lower(file.extension().string()) != ".json" || !std::filesystem::is_regular_file(file, ignored)) return false;
  const nlohmann::json json = read_json(file);
  return json.is_object() && json.contains("conditions") && json.contains("materials");
}

int export_case(const Options& options) {
  if (options.muscle) throw Error(ExitStatus::Usage, "--muscle: is of a scene, and a case has none; leave it out");
  const measure::SolveCase input = measure::load_case(options.scene);
  require_writable(options.file);
  write_febio(options, exchange::febio_text(input));
  spdlog::info("{} is written", options.file.string());
  return static_cast<int>(ExitStatus::Done);
}

void write_elements(const Options& options, const scene::Scene& scene) {
  const std::vector<int> muscles = chosen_muscles(options, scene.specimen);
  if (muscles.empty()) {
    throw Error(ExitStatus::Usage,
                fmt::format("--out {}: the scene has no muscle to be written", options.file.string()));
  }
  play(options, scene, {}, [&](const simulation::Simulation& simulation) {
    const exchange::FebioLimb limb = exchange::febio_limb(scene, simulation, muscles);
    write_febio(options, exchange::febio_text(limb.solve_case, limb.notes, limb.activations));
  });
}

}  // namespace myotact::app

#include "measure/stiffness_part.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/file.h"
#include "core/json_reader.h"
#include "core/text.h"

namespace myotact::measure {

namespace {

std::vector<double> read_numbers(const JsonValue& list, double lowest, double highest) {
  std::vector<double> numbers;
  for (const JsonValue& entry : list.elements()) numbers.push_back(entry.number_between(lowest, highest));
  if (numbers.empty()) throw list.error("is empty; a sweep has at least one cell");
  if (numbers.size() > 100'000) throw list.error("has more than 100000 entries");  // cells are counted in an int
  return numbers;
}

SweepOrigin read_origin(JsonObject& fields) {
  constexpr double kTurn_rad = 6.283185307179586;  // no joint goes farther
  SweepOrigin origin;
  origin.version = fields.at("version").string();
  origin.scene = fields.at("scene").string();
  origin.title = fields.at("title").string();
  origin.scene_hash = fields.at("scene_hash").string();
  origin.joint = fields.at("joint").string();
  origin.grid.angles_rad = read_numbers(fields.at("angles_rad"), -kTurn_rad, kTurn_rad);
  origin.grid.levels = read_numbers(fields.at("levels"), 0.0, 1.0);
  if (origin.grid.angles_rad.size() * origin.grid.levels.size() > 10'000'000) {
    throw fields.at("levels").error("makes more than ten million cells with angles_rad");
  }
  return origin;
}

/// The rows must be those of the part's cells: a file that was cut or edited is refused.
void require_cells(const SweepPart& part, const JsonValue& rows) {
  const CellRange cells = share_of_cells(part.origin.grid, part.part, part.parts);
  if (static_cast<int>(part.rows.size()) != cells.end - cells.first) {
    throw rows.error(
        fmt::format("holds {} rows; this part has {}: measure it again", part.rows.size(), cells.end - cells.first));
  }
  const std::size_t levels = part.origin.grid.levels.size();
  for (std::size_t i = 0; i < part.rows.size(); ++i) {
    const std::size_t cell = static_cast<std::size_t>(cells.first) + i;
    const StiffnessRow& row = part.rows[i];
    if (row.joint == part.origin.joint && row.q_rad == part.origin.grid.angles_rad[cell / levels] &&
        row.common == part.origin.grid.levels[cell % levels])
      continue;
    throw rows.error(fmt::format("row {} is not of the cell {} of the sweep: measure the part again", i, cell));
  }
}

std::string difference_text(const SweepOrigin& a, const SweepOrigin& b) {
  if (a.version != b.version) return fmt::format("of version {}, not {}", b.version, a.version);
  if (a.joint != b.joint) return fmt::format("of the joint {}, not {}", b.joint, a.joint);
  if (a.scene != b.scene) return fmt::format("of the scene {}, not {}", b.scene, a.scene);
  if (a.scene_hash != b.scene_hash) return fmt::format("of another state of the scene {} or its specimen", b.scene);
  return "with other angles or levels";
}

}  // namespace

SweepOrigin sweep_origin(const scene::Scene& scene, const SweepGrid& grid, const std::string& version) {
  const auto joint = static_cast<std::size_t>(scene.co_contraction->joint);
  const std::string specimen = read_file(scene.specimen_folder / "specimen.json");
  return {version,
          scene.name,
          scene.title,
          sha256(sha256(scene.source_text) + sha256(specimen)),
          scene.specimen.joints[joint].key,
          grid};
}

std::string part_file_name(int part, int parts) {
  return fmt::format("stiffness_part_{}_of_{}.json", part, parts);
}

std::string part_json(const SweepPart& part) {
  const SweepOrigin& origin = part.origin;
  const nlohmann::json file = {{"schema", 1},
                               {"version", origin.version},
                               {"scene", origin.scene},
                               {"title", origin.title},
                               {"scene_hash", origin.scene_hash},
                               {"joint", origin.joint},
                               {"angles_rad", origin.grid.angles_rad},
                               {"levels", origin.grid.levels},
                               {"part", part.part},
                               {"parts", part.parts},
                               {"rows", stiffness_json(part.rows)}};
  return file.dump(2) + "\n";
}

SweepPart read_part(const std::filesystem::path& file) {
  const nlohmann::json json = read_json(file);
  JsonObject fields(JsonValue(json, file.string()));
  fields.at("schema").integer_between(1, 1);
  SweepPart part;
  part.origin = read_origin(fields);
  part.parts = fields.at("parts").integer_between(1, kMostParts);
  part.part = fields.at("part").integer_between(1, part.parts);
  const JsonValue rows = fields.at("rows");
  part.rows = read_stiffness_rows(rows);
  fields.finish();
  require_cells(part, rows);
  return part;
}

SweepPart merge_parts(const std::vector<std::filesystem::path>& files) {
  if (files.empty()) throw Error(ExitStatus::Usage, "--merge: name the files of all parts");
  std::vector<std::optional<SweepPart>> parts;
  std::vector<std::string> names;
  for (const auto& file : files) {
    SweepPart part = read_part(file);
    if (parts.empty()) {
      parts.resize(static_cast<std::size_t>(part.parts));
      names.resize(parts.size());
    }
    const std::string name = file.string();
    if (static_cast<std::size_t>(part.parts) != parts.size()) {
      throw bad_data(name, "/parts",
                     fmt::format("is {}; {} is one of {} parts", part.parts, files[0].string(), parts.size()));
    }
    const auto place = static_cast<std::size_t>(part.part - 1);
    if (parts[place]) {
      throw bad_data(name, "/part",
                     fmt::format("is {}, which {} holds already; name each part once", part.part, names[place]));
    }
    const auto first = std::find_if(parts.begin(), parts.end(), [](const auto& p) { return p.has_value(); });
    if (first != parts.end() && !((*first)->origin == part.origin)) {
      throw bad_data(name, "/",
                     fmt::format("is a part of another sweep than {}: {}", files[0].string(),
                                 difference_text((*first)->origin, part.origin)));
    }
    names[place] = name;
    parts[place] = std::move(part);
  }
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!parts[i]) missing.push_back(part_file_name(static_cast<int>(i) + 1, static_cast<int>(parts.size())));
  }
  if (!missing.empty()) {
    throw Error(ExitStatus::BadData,
                fmt::format("--merge: the sweep lacks {}; measure and name them too", join(missing)));
  }
  SweepPart whole{parts.front()->origin, 1, 1, {}};
  for (auto& part : parts) whole.rows.insert(whole.rows.end(), part->rows.begin(), part->rows.end());
  return whole;
}

}  // namespace myotact::measure

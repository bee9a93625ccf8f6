#include "scene/fascia_file.h"

#include <nlohmann/json.hpp>

#include "core/data_folder.h"
#include "core/file.h"
#include "core/json_reader.h"

namespace myotact::scene {

std::filesystem::path fascia_path() {
  return data_folder() / "assets" / "tissue" / "fascia.json";
}

simulation::Fascia read_fascia(const std::filesystem::path& file) {
  constexpr double kStiffest_Pa_m = 1e9;     // five times what muscles press on each other with
  constexpr double kFarthestReach_m = 5e-3;  // a muscle's half thickness: beyond, it is another neighbour's
  const nlohmann::json json = parse_json(read_file(file), file.string());
  JsonObject root(JsonValue(json, file.string()));
  root.at("schema").integer_between(1, 1);
  root.find("note");
  root.find("why");
  simulation::Fascia fascia;
  fascia.tension_Pa_m = root.at("tension_Pa_m").number_between(0.0, kStiffest_Pa_m);
  fascia.shear_Pa_m = root.at("shear_Pa_m").number_between(0.0, fascia.tension_Pa_m);
  fascia.reach_m = root.at("reach_m").number_between(0.0, kFarthestReach_m);
  root.finish();
  return fascia;
}

}  // namespace myotact::scene

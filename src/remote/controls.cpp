#include "remote/controls.h"

#include <nlohmann/json.hpp>

#include "core/json_reader.h"

namespace myotact::remote {

void add_control(const std::string& json, scene::Requests& requests) {
  const std::string kWhere = "control";
  const nlohmann::json parsed = parse_json(json, kWhere);
  JsonObject fields(JsonValue(parsed, kWhere));
  const std::string deed = fields.at("do").one_of(
      {"levels", "co_contract", "hold_posture", "gravity", "pause", "step", "reset", "shove", "stop"});
  if (deed == "levels") {
    requests.flexors = fields.at("flexors").number_between(0.0, 1.0);
    requests.extensors = fields.at("extensors").number_between(0.0, 1.0);
    requests.levels_changed = true;
    requests.balance_changed = false;
  } else if (deed == "co_contract") {
    requests.common = fields.at("common").number_between(0.0, 1.0);
    requests.difference = fields.at("difference").number_between(-1.0, 1.0);
    requests.balance_changed = true;
    requests.levels_changed = false;
  } else if (deed == "hold_posture") {
    requests.hold_posture = fields.at("on").boolean();
  } else if (deed == "gravity") {
    requests.gravity = fields.at("on").boolean();
  } else if (deed == "pause") {
    requests.paused = fields.at("on").boolean();
  } else if (deed == "step") {
    ++requests.steps;
  } else if (deed == "reset") {
    ++requests.resets;
  } else if (deed == "shove") {
    ++requests.shoves;
  } else {
    ++requests.stops;
  }
  fields.finish();
}

}  // namespace myotact::remote

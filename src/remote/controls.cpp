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
    requests.levels_asked = true;
    requests.balance_asked = false;
  } else if (deed == "co_contract") {
    requests.common = fields.at("common").number_between(0.0, 1.0);
    requests.difference = fields.at("difference").number_between(-1.0, 1.0);
    requests.balance_asked = true;
    requests.levels_asked = false;
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

std::vector<std::string> controls_between(const scene::Requests& before, const scene::Requests& now) {
  std::vector<std::string> controls;
  const auto ask = [&](const nlohmann::json& control) { controls.push_back(control.dump()); };
  const auto ask_again = [&](const char* deed, std::uint32_t from, std::uint32_t to) {
    for (; from != to; ++from) ask({{"do", deed}});
  };
  const bool new_levels = before.flexors != now.flexors || before.extensors != now.extensors;
  if (now.levels_asked && (!before.levels_asked || new_levels)) {
    ask({{"do", "levels"}, {"flexors", now.flexors}, {"extensors", now.extensors}});
  }
  const bool new_balance = before.common != now.common || before.difference != now.difference;
  if (now.balance_asked && (!before.balance_asked || new_balance)) {
    ask({{"do", "co_contract"}, {"common", now.common}, {"difference", now.difference}});
  }
  if (now.hold_posture != before.hold_posture) ask({{"do", "hold_posture"}, {"on", now.hold_posture}});
  if (now.gravity != before.gravity) ask({{"do", "gravity"}, {"on", now.gravity}});
  if (now.paused != before.paused) ask({{"do", "pause"}, {"on", now.paused}});
  ask_again("step", before.steps, now.steps);
  ask_again("reset", before.resets, now.resets);
  ask_again("shove", before.shoves, now.shoves);
  return controls;
}

}  // namespace myotact::remote

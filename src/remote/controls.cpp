#include "remote/controls.h"

#include <nlohmann/json.hpp>

#include "core/json_reader.h"

namespace myotact::remote {

namespace {

using Json = nlohmann::json;

messages::Order read_order(const std::string& what, JsonObject& fields) {
  if (what == "levels") {
    return messages::SetLevels{fields.at("flexors").number_between(0.0, 1.0),
                               fields.at("extensors").number_between(0.0, 1.0)};
  }
  if (what == "co_contract") {
    return messages::CoContract{fields.at("common").number_between(0.0, 1.0),
                                fields.at("difference").number_between(-1.0, 1.0)};
  }
  if (what == "hold_posture") return messages::HoldPosture{fields.at("on").boolean()};
  if (what == "gravity") return messages::SetGravity{fields.at("on").boolean()};
  if (what == "pause") return messages::Pause{fields.at("on").boolean()};
  if (what == "step") return messages::SingleStep{};
  if (what == "reset") return messages::Reset{};
  if (what == "shove") return messages::TestShove{};
  return messages::FollowScript{};
}

Json json_of(const messages::SetLevels& levels) {
  return {{"do", "levels"}, {"flexors", levels.flexors}, {"extensors", levels.extensors}};
}
Json json_of(const messages::CoContract& balance) {
  return {{"do", "co_contract"}, {"common", balance.common}, {"difference", balance.difference}};
}
Json json_of(const messages::HoldPosture& hold) {
  return {{"do", "hold_posture"}, {"on", hold.on}};
}
Json json_of(const messages::SetGravity& gravity) {
  return {{"do", "gravity"}, {"on", gravity.on}};
}
Json json_of(const messages::Pause& pause) {
  return {{"do", "pause"}, {"on", pause.on}};
}
Json json_of(const messages::SingleStep&) {
  return {{"do", "step"}};
}
Json json_of(const messages::Reset&) {
  return {{"do", "reset"}};
}
Json json_of(const messages::TestShove&) {
  return {{"do", "shove"}};
}
Json json_of(const messages::FollowScript&) {
  return {{"do", "follow_script"}};
}

}  // namespace

std::optional<messages::Order> order_of(const std::string& control) {
  const std::string kWhere = "control";
  const Json parsed = parse_json(control, kWhere);
  JsonObject fields(JsonValue(parsed, kWhere));
  const std::string what = fields.at("do").one_of(
      {"levels", "co_contract", "follow_script", "hold_posture", "gravity", "pause", "step", "reset", "shove", "stop"});
  std::optional<messages::Order> order;
  if (what != "stop") order = read_order(what, fields);
  fields.finish();
  return order;
}

std::optional<std::string> control_of(const messages::Order& order) {
  return std::visit(
      [](const auto& what) -> std::optional<std::string> {
        if constexpr (requires { json_of(what); }) {
          return json_of(what).dump();
        } else {
          return std::nullopt;
        }
      },
      order);
}

}  // namespace myotact::remote

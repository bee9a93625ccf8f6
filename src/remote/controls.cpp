#include "remote/controls.h"

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/json_reader.h"

namespace myotact::remote {

namespace {

using Json = nlohmann::json;

/// An order by the name that the wire has for it.
struct NamedOrder {
  const char* name;
  messages::Order (*read)(JsonObject& fields);
};

constexpr NamedOrder kOrders[] = {
    {"levels",
     [](JsonObject& fields) -> messages::Order {
       return messages::SetLevels{fields.at("flexors").number_between(0.0, 1.0),
                                  fields.at("extensors").number_between(0.0, 1.0)};
     }},
    {"co_contract",
     [](JsonObject& fields) -> messages::Order {
       return messages::CoContract{fields.at("common").number_between(0.0, 1.0),
                                   fields.at("difference").number_between(-1.0, 1.0)};
     }},
    {"follow_script", [](JsonObject&) -> messages::Order { return messages::FollowScript{}; }},
    {"hold_posture",
     [](JsonObject& fields) -> messages::Order { return messages::HoldPosture{fields.at("on").boolean()}; }},
    {"gravity", [](JsonObject& fields) -> messages::Order { return messages::SetGravity{fields.at("on").boolean()}; }},
    {"pause", [](JsonObject& fields) -> messages::Order { return messages::Pause{fields.at("on").boolean()}; }},
    {"step", [](JsonObject&) -> messages::Order { return messages::SingleStep{}; }},
    {"reset", [](JsonObject&) -> messages::Order { return messages::Reset{}; }},
    {"shove", [](JsonObject&) -> messages::Order { return messages::TestShove{}; }},
};
constexpr const char* kStop = "stop";  // no order: it goes beside every queue

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
  std::vector<std::string> names;
  for (const NamedOrder& known : kOrders) names.emplace_back(known.name);
  names.emplace_back(kStop);
  const std::string what = fields.at("do").one_of(names);
  std::optional<messages::Order> order;
  for (const NamedOrder& known : kOrders) {
    if (what == known.name) order = known.read(fields);
  }
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

#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/json_reader.h"

namespace myotact::measure {

/// What a case computed, by name. A quantity at a place carries it: "active(0.5)", see quantity_at().
using Quantities = std::map<std::string, double>;

/// One kind of case: reads its own keys of the case file and computes. Asks for every key it knows, whether or not the
/// file has it, so that a misspelt one is refused. Throws Error BadData for values out of range. Deterministic.
struct Kind {
  std::string name;
  Quantities (*run)(JsonObject& inputs);
};

/// Every kind that a case file may name. A new family of kinds adds its lines there.
const std::vector<Kind>& validation_kinds();

/// "name(place)" with the shortest text of the number, as a check writes it.
std::string quantity_at(std::string_view name, double place);

}  // namespace myotact::measure

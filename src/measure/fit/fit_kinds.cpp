#include "measure/fit/fit_kinds.h"

#include <algorithm>
#include <vector>

#include <nlohmann/json.hpp>

namespace myotact::measure {

const FitKind& fit_kind(const JsonValue& name) {
  static const std::vector<FitKind> kinds = {indentation_kind(), joint_torque_kind(), passive_length_tension_kind()};
  std::vector<std::string> names;
  for (const FitKind& kind : kinds) names.emplace_back(kind.name);
  const std::string wanted = name.one_of(names);
  return *std::find_if(kinds.begin(), kinds.end(), [&](const FitKind& kind) { return wanted == kind.name; });
}

std::pair<nlohmann::json, std::string> model_or_file(const JsonValue& value, const std::filesystem::path& folder) {
  if (!value.raw().is_string()) return {value.raw(), value.file() + ": " + value.pointer()};
  const std::filesystem::path file = folder / value.string();
  return {read_json(file), file.string()};
}

}  // namespace myotact::measure

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/json_reader.h"
#include "core/text.h"
#include "prepare/guess/markups.h"

namespace myotact::prepare {

namespace {

/// Farther out no scanner reaches [m].
constexpr double kFarthest_m = 10.0;
constexpr std::size_t kMostPoints = 10000;
constexpr const char* kEnding = ".mrk.json";

/// A member of an object of which more may hold than is known here; null where it is missing.
std::optional<JsonValue> member(const JsonValue& value, const char* key) {
  if (!value.raw().is_object()) throw value.error("must be an object in braces, as 3D Slicer writes it");
  const auto found = value.raw().find(key);
  if (found == value.raw().end()) return {};
  return JsonValue(*found, value.file(), value.pointer() + "/" + key);
}

JsonValue required(const JsonValue& value, const char* key) {
  if (auto found = member(value, key)) return *found;
  throw value.error(fmt::format("lacks \"{}\"; save the markup from 3D Slicer as {}", key, kEnding));
}

/// Newer files write a code of three words, of which the first is the unit.
double metres_of_unit(const JsonValue& markup) {
  const auto units = member(markup, "coordinateUnits");
  if (!units) return 1e-3;
  const bool coded = units->raw().is_array() && !units->raw().empty();
  const JsonValue unit = coded ? units->elements().front() : *units;
  const std::string name = unit.one_of({"mm", "cm", "m", "um"});
  return name == "mm" ? 1e-3 : name == "cm" ? 1e-2 : name == "m" ? 1.0 : 1e-6;
}

MarkupPoint read_point(const JsonValue& value, double metres, bool ras) {
  MarkupPoint point;
  if (const auto label = member(value, "label")) point.label = label->string();
  const JsonValue position = required(value, "position");
  point.position_m = metres * position.vec3();
  if (!(point.position_m.norm() <= kFarthest_m)) {
    throw position.error(fmt::format("lies {} m from the origin; must be at most {} m. Check the unit",
                                     to_text(point.position_m.norm()), to_text(kFarthest_m)));
  }
  if (ras) point.position_m = point.position_m.cwiseProduct(Vec3(-1.0, -1.0, 1.0));
  return point;
}

/// A control point that was never set has no place.
bool is_defined(const JsonValue& point) {
  const auto status = member(point, "positionStatus");
  return !status || status->string() == "defined";
}

std::optional<MarkupKind> kind_of(const std::string& type) {
  if (type == "Fiducial" || type == "PointList") return MarkupKind::Points;
  if (type == "Line") return MarkupKind::Line;
  if (type == "Curve") return MarkupKind::Curve;
  return {};
}

}  // namespace

std::vector<Markup> read_markups(const std::filesystem::path& file, std::vector<std::string>& notes) {
  const nlohmann::json json = read_json(file);
  const JsonValue root(json, file.string());
  std::string name = file.filename().string();
  if (name.ends_with(kEnding)) name.resize(name.size() - std::string(kEnding).size());
  std::vector<Markup> markups;
  for (const JsonValue& value : required(root, "markups").elements()) {
    const std::string type = required(value, "type").string();
    const auto kind = kind_of(type);
    if (!kind) {
      notes.push_back(fmt::format("{}: left out: a markup of type {} says nothing of a limb", file.string(), type));
      continue;
    }
    const auto system = member(value, "coordinateSystem");
    const bool ras = system && system->one_of({"LPS", "RAS"}) == "RAS";
    const double metres = metres_of_unit(value);
    Markup markup{*kind, file.string(), name, {}};
    const JsonValue points = required(value, "controlPoints");
    if (points.raw().size() > kMostPoints) {
      throw points.error(fmt::format("has {} points; at most {}", points.raw().size(), kMostPoints));
    }
    for (const JsonValue& point : points.elements()) {
      if (is_defined(point)) markup.points.push_back(read_point(point, metres, ras));
    }
    markups.push_back(std::move(markup));
  }
  return markups;
}

void place(std::vector<Markup>& markups, const Mat3& rotation) {
  for (Markup& markup : markups) {
    for (MarkupPoint& point : markup.points) point.position_m = rotation * point.position_m;
  }
}

}  // namespace myotact::prepare

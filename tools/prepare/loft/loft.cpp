#include "prepare/loft/loft.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <nlohmann/json.hpp>

#include "core/json_reader.h"
#include "prepare/loft/ellipses.h"

namespace myotact::prepare {

namespace {

constexpr double kMuscleSpacing_m = 4e-3;
constexpr int kMuscleAround = 16;
constexpr double kPawSpacing_m = 6e-3;
constexpr int kBoneAround = 32;
constexpr double kThinnestBone_m = 5e-4;
constexpr double kWidest_m = 0.5;

std::vector<Ellipse> read_sections(const JsonValue& list) {
  std::vector<Ellipse> ellipses;
  for (const JsonValue& section : list.elements()) ellipses.push_back(read_ellipse(section));
  if (ellipses.size() < 2) throw list.error("has fewer than 2 sections; a loft needs at least 2");
  return ellipses;
}

NamedSurface read_muscle(const JsonValue& value) {
  JsonObject fields(value);
  const std::string key = fields.at("key").string();
  fields.at("volume_cm3").number();  // of the measured mesh, for comparison
  const Vec3 origin = fields.at("tip_origin_m").vec3();
  const Vec3 insertion = fields.at("tip_insertion_m").vec3();
  const auto sections = read_sections(fields.at("sections"));
  fields.finish();
  NamedSurface muscle{key, loft_ellipses(sections, origin, insertion, kMuscleSpacing_m, kMuscleAround)};
  muscle.middle_m.push_back(origin);
  for (const Ellipse& section : sections) muscle.middle_m.push_back(section.centre_m);
  muscle.middle_m.push_back(insertion);
  return muscle;
}

std::vector<double> numbers(const JsonValue& list) {
  std::vector<double> values;
  for (const JsonValue& element : list.elements()) values.push_back(element.number_between(-kWidest_m, kWidest_m));
  return values;
}

/// Frame of an outline: positions are origin + along long + x second + y third.
struct OutlineFrame {
  Vec3 origin, along, second, third;
};

Ring read_outline_ring(const JsonValue& value, const OutlineFrame& frame) {
  JsonObject fields(value);
  const double along = fields.at("along_m").number_between(-kWidest_m, kWidest_m);
  const auto centre = fields.at("centre_m").elements(2);
  const auto cosines = numbers(fields.at("cos_m"));
  const auto sines = numbers(fields.at("sin_m"));
  fields.finish();
  if (cosines.size() != sines.size()) throw value.error("cos_m and sin_m must have the same length");
  Ring ring;
  for (int j = 0; j < kBoneAround; ++j) {
    const double t = 2.0 * std::numbers::pi * j / kBoneAround;
    double radius = 0.0;
    for (std::size_t k = 0; k < cosines.size(); ++k) {
      radius += cosines[k] * std::cos(static_cast<double>(k) * t) + sines[k] * std::sin(static_cast<double>(k) * t);
    }
    radius = std::max(radius, kThinnestBone_m);
    ring.push_back(frame.origin + along * frame.along + (centre[0].number() + radius * std::cos(t)) * frame.second +
                   (centre[1].number() + radius * std::sin(t)) * frame.third);
  }
  return ring;
}

NamedSurface read_bone(const JsonValue& value) {
  JsonObject fields(value);
  const std::string key = fields.at("key").string();
  fields.at("volume_cm3").number();
  const OutlineFrame frame{fields.at("origin_m").vec3(), fields.at("long_axis").vec3().normalized(),
                           fields.at("second_axis").vec3().normalized(), fields.at("third_axis").vec3().normalized()};
  const Vec3 proximal = fields.at("tip_proximal_m").vec3();
  const Vec3 distal = fields.at("tip_distal_m").vec3();
  std::vector<Ring> rings;
  for (const JsonValue& station : fields.at("stations").elements()) rings.push_back(read_outline_ring(station, frame));
  fields.finish();
  if (rings.size() < 2) throw value.error("has fewer than 2 stations; a loft needs at least 2");
  return {key, join_rings(rings, proximal, distal)};
}

NamedSurface read_scheme(const JsonValue& value) {
  JsonObject fields(value);
  const std::string key = fields.at("key").string();
  const Vec3 proximal = fields.at("tip_proximal_m").vec3();
  const Vec3 distal = fields.at("tip_distal_m").vec3();
  const auto sections = read_sections(fields.at("sections"));
  fields.finish();
  return {key, loft_ellipses(sections, proximal, distal, kPawSpacing_m, kMuscleAround)};
}

void read_heading(JsonObject& root) {
  root.at("schema").integer_between(1, 1);
  for (const char* key : {"what", "source", "licence"}) root.string_or(key, "");
}

std::filesystem::path beside(const std::filesystem::path& recipe, const std::string& ending) {
  return recipe.parent_path() / (recipe.stem().string() + ending);
}

}  // namespace

std::vector<NamedSurface> loft_muscles(const std::filesystem::path& recipe) {
  const auto file = beside(recipe, "_muscle_sections.json");
  const nlohmann::json json = read_json(file);
  JsonObject root(JsonValue(json, file.string()));
  read_heading(root);
  std::vector<NamedSurface> surfaces;
  for (const JsonValue& muscle : root.at("muscles").elements()) surfaces.push_back(read_muscle(muscle));
  root.finish();
  return surfaces;
}

std::vector<NamedSurface> loft_bones(const std::filesystem::path& recipe) {
  const auto file = beside(recipe, "_bone_outlines.json");
  const nlohmann::json json = read_json(file);
  JsonObject root(JsonValue(json, file.string()));
  read_heading(root);
  std::vector<NamedSurface> surfaces;
  for (const JsonValue& bone : root.at("bones").elements()) surfaces.push_back(read_bone(bone));
  for (const JsonValue& scheme : root.at("ellipses").elements()) surfaces.push_back(read_scheme(scheme));
  root.finish();
  return surfaces;
}

}  // namespace myotact::prepare

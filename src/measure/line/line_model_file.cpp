#include "measure/line/line_model_file.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/file.h"
#include "core/json_reader.h"
#include "core/text.h"
#include "measure/line/line_stiffness.h"
#include "measure/line/read_line_model.h"

namespace myotact::measure {
namespace {

// Ranges that hold every limb from a mouse's to a horse's and keep the arithmetic finite.
constexpr double kShortest_m = 1e-5, kLongest_m = 10.0;
constexpr double kWeakest_N = 1e-3, kStrongest_N = 1e6;
constexpr double kLightest_kg_m2 = 1e-9, kHeaviest_kg_m2 = 1e3;
constexpr double kMostPennate_rad = 1.5;
constexpr double kLeastStretch = 0.2, kLargestStretch = 2.0;
constexpr std::size_t kMostMuscles = 200, kMostPlaces = 361;
/// How much a rigid tendon of no length may miss by rounding of the lengths in a file.
constexpr double kRounding_m = 1e-9;

std::vector<JsonValue> some_of(const JsonValue& list, std::size_t most) {
  auto elements = list.elements();
  if (elements.empty()) throw list.error(fmt::format("is empty; must have 1 to {} elements", most));
  if (elements.size() > most) {
    throw list.error(fmt::format("has {} elements; must have 1 to {}", elements.size(), most));
  }
  return elements;
}

std::vector<double> numbers_of(const JsonValue& list, double lowest, double highest) {
  std::vector<double> numbers;
  for (const JsonValue& element : some_of(list, kMostPlaces))
    numbers.push_back(element.number_between(lowest, highest));
  return numbers;
}

std::string name_of(const JsonValue& value) {
  std::string name = value.string();
  const bool plain = std::none_of(name.begin(), name.end(), [](char c) { return c == ',' || c == '"' || c < ' '; });
  if (name.empty() || !plain) throw value.error("must be a name without commas, quotes and control characters");
  return name;
}

double read_sign(const JsonValue& value, Side side) {
  const double sign = value.number();
  if (sign != 1.0 && sign != -1.0) throw value.error(fmt::format("is {}; must be 1 or -1", to_text(sign)));
  if ((sign < 0.0) != (side == Side::Flexor)) {
    throw value.error(
        fmt::format("is {}, but the muscle is {}; must be -1 for a flexor, whose angle closes as the "
                    "joint flexes, and 1 for an extensor",
                    to_text(sign), side == Side::Flexor ? "a flexor" : "an extensor"));
  }
  return sign;
}

WrappedPath read_path(const JsonValue& value, Side side) {
  JsonObject fields(value);
  WrappedPath path;
  path.constant_m = fields.at("constant_m").number_between(0.0, kLongest_m);
  path.a_m = fields.at("a_m").number_between(kShortest_m, kLongest_m);
  path.b_m = fields.at("b_m").number_between(kShortest_m, kLongest_m);
  path.phi0_rad = fields.at("phi0_rad").number_between(0.0, 2.0 * std::numbers::pi);
  path.sign = read_sign(fields.at("sign"), side);
  path.offset_m = fields.at("offset_m").number_between(-kLongest_m, kLongest_m);
  const JsonValue radius = fields.at("radius_m");
  path.radius_m = radius.number();
  const double nearest_m = std::min(path.a_m, path.b_m);
  if (!(path.radius_m >= 0.0 && path.radius_m <= nearest_m)) {
    throw radius.error(
        fmt::format("is {}; must be between 0 and {}, the smaller of a_m and b_m: the ends of the path "
                    "lie outside of the cylinder",
                    to_text(path.radius_m), to_text(nearest_m)));
  }
  fields.finish();
  return path;
}

/// The angle between P and D must stay between 0 and a whole turn in every reported pose.
void require_open(const JsonValue& value, const WrappedPath& path, double q_rad) {
  for (const double at_rad : {q_rad - kPush_rad, q_rad, q_rad + kPush_rad}) {
    const double phi_rad = path.phi0_rad + path.sign * at_rad;
    if (phi_rad > 0.0 && phi_rad < 2.0 * std::numbers::pi) continue;
    throw value.error(
        fmt::format("phi0_rad + sign q is {} at q = {} (5 degrees beside a given angle count); must be "
                    "between 0 and 2 pi, or the line would have passed the hinge; leave that angle out",
                    to_text(phi_rad), to_text(at_rad)));
  }
}

double slack_at_rest_m(const JsonValue& stretch, const LineMuscle& muscle, double rest_q_rad) {
  const double n = stretch.number_between(kLeastStretch, kLargestStretch);
  const double narrowest = std::sin(muscle.unit.pennation_rad);
  if (n <= narrowest) {
    throw stretch.error(
        fmt::format("is {}; must be above {}, the sine of the pennation: shorter fibres cannot span "
                    "the muscle's width",
                    to_text(n), to_text(narrowest)));
  }
  return simulation::tendon_slack_for_m(muscle.unit, measure_path(muscle.path, rest_q_rad).length_m, n);
}

/// Either a length or the stretch of the fibres in a pose.
double read_slack_m(JsonObject& fields, const LineMuscle& muscle) {
  const auto slack = fields.find("tendon_slack_m");
  const auto stretch = fields.find("rest_stretch");
  const auto rest_q = fields.find("rest_q_rad");
  if (slack.has_value() == stretch.has_value()) {
    throw fields.value().error("must have exactly one of rest_stretch and tendon_slack_m");
  }
  const bool elastic = muscle.unit.tendon == simulation::Tendon::Elastic;
  const double least_m = elastic ? kShortest_m : 0.0;
  if (slack) {
    if (rest_q) throw rest_q->error("goes with rest_stretch; leave it out beside tendon_slack_m");
    return slack->number_between(least_m, kLongest_m);
  }
  const double rest_q_rad = rest_q ? rest_q->number_between(-std::numbers::pi, std::numbers::pi) : 0.0;
  if (rest_q) require_open(*rest_q, muscle.path, rest_q_rad);
  const double slack_m = slack_at_rest_m(*stretch, muscle, rest_q_rad);
  if (slack_m < least_m - kRounding_m) {
    throw stretch->error(
        fmt::format("leaves a tendon of {} m on a path of {} m; must be at least {}: lower it, or "
                    "lower optimal_fibre_m, or raise path/constant_m",
                    to_text(slack_m), to_text(measure_path(muscle.path, rest_q_rad).length_m), to_text(least_m)));
  }
  return std::max(slack_m, least_m);
}

LineMuscle read_muscle(const JsonValue& value, simulation::Tendon tendon) {
  JsonObject fields(value);
  LineMuscle muscle;
  muscle.key = name_of(fields.at("key"));
  muscle.side = fields.at("side").one_of({"flexor", "extensor"}) == "flexor" ? Side::Flexor : Side::Extensor;
  muscle.driven = fields.at("driven").boolean();
  const JsonValue path = fields.at("path");
  muscle.unit.peak_force_N = fields.at("peak_force_N").number_between(kWeakest_N, kStrongest_N);
  muscle.unit.optimal_fibre_m = fields.at("optimal_fibre_m").number_between(kShortest_m, kLongest_m);
  muscle.unit.pennation_rad = fields.at("pennation_rad").number_between(0.0, kMostPennate_rad);
  muscle.unit.tendon = tendon;
  for (const char* key : {"tendon_slack_m", "rest_stretch", "rest_q_rad"}) fields.find(key);
  fields.finish();
  muscle.path = read_path(path, muscle.side);
  muscle.unit.tendon_slack_m = read_slack_m(fields, muscle);
  return muscle;
}

void require_driven(const JsonValue& list, const LineJoint& joint, Side side, const char* name) {
  if (std::any_of(joint.muscles.begin(), joint.muscles.end(),
                  [side](const LineMuscle& muscle) { return muscle.side == side && muscle.driven; })) {
    return;
  }
  throw list.error(fmt::format("has no driven {}; both sides need one to balance the other", name));
}

void read_joint(const JsonValue& value, LineJoint& joint) {
  JsonObject fields(value);
  joint.name = name_of(fields.at("name"));
  joint.inertia_kg_m2 = fields.at("inertia_kg_m2").number_between(kLightest_kg_m2, kHeaviest_kg_m2);
  if (const auto lever = fields.find("paw_lever_m")) {
    joint.paw_lever_m = lever->number_between(kShortest_m, kLongest_m);
  }
  fields.finish();
}

void read_muscles(const JsonValue& list, simulation::Tendon tendon, LineModel& model) {
  std::set<std::string> keys;
  for (const JsonValue& element : some_of(list, kMostMuscles)) {
    LineMuscle muscle = read_muscle(element, tendon);
    if (!keys.insert(muscle.key).second) {
      throw JsonObject(element).at("key").error(fmt::format("\"{}\" is there twice; keys are unique", muscle.key));
    }
    for (const double q_rad : model.q_rad) {
      require_open(JsonObject(JsonObject(element).at("path")).at("phi0_rad"), muscle.path, q_rad);
    }
    model.joint.muscles.push_back(std::move(muscle));
  }
  require_driven(list, model.joint, Side::Flexor, "flexor");
  require_driven(list, model.joint, Side::Extensor, "extensor");
}

}  // namespace

bool is_line_model(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  const nlohmann::json json = read_json(path);
  if (!json.is_object() || json.contains("specimen") || json.contains("bodies")) return false;
  // A model with a key missing or misspelt still counts, so that the message is about models.
  return json.contains("muscles") || json.contains("levels") || json.contains("q_rad") || json.contains("tendon");
}

LineModel load_line_model(const std::filesystem::path& path) {
  const nlohmann::json json = read_json(path);
  return read_line_model(JsonValue(json, path.string()));
}

LineModel read_line_model(const JsonValue& value) {
  JsonObject fields(value);
  LineModel model;
  fields.at("schema").integer_between(1, 1);
  const JsonValue joint = fields.at("joint");
  const std::string tendon = fields.at("tendon").one_of({"rigid", "elastic"});
  model.short_range_stiffness = fields.boolean_or("short_range_stiffness", false);
  model.q_rad = numbers_of(fields.at("q_rad"), -std::numbers::pi, std::numbers::pi);
  model.levels = numbers_of(fields.at("levels"), 0.0, 1.0);
  const JsonValue muscles = fields.at("muscles");
  fields.finish();
  read_joint(joint, model.joint);
  read_muscles(muscles, tendon == "rigid" ? simulation::Tendon::Rigid : simulation::Tendon::Elastic, model);
  return model;
}

}  // namespace myotact::measure

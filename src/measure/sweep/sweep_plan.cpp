#include "measure/sweep/sweep_plan.h"

#include <algorithm>
#include <numeric>
#include <random>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/file.h"
#include "core/json_reader.h"
#include "core/number_list.h"
#include "core/text.h"

namespace myotact::measure {

namespace {

constexpr double kFarthestValue = 1e15;
constexpr std::size_t kMostSweptKeys = 20, kMostQuantities = 200;

std::vector<double> grid_values(const JsonValue& value) {
  std::vector<double> values;
  if (value.raw().is_string()) {
    try {
      return parse_number_list("values", value.string());
    } catch (const Error& error) {
      throw value.error(error.what());
    }
  }
  for (const JsonValue& entry : value.elements())
    values.push_back(entry.number_between(-kFarthestValue, kFarthestValue));
  if (values.empty()) throw value.error("is empty; give numbers, or \"first:step:last\"");
  return values;
}

SweptKey read_swept_key(const JsonValue& value, bool sampled) {
  JsonObject fields(value);
  SweptKey key;
  key.key = fields.at("key").string();
  if (sampled) {
    key.low = fields.at("low").number_between(-kFarthestValue, kFarthestValue);
    const JsonValue high = fields.at("high");
    key.high = high.number_between(-kFarthestValue, kFarthestValue);
    if (!(key.low < key.high)) {
      throw high.error(fmt::format("is {}, not above low, {}; exchange them", to_text(key.high), to_text(key.low)));
    }
  } else {
    key.values = grid_values(fields.at("values"));
  }
  fields.finish();
  return key;
}

void read_keys(JsonObject& fields, SweepPlan& plan) {
  if (const auto samples = fields.find("samples")) {
    JsonObject of(*samples);
    plan.samples = of.at("count").integer_between(1, kMostSweepPoints);
    plan.seed = static_cast<std::uint64_t>(of.at("seed").integer_between(0, 2'000'000'000));
    of.finish();
  }
  const JsonValue list = fields.at("parameters");
  double points = 1.0;
  for (const JsonValue& entry : list.elements()) {
    plan.keys.push_back(read_swept_key(entry, plan.samples > 0));
    for (std::size_t i = 0; i + 1 < plan.keys.size(); ++i) {
      if (plan.keys[i].key == plan.keys.back().key) throw entry.error("this key is there twice; leave one out");
    }
    points *= std::max(1.0, static_cast<double>(plan.keys.back().values.size()));
  }
  if (plan.keys.empty() || plan.keys.size() > kMostSweptKeys) {
    throw list.error(fmt::format("has {} entries; must have 1 to {}", plan.keys.size(), kMostSweptKeys));
  }
  if (points > kMostSweepPoints) {
    throw list.error(fmt::format("makes {:.0f} points; must be at most {}: take fewer values, or samples", points,
                                 kMostSweepPoints));
  }
}

/// Keys with these values, as --set takes them.
Overrides overrides_of_point(const SweepPlan& plan, const std::vector<double>& values) {
  Overrides overrides = plan.set;
  for (std::size_t k = 0; k < plan.keys.size(); ++k) overrides[plan.keys[k].key] = to_text(values[k]);
  return overrides;
}

/// Portable: the library's own shuffle differs between libraries.
std::vector<int> shuffled(int count, std::mt19937_64& random) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

}  // namespace

int SweepPlan::points() const {
  if (samples > 0) return samples;
  std::size_t count = 1;
  for (const SweptKey& key : keys) count *= key.values.size();
  return static_cast<int>(count);
}

std::vector<std::vector<double>> sweep_points(const SweepPlan& plan) {
  const auto count = static_cast<std::size_t>(plan.points());
  std::vector<std::vector<double>> points(count, std::vector<double>(plan.keys.size()));
  std::mt19937_64 random(plan.seed);
  std::size_t repeat = count;
  for (std::size_t k = 0; k < plan.keys.size(); ++k) {
    const SweptKey& key = plan.keys[k];
    if (plan.samples == 0) {
      repeat /= key.values.size();
      for (std::size_t i = 0; i < count; ++i) points[i][k] = key.values[i / repeat % key.values.size()];
      continue;
    }
    const std::vector<int> order = shuffled(plan.samples, random);
    for (std::size_t i = 0; i < count; ++i) {
      const double within = (static_cast<double>(random() >> 11U) + 0.5) / 9007199254740992.0;  // of its stripe
      points[i][k] = key.low + (key.high - key.low) * (order[i] + within) / static_cast<double>(count);
    }
  }
  return points;
}

scene::Scene scene_of_point(const SweepPlan& plan, const std::vector<double>& values) {
  return scene::load_scene(plan.scene, overrides_of_point(plan, values));
}

SweepPlan load_sweep(const std::filesystem::path& path, const std::string& version) {
  const nlohmann::json json = read_json(path);
  JsonObject fields(JsonValue(json, path.string()));
  fields.at("schema").integer_between(1, 1);
  SweepPlan plan;
  plan.file = path.string();
  plan.scene = fields.at("scene").string();
  if (plan.scene.ends_with(".json")) plan.scene = (path.parent_path() / plan.scene).string();
  if (const auto set = fields.find("set")) {
    for (const auto& [key, entry] : JsonObject(*set).entries()) plan.set[key] = entry.raw().dump();
  }
  read_keys(fields, plan);
  if (const auto seconds = fields.find("seconds")) plan.seconds = seconds->number_between(1e-3, 86400.0);
  const JsonValue quantities = fields.at("quantities");
  plan.quantities = quantities.strings();
  if (plan.quantities.empty() || plan.quantities.size() > kMostQuantities) {
    throw quantities.error(fmt::format("has {} entries; must have 1 to {}", plan.quantities.size(), kMostQuantities));
  }
  for (const std::string& quantity : plan.quantities) {
    if (quantity.starts_with("stiffness.") || quantity.starts_with("run.")) continue;
    throw quantities.error(fmt::format("\"{}\" must begin with \"stiffness.\" or \"run.\"", quantity));
  }
  fields.finish();
  const scene::Scene first = scene_of_point(plan, sweep_points(plan).front());
  plan.hash = sha256(json.dump() + sha256(first.source_text) +
                     sha256(read_file(first.specimen_folder / "specimen.json")) + version);
  return plan;
}

}  // namespace myotact::measure

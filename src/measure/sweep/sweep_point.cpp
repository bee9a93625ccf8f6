#include "measure/sweep/sweep_point.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/csv.h"
#include "core/error.h"
#include "core/json_places.h"
#include "core/json_reader.h"
#include "core/text.h"
#include "measure/stiffness_sweep.h"
#include "scene/lockstep_session.h"

namespace myotact::measure {

namespace {

bool asks_for(const SweepPlan& plan, std::string_view beginning) {
  return std::any_of(plan.quantities.begin(), plan.quantities.end(),
                     [&](const std::string& quantity) { return quantity.starts_with(beginning); });
}

nlohmann::json stiffness_at_point(const scene::Scene& scene) {
  if (!scene.co_contraction) {
    throw bad_data(scene.name, "/co_contraction", "is missing; add it to the scene to measure stiffness");
  }
  const double q_rad = scene.joints[static_cast<std::size_t>(scene.co_contraction->joint)].angle_rad;
  return stiffness_json(sweep_stiffness(scene, {{q_rad}, {scene.co_contraction->common}})).front();
}

nlohmann::json run_of_point(const scene::Scene& scene, double seconds) {
  simulation::Simulation simulation(scene.specimen, scene.settings);
  scene::SampleTable samples(scene.specimen, scene::hands_of(scene), 1'000'000);  // which nobody reads
  scene::LockstepSession session(scene, simulation, samples, nullptr);
  const double end_s = seconds > 0.0 ? seconds : session.conductor().script_end_s();
  const auto steps = std::llround(end_s / scene.settings.dt_s);
  for (long long step = 0; step < steps; ++step) session.step();
  const scene::Extremes& extremes = session.extremes();
  scene::ToolExtremes all;
  for (const scene::ToolExtremes& tool : extremes.tools) {
    all.force_N = std::max(all.force_N, tool.force_N);
    all.line_tension_N = std::max(all.line_tension_N, tool.line_tension_N);
    all.contact_s += tool.contact_s;
  }
  nlohmann::json run = {{"largest_force_N", all.force_N},
                        {"largest_line_tension_N", all.line_tension_N},
                        {"contact_s", all.contact_s},
                        {"largest_drift_rad", extremes.drift_rad},
                        {"largest_residual_share", extremes.residual_share},
                        {"largest_volume_error", extremes.volume_error},
                        {"smallest_J", extremes.smallest_J}};
  for (std::size_t j = 0; j < scene.specimen.joints.size(); ++j) {
    const simulation::JointReadout joint = simulation.joint(static_cast<int>(j));
    run["joints"][scene.specimen.joints[j].key] = {
        {"q_rad", joint.angle_rad}, {"torque_Nm", joint.net_torque_Nm}, {"K_Nm_rad", joint.stiffness_Nm_rad}};
  }
  for (std::size_t m = 0; m < scene.specimen.muscles.size(); ++m) {
    const auto muscle = static_cast<int>(m);
    run["muscles"][scene.specimen.muscles[m].key] = {{"force_N", simulation.muscle_force_N(muscle)},
                                                     {"contact_force_N", simulation.contact_force_N(muscle)},
                                                     {"activation", simulation.activation(muscle)}};
  }
  return run;
}

double number_of(const SweepPlan& plan, const std::string& quantity, nlohmann::json& measured) {
  const auto places = places_of(quantity, measured);
  if (places.size() == 1 && places[0]->is_number()) return places[0]->get<double>();
  if (places.size() == 1 && places[0]->is_boolean()) return places[0]->get<bool>() ? 1.0 : 0.0;
  if (places.size() == 1 && places[0]->is_null()) return std::nan("");
  std::vector<std::string> known;
  const nlohmann::json flat = measured.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    if (!value.is_number() && !value.is_boolean()) continue;
    known.push_back(pointer.substr(1));
    std::replace(known.back().begin(), known.back().end(), '/', '.');
  }
  throw bad_data(plan.file, "/quantities",
                 fmt::format("\"{}\" is no number that is measured; the nearest is \"{}\"", quantity,
                             nearest_word(quantity, known)));
}

}  // namespace

SweepResult measure_point(const SweepPlan& plan, const std::vector<double>& values, int workers) {
  SweepResult result;
  nlohmann::json measured = nlohmann::json::object();
  try {
    scene::Scene scene = scene_of_point(plan, values);
    scene.settings.workers = workers;
    scene::set_seed(scene, 1);
    if (asks_for(plan, "stiffness.")) measured["stiffness"] = stiffness_at_point(scene);
    if (asks_for(plan, "run.")) measured["run"] = run_of_point(scene, plan.seconds);
  } catch (const Error& error) {
    result.error = error.what();
    result.quantities.assign(plan.quantities.size(), std::nan(""));
    return result;
  }
  for (const std::string& quantity : plan.quantities) result.quantities.push_back(number_of(plan, quantity, measured));
  return result;
}

std::string point_file_name(int point) {
  return fmt::format("point_{:06d}.json", point);
}

std::string point_json(const SweepPlan& plan, int point, const SweepResult& result) {
  nlohmann::ordered_json json;
  json["schema"] = 1;
  json["sweep"] = plan.hash;
  json["point"] = point;
  json["quantities"] = nlohmann::ordered_json::array();
  for (const double number : result.quantities) {
    json["quantities"].push_back(std::isfinite(number) ? nlohmann::ordered_json(number) : nullptr);
  }
  json["error"] = result.error;
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::optional<SweepResult> read_point(const SweepPlan& plan, int point, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / point_file_name(point);
  std::error_code failure;
  if (!std::filesystem::exists(file, failure)) return std::nullopt;
  const nlohmann::json json = read_json(file);
  JsonObject fields(JsonValue(json, file.string()));
  fields.at("schema").integer_between(1, 1);
  const JsonValue sweep = fields.at("sweep");
  if (sweep.string() != plan.hash) {
    throw sweep.error(
        "is another sweep's: the sweep, its scene, its specimen or the program has changed; give another --out");
  }
  fields.at("point").integer_between(point, point);
  SweepResult result;
  for (const JsonValue& number : fields.at("quantities").elements(plan.quantities.size())) {
    result.quantities.push_back(number.raw().is_null() ? std::nan("") : number.number());
  }
  result.error = fields.at("error").string();
  fields.finish();
  return result;
}

std::string sweep_csv(const SweepPlan& plan, const std::vector<SweepResult>& results) {
  std::string csv = "point";
  for (const SweptKey& key : plan.keys) csv += "," + csv_field(key.key);
  for (const std::string& quantity : plan.quantities) csv += "," + csv_field(quantity);
  csv += ",error\n";
  const auto points = sweep_points(plan);
  for (std::size_t i = 0; i < results.size(); ++i) {
    csv += std::to_string(i);
    for (const double value : points[i]) csv += "," + to_text(value);
    for (const double number : results[i].quantities) csv += "," + (std::isfinite(number) ? to_text(number) : "nan");
    csv += "," + csv_field(results[i].error) + "\n";
  }
  return csv;
}

}  // namespace myotact::measure

#include "measure/fidelity/layer_fidelity.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/text.h"
#include "layer/bullet_engine.h"
#include "layer/simulation_engine.h"

namespace myotact::measure {
namespace {

constexpr double kStep_s = 1.0 / 60.0;  // what the layer is for: 60 Hz under 1 kHz

std::string cell(double value) {
  return std::isnan(value) ? "-" : fmt::format("{:.4g}", value);
}

}  // namespace

std::vector<std::string> layer_engines() {
  std::vector<std::string> names{"myotact"};
  if (layer::has_bullet()) names.emplace_back("bullet");
  return names;
}

std::unique_ptr<layer::Engine> make_layer_engine(const std::string& name, const scene::Scene& scene) {
  const double radius_m = scene.tools.front().radius_m;
  if (name == "bullet") {
    layer::BulletSettings settings;
    settings.step_s = kStep_s;
    settings.gravity_m_s2 = scene.settings.gravity_m_s2;
    settings.tools = {{layer::ToolBody::Shape::Sphere, radius_m}};
    return layer::make_bullet_engine(scene.specimen, settings);
  }
  simulation::SimulationSettings settings = scene.settings;
  settings.dt_s = kStep_s;
  return std::make_unique<layer::SimulationEngine>(scene.specimen, settings, std::vector{radius_m});
}

LayerRun::LayerRun(const std::string& engine, const scene::Scene& scene, const haptics::HapticSettings& settings,
                   const Vec3& start_m)
    : engine_(make_layer_engine(engine, scene)),
      device_("simulated", start_m),
      tools_{layer::LayerTool{&device_, settings}},
      layer_(*engine_, tools_) {
  last_.target_m = last_.hand_m = start_m;
}

const LayerTick& LayerRun::tick(const Vec3& target_m, const Vec3& target_velocity_m_s, std::uint32_t buttons) {
  device_.set_hand_target({to_array(target_m), to_array(target_velocity_m_s), buttons});
  last_.t_s = layer_.time_s();
  layer_.tick();
  last_.target_m = target_m;
  last_.hand_m = device_.position_world_m();
  last_.force_N = to_vec3(tool().force_world_N);
  return last_;
}

bool LayerFidelity::passed() const {
  return std::all_of(figures.begin(), figures.end(), [](const Figure& figure) { return figure.met(); });
}

std::string layer_text(const LayerFidelity& fidelity) {
  std::string text = fidelity.title + "\n\n";
  for (const std::string& column : fidelity.columns) text += fmt::format("{:>14}", column);
  text += '\n';
  for (std::size_t row = 0; row < fidelity.rows.size(); ++row) {
    for (const std::string& name : fidelity.rows[row]) text += fmt::format("{:>14}", name);
    for (const double value : fidelity.values[row]) text += fmt::format("{:>14}", cell(value));
    text += '\n';
  }
  text += '\n';
  for (const Figure& figure : fidelity.figures) {
    text += fmt::format("  {:<72} {:>10.4g} {:<4} goal {} {:<8.4g} {}\n", figure.what, figure.value, figure.unit,
                        figure.at_least ? ">=" : "<=", figure.goal, figure.met() ? "met" : "MISSED");
  }
  text += '\n';
  for (const std::string& note : fidelity.notes) text += "  " + note + '\n';
  return text;
}

std::string layer_json(const LayerFidelity& fidelity) {
  nlohmann::json rows = nlohmann::json::array(), figures = nlohmann::json::array();
  for (std::size_t row = 0; row < fidelity.rows.size(); ++row) {
    nlohmann::json entry;
    std::size_t column = 0;
    for (const std::string& name : fidelity.rows[row]) entry[fidelity.columns[column++]] = name;
    for (const double value : fidelity.values[row]) {  // a NaN becomes null
      entry[fidelity.columns[column++]] = value;
    }
    rows.push_back(std::move(entry));
  }
  for (const Figure& figure : fidelity.figures) {
    figures.push_back({{"what", figure.what},
                       {"value", figure.value},
                       {"unit", figure.unit},
                       {"goal", figure.goal},
                       {"at_least", figure.at_least},
                       {"met", figure.met()}});
  }
  const nlohmann::json report = {{"title", fidelity.title},
                                 {"passed", fidelity.passed()},
                                 {"rows", rows},
                                 {"figures", figures},
                                 {"notes", fidelity.notes}};
  return report.dump(2) + "\n";
}

std::string layer_csv(const LayerFidelity& fidelity) {
  std::string csv =
      "engine,run,t_s,target_x_m,target_y_m,target_z_m,hand_x_m,hand_y_m,hand_z_m,force_x_N,force_y_N,force_z_N\n";
  for (const LayerFidelity::Trace& trace : fidelity.traces) {
    for (const LayerTick& tick : trace.ticks) {
      csv += trace.engine + ',' + trace.name + ',' + to_text(tick.t_s);
      for (const Vec3& v : {tick.target_m, tick.hand_m, tick.force_N}) {
        for (int k = 0; k < 3; ++k) csv += ',' + to_text(v[k]);
      }
      csv += '\n';
    }
  }
  return csv;
}

}  // namespace myotact::measure

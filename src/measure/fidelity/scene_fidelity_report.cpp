#include "measure/fidelity/scene_fidelity_report.h"

#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/text.h"

namespace myotact::measure {

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

nlohmann::json comparison_json(const ForceComparison& c) {
  return {{"ticks", c.ticks},
          {"true_rms_N", c.true_rms_N},
          {"true_peak_N", c.true_peak_N},
          {"error_rms_N", c.error_rms_N},
          {"error_rms_share", c.error_rms_share},
          {"error_worst_N", c.error_worst_N},
          {"error_worst_share", c.error_worst_share},
          {"gain", c.gain},
          {"lag_s", c.lag_s},
          {"turn_world_rad", {c.rotation_rad.x(), c.rotation_rad.y(), c.rotation_rad.z()}},
          {"mean_angle_rad", c.mean_angle_rad},
          {"noise_rms_N", c.noise_rms_N},
          {"noise_N2_Hz", c.noise_N2_Hz},
          {"commanded_work_J", c.commanded_work_J},
          {"true_work_J", c.true_work_J}};
}

nlohmann::json faults_json(const PlantedFaults& faults) {
  return {{"delay_s", faults.delay_s},
          {"scale", faults.scale},
          {"rotate_rad", faults.rotate_rad},
          {"noise_N", faults.noise_N}};
}

std::string comparison_text(const std::string& name, const ForceComparison& c) {
  return fmt::format("  {:<30} {:>7.3f} {:>8.1f} {:>8.1f} {:>7.3f} {:>8.2f} {:>7.2f} {:>8.1f}\n", name, c.true_rms_N,
                     100.0 * c.error_rms_share, 100.0 * c.error_worst_share, c.gain, 1e3 * c.lag_s,
                     kDegrees * c.rotation_angle_rad(), 1e3 * c.noise_rms_N);
}

std::string faults_text(const char* name, const PlantedFaults& faults) {
  return fmt::format("  {:<50} {:>8.2f} {:>8.3f} {:>8.2f} {:>8.1f}\n", name, 1e3 * faults.delay_s, faults.scale,
                     kDegrees * faults.rotate_rad, 1e3 * faults.noise_N);
}

std::string quantities_text(const SceneFidelity& fidelity) {
  std::string text;
  for (const PressStiffness& press : fidelity.presses)
    text += fmt::format("press at {:.2f} s, {:.1f} mm deep: felt {:.0f} N/m, true {:.0f} N/m\n", press.start_s,
                        1e3 * press.depth_m, press.felt_N_m, press.true_N_m);
  if (fidelity.friction)
    text +=
        fmt::format("friction while sliding for {:.2f} s: felt {:.3f}, simulated {:.3f}, the scene asks for {:.3f}\n",
                    1e-3 * static_cast<double>(fidelity.friction->ticks), fidelity.friction->felt,
                    fidelity.friction->simulated, fidelity.friction->asked);
  if (fidelity.joint)
    text += fmt::format("joint in hand over {:.1f} degrees: felt {:.2f} N m/rad, read out {:.2f} N m/rad\n",
                        kDegrees * fidelity.joint->range_rad, fidelity.joint->felt_Nm_rad, fidelity.joint->read_Nm_rad);
  return text;
}

std::string device_text(const SceneFidelity& fidelity) {
  std::string text = fmt::format("device {}: answers a step of the hand after {} ticks of the loop and {} of its own\n",
                                 fidelity.device, fidelity.answer.loop_ticks, fidelity.answer.device_ticks);
  text += fmt::format("\n  {:<30} {:>9} {:>9} {:>9} {:>9} {:>10}\n", "stiffest calm wall [N/m]", "in hand", "bound",
                      "no hand", "bound", "rendered");
  for (const StiffnessRange& range : fidelity.ranges)
    text += fmt::format("  {:<30} {:>9.0f} {:>9.0f} {:>9.0f} {:>9.0f} {:>10.0f}\n", range.device, range.in_hand_N_m,
                        range.in_hand_bound_N_m, range.no_hand_N_m, range.no_hand_bound_N_m, range.allowed_N_m);
  return text;
}

nlohmann::json ranges_json(const SceneFidelity& fidelity) {
  nlohmann::json list = nlohmann::json::array();
  for (const StiffnessRange& range : fidelity.ranges)
    list.push_back({{"device", range.device},
                    {"in_hand_N_m", range.in_hand_N_m},
                    {"no_hand_N_m", range.no_hand_N_m},
                    {"in_hand_bound_N_m", range.in_hand_bound_N_m},
                    {"no_hand_bound_N_m", range.no_hand_bound_N_m},
                    {"rendered_at_most_N_m", range.allowed_N_m}});
  return list;
}

nlohmann::json quantities_json(const SceneFidelity& fidelity) {
  nlohmann::json json = {{"presses", nlohmann::json::array()}, {"friction", nullptr}, {"joint", nullptr}};
  for (const PressStiffness& press : fidelity.presses)
    json["presses"].push_back({{"start_s", press.start_s},
                               {"depth_m", press.depth_m},
                               {"felt_N_m", press.felt_N_m},
                               {"true_N_m", press.true_N_m}});
  if (fidelity.friction)
    json["friction"] = {{"ticks", fidelity.friction->ticks},
                        {"felt", fidelity.friction->felt},
                        {"simulated", fidelity.friction->simulated},
                        {"asked", fidelity.friction->asked}};
  if (fidelity.joint)
    json["joint"] = {{"felt_Nm_rad", fidelity.joint->felt_Nm_rad},
                     {"read_Nm_rad", fidelity.joint->read_Nm_rad},
                     {"range_rad", fidelity.joint->range_rad}};
  return json;
}

}  // namespace

const char* truth_text(Truth truth) {
  return truth == Truth::Ticks ? "the same path played again into the scene simulated with a step of 1 ms"
                               : "what the scene's own steps gave, straight lines between";
}

std::string scene_fidelity_text(const SceneFidelity& fidelity) {
  const std::vector<GradedFigure> figures = grade(fidelity);
  const ForceComparison& whole = fidelity.compared.front().found;
  std::string text = fmt::format("{}: {}\n", fidelity.scene, grade_text(worst_grade(figures)));
  text += fmt::format("truth: {}\n", truth_text(fidelity.truth));
  text += fmt::format(
      "compared: {:.2f} s near touch; left out {:.2f} s of gate, {:.2f} s of a closing or opening hand, "
      "{:.2f} s of more force than the device may give\n\n",
      1e-3 * static_cast<double>(whole.ticks), 1e-3 * static_cast<double>(fidelity.gate_ticks),
      1e-3 * static_cast<double>(fidelity.hand_ticks), 1e-3 * static_cast<double>(fidelity.limit_ticks));
  for (const GradedFigure& figure : figures)
    text += fmt::format("  {:<52} {:>9.3g} {:<8} {}  (good to {:g}, fair to {:g})\n", figure.name, figure.value,
                        figure.unit, grade_text(figure.grade()), figure.good, figure.fair);
  text += fmt::format("\n  {:<30} {:>7} {:>8} {:>8} {:>7} {:>8} {:>7} {:>8}\n", "", "N RMS", "% RMS", "% worst", "gain",
                      "lag ms", "angle", "mN noise");
  for (const ComparedForce& one : fidelity.compared) text += comparison_text(one.name, one.found);
  if (fidelity.haptic_part) text += comparison_text("of it: felt on own steps", *fidelity.haptic_part);
  if (fidelity.step_part) text += comparison_text("of it: own steps on truth", *fidelity.step_part);
  text += fmt::format("net work on the hand: commanded {:.2f} mJ, true {:.2f} mJ\n", 1e3 * whole.commanded_work_J,
                      1e3 * whole.true_work_J);
  text += quantities_text(fidelity);
  text += device_text(fidelity);
  if (fidelity.planted) {
    text += fmt::format("\n  {:<50} {:>8} {:>8} {:>8} {:>8}\n", "planted into the recorded force", "ms", "scale",
                        "degrees", "mN");
    text += faults_text("planted", fidelity.planted->planted);
    text += faults_text("found beside the force without", fidelity.planted->alone);
    text += faults_text("found beside the truth, beyond what was there", fidelity.planted->on_truth);
  }
  for (const std::string& note : fidelity.notes) text += fmt::format("note: {}\n", note);
  return text;
}

std::string scene_fidelity_json(const SceneFidelity& fidelity) {
  const std::vector<GradedFigure> figures = grade(fidelity);
  nlohmann::json json = {
      {"scene", fidelity.scene},
      {"truth", fidelity.truth == Truth::Ticks ? "ticks" : "steps"},
      {"verdict", grade_text(worst_grade(figures))},
      {"left_out_ticks",
       {{"gate", fidelity.gate_ticks}, {"hand", fidelity.hand_ticks}, {"limit", fidelity.limit_ticks}}},
      {"notes", fidelity.notes}};
  json["figures"] = nlohmann::json::array();
  for (const GradedFigure& figure : figures)
    json["figures"].push_back({{"name", figure.name},
                               {"value", figure.value},
                               {"unit", figure.unit},
                               {"good", figure.good},
                               {"fair", figure.fair},
                               {"verdict", grade_text(figure.grade())},
                               {"source", figure.source}});
  for (const ComparedForce& one : fidelity.compared) json["compared"][one.key] = comparison_json(one.found);
  if (fidelity.haptic_part) json["parts"]["felt_on_own_steps"] = comparison_json(*fidelity.haptic_part);
  if (fidelity.step_part) json["parts"]["own_steps_on_truth"] = comparison_json(*fidelity.step_part);
  json["device"] = {{"profile", fidelity.device},
                    {"answer_loop_ticks", fidelity.answer.loop_ticks},
                    {"answer_device_ticks", fidelity.answer.device_ticks}};
  json["stiffness_ranges"] = ranges_json(fidelity);
  json["quantities"] = quantities_json(fidelity);
  if (fidelity.planted)
    json["planted"] = {{"planted", faults_json(fidelity.planted->planted)},
                       {"found_alone", faults_json(fidelity.planted->alone)},
                       {"found_on_truth", faults_json(fidelity.planted->on_truth)},
                       {"all_found", fidelity.planted->all_found()}};
  return json.dump(2) + "\n";
}

std::string scene_fidelity_csv(const SceneFidelity& fidelity) {
  std::string csv =
      "t_s,judged,commanded_x_N,commanded_y_N,commanded_z_N,true_x_N,true_y_N,true_z_N,error_x_N,error_y_N,error_z_N\n";
  const ForceSeries& force = fidelity.force;
  for (std::size_t i = 0; i < force.true_N.size(); ++i) {
    csv += to_text(static_cast<double>(i) / 1e3) + (force.compared[i] ? ",1" : ",0");
    const Vec3 error_N = force.commanded_N[i] - force.true_N[i];
    for (const Vec3* vector : {&force.commanded_N[i], &force.true_N[i], &error_N})
      for (int k = 0; k < 3; ++k) csv += fmt::format(",{}", to_text((*vector)[k]));
    csv += '\n';
  }
  return csv;
}

}  // namespace myotact::measure

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "anatomy/specimen.h"
#include "core/at.h"
#include "core/text.h"
#include "measure/fit/fit_kinds.h"
#include "measure/line/read_line_model.h"
#include "measure/line_limb.h"
#include "scene/muscle_settings.h"
#include "scene/scene_file.h"
#include "simulation/line/line_tissue.h"

// Torque of all muscles about a joint, and of a spring, against the joint's angle: of a line model, or of a scene's
// specimen with its muscles as lines.

namespace myotact::measure {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A linear spring beside the muscles: ligaments and capsule.
struct JointSpring {
  double stiffness_Nm_rad = 0.0, rest_q_rad = 0.0;
};

JointSpring read_spring(const JsonValue& value) {
  JsonObject fields(value);
  JointSpring spring;
  if (const auto stiffness = fields.find("stiffness_Nm_rad")) {
    spring.stiffness_Nm_rad = stiffness->number_between(-1e6, 1e6);
  }
  if (const auto rest = fields.find("rest_q_rad")) {
    spring.rest_q_rad = rest->number_between(-std::numbers::pi, std::numbers::pi);
  }
  fields.finish();
  return spring;
}

/// What torques come from.
class TorqueSource {
 public:
  virtual ~TorqueSource() = default;
  /// Takes the numbers of a model of its kind. Throws Error for one that cannot be.
  virtual void take(const nlohmann::json& model) = 0;
  /// Of the muscles.
  virtual std::vector<std::string> keys() const = 0;
  /// `activations`: one a muscle.
  virtual double torque_Nm(double q_rad, const std::vector<double>& activations) const = 0;
};

class LineModelTorque : public TorqueSource {
 public:
  LineModelTorque(const nlohmann::json& model, std::string file) : file_(std::move(file)) { take_model(model); }

  void take(const nlohmann::json& model) override { take_model(model); }

  std::vector<std::string> keys() const override {
    std::vector<std::string> keys;
    for (const LineMuscle& muscle : joint_.muscles) keys.push_back(muscle.key);
    return keys;
  }

  double torque_Nm(double q_rad, const std::vector<double>& activations) const override {
    double sum_Nm = 0.0;
    for (std::size_t m = 0; m < joint_.muscles.size(); ++m) {
      const PathGeometry path = measure_path(joint_.muscles[m].path, q_rad);
      sum_Nm +=
          path.arm_m * simulation::hill_equilibrium(joint_.muscles[m].unit, path.length_m, activations[m]).force_N;
    }
    return sum_Nm;
  }

 private:
  void take_model(const nlohmann::json& model) {
    nlohmann::json own = model;
    own.erase("spring");
    joint_ = read_line_model(JsonValue(own, file_, "/model")).joint;
  }

  std::string file_;
  LineJoint joint_;
};

/// The muscles' mechanics that the scene's reader takes under "muscles".
nlohmann::json mechanics_json(const anatomy::Muscle& muscle) {
  return {{"peak_force_N", muscle.peak_force_N},
          {"optimal_fibre_m", muscle.optimal_fibre_m},
          {"pennation_rad", muscle.pennation_rad},
          {"rest_stretch", muscle.rest_stretch}};
}

/// All other joints stay as the scene has them.
class SpecimenTorque : public TorqueSource {
 public:
  SpecimenTorque(const scene::Scene& scene, int joint, std::string file)
      : file_(std::move(file)), joint_(joint), specimen_(lines_of(scene.specimen)), changed_(specimen_) {
    for (const auto& setting : scene.joints) angles_rad_.push_back(setting.angle_rad);
    tendon_ = scene.settings.tendon;
  }

  void take(const nlohmann::json& model) override {
    changed_ = specimen_;
    scene::read_muscle_settings(JsonValue(model.at("muscles"), file_, "/muscles"), changed_);
    simulation::Skeleton skeleton(changed_);
    skeleton.set_pose(std::vector<double>(angles_rad_.size(), 0.0));
    lines_.clear();
    for (const anatomy::MuscleLine& line : changed_.lines) {
      if (!simulation::spans_joint(line, skeleton, joint_)) continue;
      lines_.push_back(simulation::make_line_tissue(changed_.muscles[at(line.muscle)], line, skeleton, tendon_));
    }
  }

  std::vector<std::string> keys() const override {
    std::vector<std::string> keys;
    for (const anatomy::Muscle& muscle : specimen_.muscles) keys.push_back(muscle.key);
    return keys;
  }

  double torque_Nm(double q_rad, const std::vector<double>& activations) const override {
    simulation::Skeleton skeleton(changed_);
    std::vector<double> angles_rad = angles_rad_;
    angles_rad[at(joint_)] = q_rad;
    skeleton.set_pose(angles_rad);
    double sum_Nm = 0.0;
    simulation::LineGeometry geometry;
    for (const simulation::LineTissue& tissue : lines_) {
      simulation::measure_line(tissue.line, skeleton, geometry);
      const auto force =
          simulation::hill_equilibrium(tissue.hill, geometry.length_m, activations[at(tissue.line.muscle)]);
      sum_Nm -= geometry.slope_m_rad[joint_] * force.force_N;
    }
    return sum_Nm;
  }

 private:
  std::string file_;
  int joint_;
  anatomy::Specimen specimen_, changed_;
  std::vector<double> angles_rad_;
  simulation::Tendon tendon_ = simulation::Tendon::Elastic;
  std::vector<simulation::LineTissue> lines_;
};

/// The scene of a model {scene, joint}, and the joint's index.
std::pair<scene::Scene, int> scene_of_model(JsonObject& fields, const std::filesystem::path& folder) {
  const std::string name = fields.at("scene").string();
  const bool is_path = name.ends_with(".json");
  scene::Scene scene = scene::load_scene(is_path ? (folder / name).string() : name);
  const JsonValue joint = fields.at("joint");
  std::vector<std::string> keys;
  for (const anatomy::Joint& known : scene.specimen.joints) keys.push_back(known.key);
  const std::string key = joint.one_of(keys);
  const auto index = static_cast<int>(std::find(keys.begin(), keys.end(), key) - keys.begin());
  if (scene.specimen.joints[at(index)].axes.empty()) throw joint.error("does not rotate; name a joint that does");
  return {std::move(scene), index};
}

/// Of a line model, whose numbers are the parameters.
void complete_line_model(nlohmann::json& model, const std::string& file) {
  nlohmann::json own = model;
  if (own.is_object()) own.erase("spring");
  read_line_model(JsonValue(own, file));
}

/// Of a scene: what the specimen and the scene have, as the scene's reader takes it.
void complete_scene_model(const std::filesystem::path& folder, const std::string& file, nlohmann::json& model) {
  const nlohmann::json given = model;
  JsonObject fields(JsonValue(given, file));
  const auto [scene, joint] = scene_of_model(fields, folder);
  const auto muscles = fields.find("muscles");
  fields.find("spring");
  fields.finish();
  anatomy::Specimen specimen = lines_of(scene.specimen);
  if (muscles) scene::read_muscle_settings(*muscles, specimen);
  model["muscles"] = nlohmann::json::object();
  for (const anatomy::Muscle& muscle : specimen.muscles) model["muscles"][muscle.key] = mechanics_json(muscle);
  if (!model["spring"].contains("stiffness_Nm_rad")) {
    model["spring"]["stiffness_Nm_rad"] = specimen.joints[at(joint)].stiffness_Nm_rad;
  }
}

nlohmann::json torque_model(const JsonValue& value, const std::filesystem::path& folder) {
  auto [model, file] = model_or_file(value, folder);
  const bool of_scene = model.is_object() && model.contains("scene");
  if (model.is_object() && !model.contains("spring")) model["spring"] = nlohmann::json::object();
  if (of_scene) {
    complete_scene_model(folder, file, model);
  } else {
    complete_line_model(model, file);
  }
  read_spring(JsonValue(model["spring"], file, "/spring"));
  for (const char* key : {"stiffness_Nm_rad", "rest_q_rad"}) {
    if (!model["spring"].contains(key)) model["spring"][key] = 0.0;
  }
  return model;
}

/// Muscles that a word means: one by its key, or those of a side.
using MuscleWords = std::map<std::string, std::vector<std::string>>;

MuscleWords muscle_words(const nlohmann::json& model, const std::filesystem::path& folder) {
  MuscleWords words;
  if (!model.contains("scene")) {
    for (const nlohmann::json& muscle : model.at("muscles")) {
      const auto key = muscle.at("key").get<std::string>();
      words[key] = {key};
      if (muscle.at("driven").get<bool>()) words[muscle.at("side").get<std::string>() + "s"].push_back(key);
    }
    return words;
  }
  JsonObject fields(JsonValue(model, "model"));
  const auto [scene, joint] = scene_of_model(fields, folder);
  for (const anatomy::Muscle& muscle : scene.specimen.muscles) words[muscle.key] = {muscle.key};
  for (const anatomy::MuscleGroup& group : scene.specimen.groups) {
    if (group.joint != joint) continue;
    for (const int m : group.flexors) words["flexors"].push_back(scene.specimen.muscles[at(m)].key);
    for (const int m : group.extensors) words["extensors"].push_back(scene.specimen.muscles[at(m)].key);
  }
  return words;
}

nlohmann::json torque_setting(JsonObject& fields, const nlohmann::json& model, FitCurve& curve) {
  const std::filesystem::path folder = std::filesystem::path(fields.value().file()).parent_path();
  nlohmann::json levels = nlohmann::json::object();
  if (const auto activations = fields.find("activations")) {
    const MuscleWords words = muscle_words(model, folder);
    std::vector<std::string> known;
    for (const auto& [word, muscles] : words) known.push_back(word);
    for (const auto& [word, entry] : JsonObject(*activations).entries()) {
      const double level = entry.number_between(0.0, 1.0);
      const auto meant = words.find(word);
      if (meant == words.end()) {
        throw entry.error(
            fmt::format("\"{}\" is no muscle of the model, nor flexors or extensors; the nearest is \"{}\"", word,
                        nearest_word(word, known)));
      }
      for (const std::string& muscle : meant->second) levels[muscle] = level;
    }
  }
  for (const double q_rad : curve.x) {
    if (std::abs(q_rad) > std::numbers::pi) {
      throw bad_data(curve.file, "",
                     fmt::format("has an angle of {} rad; must be within -pi .. pi: is it in degrees? "
                                 "Then name the column angle_deg",
                                 to_text(q_rad)));
    }
  }
  curve.x_name = "angle_rad";
  return levels;
}

std::shared_ptr<TorqueSource> torque_source(const FitProblem& problem) {
  if (!problem.model.contains("scene")) return std::make_shared<LineModelTorque>(problem.model, problem.file);
  const std::filesystem::path folder = std::filesystem::path(problem.file).parent_path();
  JsonObject fields(JsonValue(problem.model, problem.file, "/model"));
  const auto [scene, joint] = scene_of_model(fields, folder);
  return std::make_shared<SpecimenTorque>(scene, joint, problem.file);
}

void predict_torque(FitProblem& problem) {
  const std::shared_ptr<TorqueSource> source = torque_source(problem);
  std::vector<std::vector<double>> levels;  // curve by curve, one a muscle
  for (const FitCurve& curve : problem.curves) {
    levels.emplace_back();
    for (const std::string& key : source->keys()) levels.back().push_back(curve.setting.value(key, 0.0));
  }
  problem.predict = [source, levels, curves = problem.curves, file = problem.file](const nlohmann::json& model) {
    source->take(model);
    const JointSpring spring = read_spring(JsonValue(model.at("spring"), file, "/model/spring"));
    std::vector<double> torque_Nm;
    for (std::size_t c = 0; c < curves.size(); ++c) {
      for (const double q_rad : curves[c].x) {
        torque_Nm.push_back(source->torque_Nm(q_rad, levels[c]) -
                            spring.stiffness_Nm_rad * (q_rad - spring.rest_q_rad));
      }
    }
    return torque_Nm;
  };
}

}  // namespace

FitKind joint_torque_kind() {
  return {"joint_torque",
          {"angle of the joint", {{"angle_rad", 1.0}, {"angle_deg", kDegree}}},
          {"torque", {{"torque_Nm", 1.0}, {"torque_Nmm", 1e-3}}},
          torque_model,
          torque_setting,
          predict_torque};
}

}  // namespace myotact::measure

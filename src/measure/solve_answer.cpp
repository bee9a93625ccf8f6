#include "measure/solve_answer.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <nlohmann/json.hpp>

#include "measure/case_laws.h"
#include "measure/case_outputs.h"
#include "simulation/solid/solid_motion.h"

namespace myotact::measure {

namespace {

using simulation::Solid;

/// What a static solve or a motion leaves.
struct Outcome {
  bool converged = false;
  int steps = 0, iterations = 0;
  double reached = 0.0;
  double activation = 0.0;  // in the state below
  Eigen::VectorXd position_m;
  Eigen::VectorXd reaction_N;
};

using Progress = std::function<void(const SolveProgress&)>;

simulation::ElementKind kind_of(Element element) {
  switch (element) {
    case Element::T4:
      return simulation::ElementKind::Linear;
    case Element::T4F:
      return simulation::ElementKind::Patched;
    default:
      return simulation::ElementKind::Quadratic;
  }
}

simulation::SolidInput solid_input(const SolveCase& input) {
  simulation::SolidInput solid;
  solid.mesh = input.mesh.mesh;
  solid.kind = kind_of(input.element);
  solid.material = input.material_of_tet;
  solid.fibre = input.mesh.fibres;
  solid.patch = input.mesh.patches;
  for (const CaseMaterial& material : input.materials) {
    simulation::SolidMaterial out;
    out.laws = material.laws;
    out.density_kg_m3 = material.density_kg_m3.value_or(out.density_kg_m3);  // unused where the case has none
    out.fluctuation_Pa = material.fluctuation_Pa.value_or(default_fluctuation_Pa(material.laws));
    solid.materials.push_back(out);
  }
  return solid;
}

Outcome solve_statics(const SolveCase& input, const Solid& solid, const Progress& progress) {
  simulation::StaticOptions options;
  options.tolerance = input.tolerance.value_or(options.tolerance);
  options.load_steps = input.load_steps;
  SolveProgress now;
  options.progress = [&](double load, double residual_share) {
    ++now.iterations;
    now.share = load;
    now.residual_share = residual_share;
    progress(now);
  };
  const simulation::StaticResult result = simulation::solve_static(solid, input.loads, solid.rest_m(), options);
  Outcome out;
  out.converged = result.converged;
  out.steps = result.load_steps;
  out.iterations = result.iterations;
  out.reached = result.load;
  out.activation = result.load * input.loads.activation;
  out.position_m = result.position_m;
  out.reaction_N = result.reaction_N;
  return out;
}

/// What the supports of a motion exert: held components do not accelerate, and the mass is lumped, so that what nothing
/// else balances there is theirs.
Eigen::VectorXd held_reactions_N(const SolveCase& input, const Solid& solid, const Outcome& state) {
  simulation::SolidLoads loads = input.loads;
  loads.activation = state.activation;
  Solid::Evaluation evaluation = solid.make_evaluation();
  simulation::out_of_balance({solid, loads}, 1.0, state.position_m, Solid::Tangent::None, evaluation);
  Eigen::VectorXd reaction_N = Eigen::VectorXd::Zero(evaluation.force_N.size());
  for (const auto& held : loads.held) {
    const Eigen::Index k = 3 * held.node + held.component;
    reaction_N[k] = evaluation.force_N[k];
  }
  return reaction_N;
}

Outcome solve_motion(const SolveCase& input, const Solid& solid, const Progress& progress) {
  simulation::MotionOptions options;
  options.dt_s = input.dt_s;
  options.second_order = input.dynamics == Dynamics::Bdf2;
  simulation::SolidMotion motion(solid, input.loads, options);
  const int steps = std::max(1, static_cast<int>(std::lround(input.t_end_s / input.dt_s)));
  Outcome out;
  out.converged = true;
  out.position_m = solid.rest_m();
  for (int step = 1; step <= steps && out.converged; ++step) {
    const double t_s = step * input.dt_s;
    const double grown = input.activation_ramp_s > 0.0 ? std::min(1.0, t_s / input.activation_ramp_s) : 1.0;
    motion.set_activation(grown * input.loads.activation);
    // One Newton step may leap past the point where a tet has no volume left; nothing real follows from there.
    out.converged = motion.step() && motion.smallest_J() > 0.0;
    out.iterations += options.newton_steps;
    if (!out.converged) break;
    out.position_m = motion.position_m();
    out.activation = grown * input.loads.activation;
    out.steps = step;
    out.reached = static_cast<double>(step) / steps;
    progress({out.reached, motion.residual_share(), out.iterations});
  }
  out.reaction_N = held_reactions_N(input, solid, out);
  return out;
}

std::vector<Vec3> vectors_of(const Eigen::VectorXd& values) {
  std::vector<Vec3> vectors;
  for (Eigen::Index k = 0; k < values.size(); k += 3) vectors.emplace_back(values.segment<3>(k));
  return vectors;
}

SolvedState state_of(const SolveCase& input, const Solid& solid, const Outcome& outcome) {
  SolvedState state;
  state.displacement_m = vectors_of(outcome.position_m - solid.rest_m());
  state.reaction_N = vectors_of(outcome.reaction_N);
  for (std::size_t tet = 0; tet < input.mesh.mesh.corners.size(); ++tet) {
    const Solid::TetState of_tet = solid.state_of(tet, outcome.position_m, outcome.activation);
    state.cauchy_Pa.push_back(of_tet.cauchy_Pa);
    state.volume_ratio.push_back(of_tet.J);
    state.stretch.push_back(of_tet.fibre_stretch);
    state.rest_volume_m3.push_back(solid.rest_volume_m3(tet));
  }
  state.energy_J = solid.energy_J(outcome.position_m, outcome.activation);
  return state;
}

void fill_results(const SolveCase& input, const Outcome& outcome, const SolvedState& state, SolveAnswer& answer) {
  answer.deformed.mesh = input.mesh.mesh;
  answer.deformed.mesh.nodes_m = vectors_of(outcome.position_m);
  answer.deformed.regions = input.mesh.regions;
  std::vector<double> stress_Pa;
  for (const Mat3& cauchy_Pa : state.cauchy_Pa) stress_Pa.push_back(von_mises_Pa(cauchy_Pa));
  answer.results.point_vectors = {{"displacement", state.displacement_m}, {"reaction", state.reaction_N}};
  answer.results.cell_scalars = {{"volume_ratio", state.volume_ratio}, {"von_mises", stress_Pa}};
  if (!input.mesh.fibres.empty()) answer.results.cell_scalars.emplace_back("fibre_stretch", state.stretch);
}

}  // namespace

SolveAnswer solve_case(const SolveCase& input, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const Solid solid(solid_input(input), input.mesh.file);
  const bool is_static = input.dynamics == Dynamics::Static;
  const Outcome outcome = is_static ? solve_statics(input, solid, progress) : solve_motion(input, solid, progress);
  const SolvedState state = state_of(input, solid, outcome);
  SolveAnswer answer;
  answer.name = input.name;
  const auto crushed = std::min_element(state.volume_ratio.begin(), state.volume_ratio.end());
  answer.most_crushed_tet = static_cast<std::size_t>(crushed - state.volume_ratio.begin());
  answer.least_volume_ratio = *crushed;
  // The laws go on below volume 0, so that a search may pass there; forces balance there too, but nothing real does.
  answer.converged = outcome.converged && answer.least_volume_ratio > 0.0;
  answer.steps = outcome.steps;
  answer.iterations = outcome.iterations;
  answer.reached = outcome.reached;
  for (const CaseOutput& output : input.outputs) answer.outputs.emplace_back(output, evaluate_output(output, state));
  fill_results(input, outcome, state, answer);
  answer.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return answer;
}

std::string answer_json(const SolveAnswer& answer) {
  nlohmann::ordered_json json;
  json["case"] = answer.name;
  json["converged"] = answer.converged;
  json["steps"] = answer.steps;
  json["iterations"] = answer.iterations;
  json["wall_s"] = answer.wall_s;
  json["outputs"] = nlohmann::ordered_json::object();
  json["units"] = nlohmann::ordered_json::object();
  for (const auto& [output, values] : answer.outputs) {
    json["outputs"][output.name] =
        values.size() == 1 ? nlohmann::ordered_json(values[0]) : nlohmann::ordered_json(values);
    json["units"][output.name] = unit_of(output.quantity);
  }
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace myotact::measure

#include "measure/validation/muscle_kinds.h"

#include <cmath>

#include "measure/validation/nested_muscle.h"
#include "measure/validation/solid_inputs.h"
#include "simulation/solid/solid_motion.h"

namespace myotact::measure {
namespace {

using simulation::ElementKind;
using simulation::Solid;
using simulation::SolidLoads;
using simulation::StaticResult;

struct Tests {
  double shear_Pa = 0.0, poisson = 0.0, peak_Pa = 0.0;
  std::vector<double> activations;
  double shortening_activation = 0.0, bending_N = 0.0, press_N = 0.0;
};

Tests read_tests(JsonObject& inputs) {
  Tests tests;
  tests.shear_Pa = inputs.at("shear_Pa").number_between(1.0, 1e9);
  tests.poisson = inputs.at("poisson").number_between(0.0, 0.4999);
  tests.peak_Pa = inputs.at("peak_Pa").number_between(0.0, 1e7);
  for (const JsonValue& value : inputs.at("activations").elements()) {
    tests.activations.push_back(value.number_between(0.0, 1.0));
  }
  tests.shortening_activation = inputs.at("shortening_activation").number_between(0.0, 1.0);
  tests.bending_N = inputs.at("bending_N").number_between(0.0, 10.0);
  tests.press_N = inputs.at("press_N").number_between(0.0, 10.0);
  return tests;
}

simulation::SolidInput input_of(const NestedMuscle& muscle, const Tests& tests, const ElementChoice& element) {
  const double young_Pa = 2.0 * tests.shear_Pa * (1.0 + tests.poisson);
  const simulation::Law matrix = elastic_law("stable_neo_hookean", young_Pa, tests.poisson);
  const double fluctuation_Pa =
      element.fluctuation_over_shear < 0.0 ? -1.0 : element.fluctuation_over_shear * tests.shear_Pa;
  simulation::SolidInput input;
  input.mesh = muscle.mesh;
  input.kind = element.kind;
  simulation::MuscleFibre fibre;
  fibre.peak_Pa = tests.peak_Pa;
  input.materials = {{{matrix, simulation::UnsplitFibres<simulation::MuscleFibre>{fibre}}, 1060.0, fluctuation_Pa},
                     {{matrix}, 1060.0, fluctuation_Pa}};
  input.material.assign(muscle.tendon.begin(), muscle.tendon.end());
  input.fibre = muscle.fibre;
  if (element.kind == ElementKind::Patched) {  // the children of a tet
    for (std::size_t t = 0; t < muscle.mesh.corners.size(); ++t) input.patch.push_back(static_cast<int>(t / 8));
  }
  return input;
}

/// The static tests of one solid.
class Bench {
 public:
  Bench(const NestedMuscle& muscle, const Tests& tests, const ElementChoice& element)
      : muscle_(muscle),
        solid_(input_of(muscle, tests, element), "muscle"),
        ends_(ends_of_nodes(muscle, solid_)),
        insertion_(insertion_shares(muscle, solid_)),
        belly_(belly_shares(muscle, solid_)) {}

  /// Size of the force that holds the insertion.
  double force_N(double activation) const {
    SolidLoads loads = held(true);
    loads.activation = activation;
    const StaticResult result = solve(loads);
    Vec3 sum = Vec3::Zero();
    for (int n = 0; n < solid_.nodes(); ++n) {
      if (ends_[static_cast<std::size_t>(n)] == 1) sum += result.reaction_N.segment<3>(3 * n);
    }
    return if_converged(result, sum.norm());
  }
  double shortening_m(double activation) const {
    SolidLoads loads = held(false);
    loads.activation = activation;
    return moved_m(loads, insertion_, -muscle_.axis);
  }
  double bending_m(double force_N) const { return pushed_m(held(false), insertion_, force_N, muscle_.across); }
  double press_m(double force_N) const { return pushed_m(held(true), belly_, force_N, -muscle_.across); }
  double tets() const { return static_cast<double>(solid_.mesh().corners.size()); }

 private:
  SolidLoads held(bool both_ends) const {
    SolidLoads loads;
    for (int n = 0; n < solid_.nodes(); ++n) {
      const int end = ends_[static_cast<std::size_t>(n)];
      if (end == 0 || (end == 1 && both_ends)) clamp({n}, Vec3::Zero(), loads);
    }
    return loads;
  }
  StaticResult solve(const SolidLoads& loads) const {
    simulation::StaticOptions options;
    options.tolerance = 1e-7;
    StaticResult result;
    for (const int load_steps : {2, 1}) {  // other steps fold other elements on the way
      options.load_steps = load_steps;
      result = simulation::solve_static(solid_, loads, solid_.rest_m(), options);
      if (result.converged) return result;
    }
    return simulation::solve_static(solid_, loads, settled_m(loads), options);
  }
  /// Positions after a motion that backward Euler damps: it passes instabilities where a static path ends.
  Eigen::VectorXd settled_m(const SolidLoads& loads) const {
    constexpr double kStep_s = 0.05;
    constexpr int kSteps = 60, kNewtonSteps = 3;
    simulation::SolidMotion motion(solid_, loads, {kStep_s, false, kNewtonSteps});
    for (int step = 0; step < kSteps && motion.step();) ++step;
    return motion.position_m();
  }
  double moved_m(const SolidLoads& loads, const Eigen::VectorXd& shares, const Vec3& way) const {
    const StaticResult result = solve(loads);
    double sum = 0.0;
    for (int n = 0; n < solid_.nodes(); ++n) {
      sum += shares[n] * way.dot(result.position_m.segment<3>(3 * n) - solid_.rest_m().segment<3>(3 * n));
    }
    return if_converged(result, sum);
  }
  /// The passive fibres are tense at rest and move a released muscle by themselves, which the force must not be
  /// credited with.
  double pushed_m(SolidLoads loads, const Eigen::VectorXd& shares, double force_N, const Vec3& way) const {
    const double before_m = moved_m(loads, shares, way);
    loads.nodal_force_N = Eigen::VectorXd::Zero(solid_.rest_m().size());
    for (int n = 0; n < solid_.nodes(); ++n) loads.nodal_force_N.segment<3>(3 * n) = shares[n] * force_N * way;
    return moved_m(loads, shares, way) - before_m;
  }

  const NestedMuscle& muscle_;
  Solid solid_;
  std::vector<int> ends_;
  Eigen::VectorXd insertion_, belly_;
};

/// What a bench answers, by the ends of the quantities' names.
Quantities answers(const Bench& bench, const Tests& tests) {
  Quantities values;
  for (const double activation : tests.activations) {
    values[quantity_at("force", activation)] = bench.force_N(activation);
  }
  values["shortening"] = bench.shortening_m(tests.shortening_activation);
  values["bending"] = bench.bending_m(tests.bending_N);
  values["press"] = bench.press_m(tests.press_N);
  return values;
}

}  // namespace

Quantities muscle_elements(JsonObject& inputs) {
  struct Candidate {
    const char* name;
    ElementChoice element;
    bool refined;
  };
  constexpr double kDefault = 2.0;
  const std::vector<Candidate> candidates{{"linear", {ElementKind::Linear, 0.0}, true},
                                          {"patched", {ElementKind::Patched, 0.0}, true},
                                          {"quadratic_own", {ElementKind::Quadratic, -1.0}, false},
                                          {"quadratic", {ElementKind::Quadratic, kDefault}, false}};
  const NestedMuscle cage = read_nested_muscle(inputs.at("specimen").string(), inputs.at("muscle").string());
  const Tests tests = read_tests(inputs);
  const NestedMuscle fine = refine_muscle(cage);
  const Bench reference_bench(fine, tests, {ElementKind::Quadratic, kDefault});
  const Quantities reference = answers(reference_bench, tests);
  Quantities quantities{{"tets", static_cast<double>(cage.mesh.corners.size())},
                        {"reference_tets", reference_bench.tets()}};
  for (const auto& [name, value] : reference) quantities["reference_" + name] = value;
  for (const Candidate& candidate : candidates) {
    const Bench bench(candidate.refined ? fine : cage, tests, candidate.element);
    const std::string prefix = std::string(candidate.name) + "_";
    double forces = 0.0;
    for (const auto& [name, value] : answers(bench, tests)) {
      const double error = value / reference.at(name) - 1.0;
      quantities[prefix + name] = error;
      if (name.starts_with("force")) forces += std::abs(error) / static_cast<double>(tests.activations.size());
    }
    quantities[prefix + "force"] = forces;
  }
  return quantities;
}

}  // namespace myotact::measure

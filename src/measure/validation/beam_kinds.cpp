#include "measure/validation/beam_kinds.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include "measure/validation/solid_inputs.h"
#include "simulation/linear/block_factor.h"

namespace myotact::measure {
namespace {

using simulation::Solid;
using simulation::SolidLoads;
using simulation::StaticResult;

struct Elastic {
  std::string law;
  double young_Pa = 0.0;
};

Elastic read_elastic(JsonObject& inputs) {
  return {inputs.at("law").one_of(elastic_law_names()), inputs.at("young_Pa").number_between(1.0, 1e12)};
}

double read_poisson(const JsonValue& value) {
  return value.number_between(0.0, 0.49999);
}

simulation::SolidInput beam_input(const Box& box, const ElementChoice& element, const Elastic& elastic,
                                  double poisson) {
  return uniform_solid(make_box(box), element, {elastic_law(elastic.law, elastic.young_Pa, poisson)});
}

SolidLoads held_at_start(const Solid& solid) {
  SolidLoads loads;
  clamp(nodes_at(solid, 0, 0.0), Vec3::Zero(), loads);
  return loads;
}

double tip_displacement_m(const Box& box, const Solid& solid, const StaticResult& result) {
  return if_converged(result, mean_over(solid, nodes_at(solid, 0, box.size_m.x()), 2,
                                        Eigen::VectorXd(result.position_m - solid.rest_m())));
}

struct TipLoad {
  double force_N = 0.0;
  double shear_coefficient = 5.0 / 6.0;
};

double timoshenko_m(const Box& box, const TipLoad& load, double young_Pa, double poisson) {
  const double length = box.size_m.x(), width = box.size_m.y(), height = box.size_m.z();
  const double shear_Pa = 0.5 * young_Pa / (1.0 + poisson);
  const double inertia = width * height * height * height / 12.0;
  return load.force_N * (length * length * length / (3.0 * young_Pa * inertia) +
                         length / (load.shear_coefficient * shear_Pa * width * height));
}

double deflection_ratio(const Box& box, const TipLoad& load, const Solid& solid, double exact_m) {
  SolidLoads loads = held_at_start(solid);
  spread_force(solid, nodes_at(solid, 0, box.size_m.x()), {0.0, 0.0, load.force_N}, loads);
  simulation::StaticOptions options;
  options.tolerance = 1e-9;
  return tip_displacement_m(box, solid, simulation::solve_static(solid, loads, solid.rest_m(), options)) / exact_m;
}

/// Slope of ln(error) against ln(h), least squares.
double fitted_order(const std::vector<double>& cells, const std::vector<double>& errors) {
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const double x = -std::log(cells[k]), y = std::log(errors[k]);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  const auto n = static_cast<double>(cells.size());
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// Lowest eigenvalue of K y = w^2 M y whose held components are zero, by inverse iteration.
struct Vibration {
  double omega_rad_s = 0.0;
  bool converged = false;
};

Vibration lowest_vibration(const Solid& solid, const SolidLoads& loads) {
  constexpr int kMostIterations = 200;
  const simulation::HeldSystem system(solid, loads.held);
  simulation::ExactBlockFactor factor(solid.pattern());
  Solid::Evaluation at_rest = solid.make_evaluation();
  solid.evaluate(solid.rest_m(), 0.0, Solid::Tangent::Exact, at_rest);
  system.hold(at_rest.stiffness);
  if (!factor.factor(at_rest.stiffness)) return {};
  Eigen::VectorXd mass(solid.rest_m().size());
  for (Eigen::Index k = 0; k < mass.size(); ++k) mass[k] = solid.mass_kg()[k / 3];
  // Not symmetric, so that of two equal bending modes the start holds both and neither is missed.
  Eigen::VectorXd mode(mass.size());
  for (Eigen::Index k = 0; k < mode.size(); ++k) {
    mode[k] = k % 3 == 0 ? 0.0 : std::pow(solid.rest_m()[k - k % 3], 2.0) * (k % 3 == 1 ? 0.7 : 1.0);
  }
  Vibration result;
  for (int iteration = 0; iteration < kMostIterations && !result.converged; ++iteration) {
    Eigen::VectorXd pushed = mass.cwiseProduct(mode);
    system.drop_held(pushed);
    const Eigen::VectorXd next = factor.solve(pushed);
    const double squared = next.dot(pushed) / next.dot(mass.cwiseProduct(next));
    result.converged = std::abs(std::sqrt(squared) - result.omega_rad_s) < 1e-10 * result.omega_rad_s;
    result.omega_rad_s = std::sqrt(squared);
    mode = next / std::sqrt(next.dot(mass.cwiseProduct(next)));
  }
  return result;
}

/// Static shape under its own weight.
double hanging_tip_m(const Box& box, simulation::SolidInput input, double density_kg_m3, double gravity_m_s2) {
  input.materials[0].density_kg_m3 = density_kg_m3;
  const Solid solid(input, "beam");
  SolidLoads loads = held_at_start(solid);
  loads.gravity_m_s2 = {0.0, 0.0, -gravity_m_s2};
  simulation::StaticOptions options;
  options.tolerance = 1e-9;
  options.load_steps = 4;
  return tip_displacement_m(box, solid, simulation::solve_static(solid, loads, solid.rest_m(), options));
}

}  // namespace

Quantities cantilever(JsonObject& inputs) {
  Box box;
  box.size_m = inputs.at("size_m").vec3();
  box.mirrored = inputs.boolean_or("mirrored", true);
  const Elastic elastic = read_elastic(inputs);
  const ElementChoice element = read_element(inputs);
  const TipLoad load{inputs.at("force_N").number_between(1e-12, 1e3), inputs.number_or("shear_coefficient", 5.0 / 6.0)};
  const std::vector<JsonValue> meshes = inputs.at("meshes").elements();
  Quantities quantities;
  std::map<std::string, std::pair<double, double>> extremes;  // of the ratios on a mesh
  for (const JsonValue& value : inputs.at("poissons").elements()) {
    const double poisson = read_poisson(value);
    std::vector<double> cells, errors;
    for (const JsonValue& mesh : meshes) {
      box.cells = read_cells(mesh);
      const Solid solid(beam_input(box, element, elastic, poisson), "beam");
      const double ratio = deflection_ratio(box, load, solid, timoshenko_m(box, load, elastic.young_Pa, poisson));
      const std::string mesh_name = fmt::format("{}x{}x{}", box.cells[0], box.cells[1], box.cells[2]);
      quantities[quantity_at("ratio_" + mesh_name, poisson)] = ratio;
      auto& [least, most] = extremes.try_emplace("spread_" + mesh_name, ratio, ratio).first->second;
      least = std::min(least, ratio);
      most = std::max(most, ratio);
      cells.push_back(box.cells[2]);
      errors.push_back(std::abs(1.0 - ratio));
    }
    if (cells.size() > 1) quantities[quantity_at("order", poisson)] = fitted_order(cells, errors);
  }
  for (const auto& [name, range] : extremes) quantities[name] = range.second / range.first - 1.0;
  return quantities;
}

Quantities beam_vibration(JsonObject& inputs) {
  const Box box = read_box(inputs);
  const Elastic elastic = read_elastic(inputs);
  const double poisson = read_poisson(inputs.at("poisson"));
  const double density_kg_m3 = inputs.at("density_kg_m3").number_between(1.0, 1e5);
  simulation::SolidInput input = beam_input(box, read_element(inputs), elastic, poisson);
  input.materials[0].density_kg_m3 = density_kg_m3;
  const Solid solid(input, "beam");
  const Vibration vibration = lowest_vibration(solid, held_at_start(solid));
  constexpr double kFirstRoot = 1.8751040687119611;  // of cos x cosh x = -1
  const double height = std::min(box.size_m.y(), box.size_m.z()), length = box.size_m.x();
  const double thin_rad_s =
      kFirstRoot * kFirstRoot * height / (length * length) * std::sqrt(elastic.young_Pa / (12.0 * density_kg_m3));
  return {{"frequency_hz", vibration.omega_rad_s / (2.0 * std::numbers::pi)},
          {"euler_bernoulli_hz", thin_rad_s / (2.0 * std::numbers::pi)},
          {"converged", vibration.converged ? 1.0 : 0.0}};
}

Quantities hanging_beam(JsonObject& inputs) {
  const Box box = read_box(inputs);
  const Elastic elastic = read_elastic(inputs);
  const double poisson = read_poisson(inputs.at("poisson"));
  const double density_kg_m3 = inputs.at("density_kg_m3").number_between(1.0, 1e5);
  const double gravity_m_s2 = inputs.at("gravity_m_s2").number_between(0.0, 100.0);
  const ElementChoice element = read_element(inputs);
  const auto tip_m = [&](const Box& with, const ElementChoice& kind) {
    return hanging_tip_m(with, beam_input(with, kind, elastic, poisson), density_kg_m3, gravity_m_s2);
  };
  Quantities quantities{{"tip_m", tip_m(box, element)},
                        {"tets", static_cast<double>(6 * box.cells[0] * box.cells[1] * box.cells[2])}};
  const auto reference = inputs.find("reference");
  if (!reference) return quantities;
  JsonObject object(*reference);
  const ElementChoice kind = read_element(object);
  const Box finer{box.size_m, read_cells(object.at("cells")), box.mirrored};
  object.finish();
  quantities["reference_tip_m"] = tip_m(finer, kind);
  quantities["tip_ratio"] = quantities["tip_m"] / quantities["reference_tip_m"];
  return quantities;
}

}  // namespace myotact::measure

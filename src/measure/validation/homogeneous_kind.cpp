#include "measure/validation/homogeneous_kind.h"

#include <cmath>

#include "measure/validation/solid_inputs.h"

namespace myotact::measure {
namespace {

using simulation::Solid;
using simulation::SolidLoads;
using simulation::StaticResult;

/// As far down as round-off lets a bulk modulus of 5e4 shear moduli come.
constexpr double kTolerance = 1e-10;
constexpr int kLoadSteps = 4;
/// Rounds until the volume ratio that a law was given is the one that comes out.
constexpr int kMostRounds = 50;

simulation::StaticOptions options() {
  simulation::StaticOptions options;
  options.tolerance = kTolerance;
  options.load_steps = kLoadSteps;
  return options;
}

struct Specimen {
  Box box;
  const Solid& solid;
  std::string state;
};

SolidLoads loads_at(const Specimen& specimen, double place, double activation) {
  const Solid& solid = specimen.solid;
  const Vec3& size_m = specimen.box.size_m;
  SolidLoads loads;
  loads.activation = activation;
  if (specimen.state == "simple_shear") {
    for (int n = 0; n < solid.nodes(); ++n) {
      const Vec3 X = solid.rest_m().segment<3>(3 * n), part = X.cwiseQuotient(size_m);
      if (part.minCoeff() > 1e-9 && part.maxCoeff() < 1.0 - 1e-9) continue;
      clamp({n}, {place * X.y(), 0.0, 0.0}, loads);
    }
    return loads;
  }
  hold_symmetry_planes(solid, loads);
  const int moved = specimen.state == "uniaxial" ? 1 : specimen.state == "equibiaxial" ? 2 : 0;
  for (int axis = 0; axis < moved; ++axis) {
    hold(nodes_at(solid, axis, size_m[axis]), axis, (place - 1.0) * size_m[axis], loads);
  }
  if (specimen.state == "contraction") loads.activation = place;
  return loads;
}

double free_displacement_norm_m(const Solid& solid, const SolidLoads& loads, const StaticResult& result) {
  Eigen::VectorXd displacement = result.position_m - solid.rest_m();
  for (const simulation::HeldDof& dof : loads.held) displacement[3 * dof.node + dof.component] = 0.0;
  return displacement.norm();
}

double stress_spread(const Solid& solid, const StaticResult& result, double activation) {
  const Mat3 first = solid.state_of(0, result.position_m, activation).cauchy_Pa;
  double spread = 0.0;
  for (std::size_t t = 1; t < solid.mesh().corners.size(); ++t) {
    spread = std::max(spread, (solid.state_of(t, result.position_m, activation).cauchy_Pa - first).norm());
  }
  return spread / first.norm();
}

void note(const Specimen& specimen, double place, const SolidLoads& loads, const StaticResult& result,
          Quantities& quantities) {
  const Solid& solid = specimen.solid;
  const Vec3& size_m = specimen.box.size_m;
  const auto add = [&](const char* name, double value) {
    quantities[quantity_at(name, place)] = if_converged(result, value);
  };
  const auto stretch_along = [&](int axis) {
    return mean_over(solid, nodes_at(solid, axis, size_m[axis]), axis, result.position_m) / size_m[axis];
  };
  const Solid::TetState tet = solid.state_of(0, result.position_m, loads.activation);
  const double force_N = support_force_N(result, nodes_at(solid, 0, size_m.x()), 0);
  add("stretch", stretch_along(0));
  add("lateral", stretch_along(2));
  add("J", tet.J);
  add("cauchy_Pa", tet.cauchy_Pa(0, 0));
  add("shear_Pa", tet.cauchy_Pa(0, 1));
  add("normal_difference_Pa", tet.cauchy_Pa(0, 0) - tet.cauchy_Pa(1, 1));
  add("force_N", force_N);
  add("nominal_Pa", force_N / (size_m.y() * size_m.z()));
  add("spread", stress_spread(solid, result, loads.activation));
  add("displacement_norm_m", free_displacement_norm_m(solid, loads, result));
}

std::vector<double> read_places(JsonObject& inputs, const std::string& state) {
  std::vector<double> places;
  const bool shears = state == "simple_shear", active = state == "contraction";
  const JsonValue list = inputs.at(shears ? "shears" : active ? "activations" : "stretches");
  for (const JsonValue& place : list.elements()) {
    places.push_back(place.number_between(shears ? -3.0 : active ? 0.0 : 0.1, active ? 1.0 : 3.0));
  }
  return places;
}

}  // namespace

Quantities homogeneous_state(JsonObject& inputs) {
  const Box box = read_box(inputs);
  const ElementChoice element = read_element(inputs);
  std::vector<simulation::Law> laws = read_laws(inputs);
  const std::string state = inputs.at("state").one_of({"uniaxial", "equibiaxial", "simple_shear", "contraction"});
  const auto found = inputs.find("fibre");
  const Vec3 fibre = found ? found->vec3() : Vec3::UnitX();
  const double activation = inputs.number_or("activation", 0.0);
  Quantities quantities;
  for (const double place : read_places(inputs, state)) {
    bool again = true;
    for (int round = 0; again && round < kMostRounds; ++round) {
      const Solid solid(uniform_solid(make_box(box), element, laws, fibre), "box");
      const Specimen specimen{box, solid, state};
      const SolidLoads loads = loads_at(specimen, place, activation);
      const StaticResult result = simulation::solve_static(solid, loads, solid.rest_m(), options());
      note(specimen, place, loads, result, quantities);
      again = set_volume_ratio(solid.state_of(0, result.position_m, loads.activation).J, laws);
    }
  }
  return quantities;
}

}  // namespace myotact::measure

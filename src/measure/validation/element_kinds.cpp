#include "measure/validation/element_kinds.h"

#include <cmath>
#include <random>

#include "measure/validation/solid_inputs.h"

namespace myotact::measure {
namespace {

using simulation::Solid;

Solid shaken_solid(JsonObject& inputs, const Box& box) {
  geometry::TetMesh mesh = make_box(box);
  shake_inside(box, inputs.at("shake").number_between(0.0, 0.3), mesh);
  const ElementChoice element = read_element(inputs);
  const auto fibre = inputs.find("fibre");
  return {uniform_solid(mesh, element, read_laws(inputs), fibre ? fibre->vec3() : Vec3::UnitX()), "box"};
}

Mat3 read_gradient(JsonObject& inputs) {
  Mat3 gradient;
  const std::vector<JsonValue> rows = inputs.at("gradient").elements(3);
  for (int i = 0; i < 3; ++i) gradient.row(i) = rows[static_cast<std::size_t>(i)].vec3().transpose();
  return gradient;
}

bool on_surface(const Box& box, const Vec3& X) {
  const Vec3 part = X.cwiseQuotient(box.size_m);
  return part.minCoeff() < 1e-9 || part.maxCoeff() > 1.0 - 1e-9;
}

double largest_stress_difference(const Solid& solid, const Eigen::VectorXd& position_m) {
  const Mat3 first = solid.state_of(0, position_m, 0.0).cauchy_Pa;
  double largest = 0.0;
  for (std::size_t t = 1; t < solid.mesh().corners.size(); ++t) {
    largest = std::max(largest, (solid.state_of(t, position_m, 0.0).cauchy_Pa - first).norm());
  }
  return largest / first.norm();
}

/// Random numbers that are the same with every library.
Eigen::VectorXd random_vector(Eigen::Index size, unsigned seed) {
  std::mt19937 random(seed);
  Eigen::VectorXd values(size);
  for (Eigen::Index k = 0; k < size; ++k) values[k] = 2.0 * (static_cast<double>(random()) / 4294967295.0) - 1.0;
  return values;
}

class TangentProbe {
 public:
  TangentProbe(const Solid& solid, double activation, double displacement_m)
      : solid_(solid), activation_(activation), at_(solid.make_evaluation()), there_(solid.make_evaluation()) {
    const Eigen::Index size = solid.rest_m().size();
    x_ = solid.rest_m() + displacement_m * std::sqrt(3.0) * random_vector(size, 5);
    way_ = displacement_m * 10.0 * random_vector(size, 6);
    solid.evaluate(x_, activation, Solid::Tangent::Exact, at_);
  }

  double force_gap(double e) {
    const Eigen::VectorXd linear = at_.stiffness.lower().selfadjointView<Eigen::Lower>() * way_;
    return (force(x_ + e * way_) - at_.force_N - e * linear).norm();
  }
  double energy_gap(double e) const {
    return std::abs(solid_.energy_J(x_ + e * way_, activation_) - solid_.energy_J(x_, activation_) -
                    e * at_.force_N.dot(way_));
  }
  /// |a.(K b) - b.(K a)| with K b from the forces a little ahead and behind, over |K b| |a|.
  double asymmetry() {
    constexpr double kStep = 1e-4;
    const Eigen::VectorXd other = way_.norm() * random_vector(x_.size(), 7).normalized();
    const Eigen::VectorXd Kb = (force(x_ + kStep * way_) - force(x_ - kStep * way_)) / (2.0 * kStep);
    const Eigen::VectorXd Ka = (force(x_ + kStep * other) - force(x_ - kStep * other)) / (2.0 * kStep);
    return std::abs(other.dot(Kb) - way_.dot(Ka)) / (Kb.norm() * other.norm());
  }
  double stored_asymmetry() const {
    const Eigen::SparseMatrix<double>& lower = at_.stiffness.lower();
    double gap = 0.0;
    for (int node = 0; node < solid_.nodes(); ++node) {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < i; ++j) {
          const double difference = lower.coeff(3 * node + i, 3 * node + j) - lower.coeff(3 * node + j, 3 * node + i);
          gap = std::max(gap, std::abs(difference));
        }
      }
    }
    return gap / lower.coeffs().cwiseAbs().maxCoeff();
  }

 private:
  Eigen::VectorXd force(const Eigen::VectorXd& position_m) {
    solid_.evaluate(position_m, activation_, Solid::Tangent::None, there_);
    return there_.force_N;
  }

  const Solid& solid_;
  double activation_;
  Solid::Evaluation at_, there_;
  Eigen::VectorXd x_, way_;
};

/// The slope between neighbouring steps that is farthest from 2.
template <class Gap>
double worst_slope(Gap gap) {
  double worst = 2.0, last = gap(1e-2);
  for (const double e : {1e-3, 1e-4}) {
    const double now = gap(e), slope = std::log10(last / now);
    if (!(std::abs(slope - 2.0) < std::abs(worst - 2.0))) worst = slope;
    last = now;
  }
  return worst;
}

}  // namespace

Quantities patch_test(JsonObject& inputs) {
  const Box box = read_box(inputs);
  const Solid solid = shaken_solid(inputs, box);
  const Mat3 gradient = read_gradient(inputs);
  simulation::SolidLoads loads;
  for (int n = 0; n < solid.nodes(); ++n) {
    const Vec3 X = solid.rest_m().segment<3>(3 * n);
    if (on_surface(box, X)) clamp({n}, gradient * X - X, loads);
  }
  simulation::StaticOptions options;
  options.tolerance = 1e-13;
  const simulation::StaticResult result = simulation::solve_static(solid, loads, solid.rest_m(), options);
  double error_m = 0.0;
  for (int n = 0; n < solid.nodes(); ++n) {
    const Vec3 mapped = gradient * solid.rest_m().segment<3>(3 * n);
    error_m = std::max(error_m, (result.position_m.segment<3>(3 * n) - mapped).norm());
  }
  return {{"tets", static_cast<double>(solid.mesh().corners.size())},
          {"interior_error", if_converged(result, error_m / box.size_m.maxCoeff())},
          {"stress_spread", if_converged(result, largest_stress_difference(solid, result.position_m))}};
}

Quantities tangent_test(JsonObject& inputs) {
  const Box box = read_box(inputs);
  const Solid solid = shaken_solid(inputs, box);
  const double activation = inputs.number_or("activation", 0.0);
  TangentProbe probe(solid, activation, inputs.at("displacement_m").number_between(1e-9, 1.0));
  return {{"slope", worst_slope([&](double e) { return probe.force_gap(e); })},
          {"slope_of_energy", worst_slope([&](double e) { return probe.energy_gap(e); })},
          {"asymmetry", probe.asymmetry()},
          {"stored_asymmetry", probe.stored_asymmetry()}};
}

}  // namespace myotact::measure

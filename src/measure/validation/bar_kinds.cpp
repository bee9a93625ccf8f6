#include "measure/validation/bar_kinds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "measure/validation/solid_inputs.h"

namespace myotact::measure {
namespace {

using simulation::Solid;
using simulation::SolidLoads;

struct Tube {
  double inner_m = 0.0, outer_m = 0.0, length_m = 0.0;
};

/// The box's x runs across the wall, its y around a quarter.
geometry::TetMesh bend_to_quarter(const Tube& tube, const std::array<int, 3>& cells) {
  geometry::TetMesh mesh = make_box({Vec3::Ones(), cells});
  for (Vec3& x : mesh.nodes_m) {
    const double radius = tube.inner_m + x.x() * (tube.outer_m - tube.inner_m);
    const double angle = 0.5 * std::numbers::pi * x.y();
    x = {radius * std::cos(angle), radius * std::sin(angle), tube.length_m * x.z()};
  }
  return mesh;
}

/// Whether a node of the rest mesh is a corner at the inner radius.
bool is_inside(const Solid& solid, int node, double inner_m) {
  const Vec3 X = solid.rest_m().segment<3>(3 * node);
  return std::hypot(X.x(), X.y()) < inner_m * (1.0 + 1e-9);
}

/// Counter-clockwise seen from outside, so that positive pressure pushes into the tet.
simulation::PressureFace face_of(const geometry::TetMesh& mesh, std::size_t tet, std::size_t opposite) {
  constexpr std::array<std::array<std::size_t, 3>, 4> kFaces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  const auto& corners = kFaces[opposite];
  simulation::PressureFace face;
  for (std::size_t k = 0; k < 3; ++k) face.nodes[k] = mesh.corners[tet][corners[k]];
  face.quadratic = mesh.quadratic();
  for (std::size_t k = 0; face.quadratic && k < 3; ++k) {
    const int a = static_cast<int>(std::min(corners[k], corners[(k + 1) % 3]));
    const int b = static_cast<int>(std::max(corners[k], corners[(k + 1) % 3]));
    for (std::size_t e = 0; e < 6; ++e) {
      const auto& edge = geometry::kTetEdges[e];
      if (std::min(edge[0], edge[1]) == a && std::max(edge[0], edge[1]) == b) face.nodes[3 + k] = mesh.midsides[tet][e];
    }
  }
  return face;
}

std::vector<simulation::PressureFace> inner_faces(const Solid& solid, double inner_m, double pressure_Pa) {
  std::vector<simulation::PressureFace> faces;
  const geometry::TetMesh& mesh = solid.mesh();
  for (std::size_t t = 0; t < mesh.corners.size(); ++t) {
    for (std::size_t opposite = 0; opposite < 4; ++opposite) {
      simulation::PressureFace face = face_of(mesh, t, opposite);
      if (!std::all_of(face.nodes.begin(), face.nodes.begin() + 3,
                       [&](int node) { return is_inside(solid, node, inner_m); })) {
        continue;
      }
      face.pressure_Pa = pressure_Pa;
      faces.push_back(face);
    }
  }
  return faces;
}

double mean_inner_radius_m(const Solid& solid, double inner_m, const Eigen::VectorXd& position_m) {
  double sum = 0.0, count = 0.0;
  for (int n = 0; n < solid.nodes(); ++n) {
    if (!is_inside(solid, n, inner_m)) continue;
    sum += std::hypot(position_m[3 * n], position_m[3 * n + 1]) /
           std::hypot(solid.rest_m()[3 * n], solid.rest_m()[3 * n + 1]);
    count += 1.0;
  }
  return inner_m * sum / count;
}

/// p = mu (ln(a B / A b) + k/2 (1/a^2 - 1/b^2)), k = a^2 - A^2, b^2 = B^2 + k.
double closed_form_Pa(const Tube& tube, double shear_Pa, double radius_m) {
  const double k = radius_m * radius_m - tube.inner_m * tube.inner_m;
  const double outer_m = std::sqrt(tube.outer_m * tube.outer_m + k);
  return shear_Pa * (std::log(radius_m / tube.inner_m * tube.outer_m / outer_m) +
                     0.5 * k * (1.0 / (radius_m * radius_m) - 1.0 / (outer_m * outer_m)));
}

}  // namespace

Quantities clamped_bar(JsonObject& inputs) {
  const Box box = read_box(inputs);
  const ElementChoice element = read_element(inputs);
  const std::vector<simulation::Law> laws = read_laws(inputs);
  const double activation = inputs.at("activation").number_between(0.0, 1.0);
  const Solid solid(uniform_solid(make_box(box), element, laws), "bar");
  const std::vector<int> start = nodes_at(solid, 0, 0.0), end = nodes_at(solid, 0, box.size_m.x());
  Quantities quantities;
  for (const JsonValue& value : inputs.at("stretches").elements()) {
    const double stretch = value.number_between(0.3, 2.0);
    SolidLoads loads;
    clamp(start, Vec3::Zero(), loads);
    clamp(end, {(stretch - 1.0) * box.size_m.x(), 0.0, 0.0}, loads);
    loads.activation = activation;
    simulation::StaticOptions options;
    options.load_steps = 4;
    const simulation::StaticResult result = simulation::solve_static(solid, loads, solid.rest_m(), options);
    quantities[quantity_at("force_N", stretch)] = if_converged(result, support_force_N(result, end, 0));
  }
  return quantities;
}

Quantities thick_cylinder(JsonObject& inputs) {
  const Tube tube{inputs.at("inner_m").number_between(1e-6, 10.0), inputs.at("outer_m").number_between(1e-6, 10.0),
                  inputs.at("length_m").number_between(1e-6, 10.0)};
  const std::array<int, 3> cells = read_cells(inputs.at("cells"));
  const ElementChoice element = read_element(inputs);
  const std::vector<simulation::Law> laws = read_laws(inputs);
  const auto* law = std::get_if<simulation::NeoHookean>(&laws.front());
  if (law == nullptr) throw inputs.at("laws").error("must start with neo_hookean, whose closed form is compared");
  const Solid solid(uniform_solid(bend_to_quarter(tube, cells), element, laws), "tube");
  Quantities quantities;
  for (const JsonValue& value : inputs.at("pressures_Pa").elements()) {
    const double pressure_Pa = value.number_between(0.0, 1e9);
    SolidLoads loads;
    hold_symmetry_planes(solid, loads);
    hold(nodes_at(solid, 2, tube.length_m), 2, 0.0, loads);
    loads.pressure = inner_faces(solid, tube.inner_m, pressure_Pa);
    simulation::StaticOptions options;
    options.load_steps = 4;
    const simulation::StaticResult result = simulation::solve_static(solid, loads, solid.rest_m(), options);
    const double radius_m = mean_inner_radius_m(solid, tube.inner_m, result.position_m);
    quantities[quantity_at("radius_ratio", pressure_Pa)] = if_converged(result, radius_m / tube.inner_m);
    quantities[quantity_at("pressure_ratio", pressure_Pa)] =
        if_converged(result, closed_form_Pa(tube, law->shear_Pa, radius_m) / pressure_Pa);
  }
  return quantities;
}

}  // namespace myotact::measure

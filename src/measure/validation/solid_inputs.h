#pragma once

#include "measure/validation/box_mesh.h"
#include "measure/validation/kinds.h"
#include "simulation/solid/static_solve.h"

// What the kinds that deform a solid have in common: the keys they share and how supports are given.

namespace myotact::measure {

/// Key `laws`: a list of objects {law, ...}, names and numbers as in a case's materials (case_laws.h).
std::vector<simulation::Law> read_laws(JsonObject& inputs);

/// Gives the volume ratio to those laws that need it as a number; whether that changed any.
bool set_volume_ratio(double J, std::vector<simulation::Law>& laws);

/// An elastic law by name (neo_hookean, stable_neo_hookean, corotated, mooney_rivlin: without second term) of given
/// small-strain moduli.
simulation::Law elastic_law(const std::string& name, double young_Pa, double poisson);
const std::vector<std::string>& elastic_law_names();

/// Keys `element` (linear, patched, quadratic) and, for quadratic, `fluctuation_over_shear` (below 0: own volume term
/// at each point).
struct ElementChoice {
  simulation::ElementKind kind = simulation::ElementKind::Linear;
  double fluctuation_over_shear = 0.0;
};
ElementChoice read_element(JsonObject& inputs);

/// Key `name`: three numbers of cells.
std::array<int, 3> read_cells(const JsonValue& value);
/// Keys `size_m`, `cells` and `mirrored` (true).
Box read_box(JsonObject& inputs);

/// A solid of one material that fills a mesh, its fibres along one direction. For Patched the mesh must be a box's.
simulation::SolidInput uniform_solid(const geometry::TetMesh& mesh, const ElementChoice& element,
                                     const std::vector<simulation::Law>& laws, const Vec3& fibre = Vec3::UnitX());

/// Nodes that lie at `place_m` along an axis, at rest.
std::vector<int> nodes_at(const simulation::Solid& solid, int axis, double place_m);
/// Holds one component of nodes, or moves it.
void hold(const std::vector<int>& nodes, int component, double displacement_m, simulation::SolidLoads& loads);
void clamp(const std::vector<int>& nodes, const Vec3& displacement_m, simulation::SolidLoads& loads);
/// No face of a box that lies in a plane through the origin leaves it.
void hold_symmetry_planes(const simulation::Solid& solid, simulation::SolidLoads& loads);

/// Mean of a component of a vector field over nodes, weighted by their mass.
double mean_over(const simulation::Solid& solid, const std::vector<int>& nodes, int component,
                 const Eigen::VectorXd& field);
/// Spreads a force over nodes in proportion to their mass.
void spread_force(const simulation::Solid& solid, const std::vector<int>& nodes, const Vec3& force_N,
                  simulation::SolidLoads& loads);
/// Sum of a component of the supports' forces over nodes.
double support_force_N(const simulation::StaticResult& result, const std::vector<int>& nodes, int component);

/// NaN, which no check passes, for a solve that did not converge.
double if_converged(const simulation::StaticResult& result, double value);

}  // namespace myotact::measure

#include "measure/validation/solid_inputs.h"

#include <cmath>
#include <limits>

#include "measure/case_laws.h"

namespace myotact::measure {
namespace {

using namespace simulation;

Law read_one_law(const JsonValue& value) {
  JsonObject object(value);
  const Law law = read_law(object.at("law"), object);
  object.finish();
  return law;
}

}  // namespace

std::vector<Law> read_laws(JsonObject& inputs) {
  std::vector<Law> laws;
  const JsonValue list = inputs.at("laws");
  for (const JsonValue& element : list.elements()) laws.push_back(read_one_law(element));
  if (laws.empty()) throw list.error("is empty; a solid needs at least 1 law");
  return laws;
}

const std::vector<std::string>& elastic_law_names() {
  static const std::vector<std::string> names = {"neo_hookean", "stable_neo_hookean", "corotated", "mooney_rivlin"};
  return names;
}

Law elastic_law(const std::string& name, double young_Pa, double poisson) {
  const auto [shear, lambda] = lame_moduli(young_Pa, poisson);
  if (name == "neo_hookean") return NeoHookean{shear, lambda};
  if (name == "mooney_rivlin") return MooneyRivlin{0.5 * shear, 0.0, lambda + 2.0 / 3.0 * shear};
  if (name == "corotated") return Corotated{shear, lambda};
  return StableNeoHookean{shear, lambda};
}

ElementChoice read_element(JsonObject& inputs) {
  const std::string name = inputs.at("element").one_of({"linear", "patched", "quadratic"});
  if (name == "linear") return {ElementKind::Linear, 0.0};
  if (name == "patched") return {ElementKind::Patched, 0.0};
  return {ElementKind::Quadratic, inputs.at("fluctuation_over_shear").number_between(-1.0, 1e6)};
}

bool set_volume_ratio(double J, std::vector<Law>& laws) {
  bool moved = false;
  for (Law& law : laws) {
    auto* calcium = std::get_if<UnsplitFibres<CalciumTension>>(&law);
    if (calcium == nullptr) continue;
    moved = moved || std::abs(calcium->curve.volume_ratio - J) > 1e-12;
    calcium->curve.volume_ratio = J;
  }
  return moved;
}

std::array<int, 3> read_cells(const JsonValue& value) {
  constexpr int kMostCells = 200;
  std::array<int, 3> cells{};
  const std::vector<JsonValue> numbers = value.elements(3);
  for (std::size_t axis = 0; axis < 3; ++axis) cells[axis] = numbers[axis].integer_between(1, kMostCells);
  if (cells[0] * cells[1] * cells[2] > 50000) throw value.error("makes more than 50000 cells");
  return cells;
}

Box read_box(JsonObject& inputs) {
  const JsonValue size = inputs.at("size_m");
  Box box{size.vec3(), read_cells(inputs.at("cells")), inputs.boolean_or("mirrored", true)};
  if (!(box.size_m.minCoeff() > 0.0)) throw size.error("must be > 0 along every axis");
  return box;
}

SolidInput uniform_solid(const geometry::TetMesh& mesh, const ElementChoice& element, const std::vector<Law>& laws,
                         const Vec3& fibre) {
  SolidInput input;
  input.mesh = mesh;
  input.kind = element.kind;
  input.materials = {{laws, 1000.0, element.fluctuation_over_shear * shear_at_rest_Pa(laws.front())}};
  if (element.fluctuation_over_shear < 0.0) input.materials[0].fluctuation_Pa = -1.0;
  input.fibre.assign(mesh.corners.size(), fibre);
  if (element.kind == ElementKind::Patched) input.patch = cells_of_box(mesh);
  return input;
}

std::vector<int> nodes_at(const Solid& solid, int axis, double place_m) {
  const double size = solid.rest_m().cwiseAbs().maxCoeff();
  std::vector<int> nodes;
  for (int n = 0; n < solid.nodes(); ++n) {
    if (std::abs(solid.rest_m()[3 * n + axis] - place_m) < 1e-9 * size) nodes.push_back(n);
  }
  return nodes;
}

void hold(const std::vector<int>& nodes, int component, double displacement_m, SolidLoads& loads) {
  for (const int node : nodes) loads.held.push_back({node, component, displacement_m});
}

void clamp(const std::vector<int>& nodes, const Vec3& displacement_m, SolidLoads& loads) {
  for (int i = 0; i < 3; ++i) hold(nodes, i, displacement_m[i], loads);
}

void hold_symmetry_planes(const Solid& solid, SolidLoads& loads) {
  for (int axis = 0; axis < 3; ++axis) hold(nodes_at(solid, axis, 0.0), axis, 0.0, loads);
}

double mean_over(const Solid& solid, const std::vector<int>& nodes, int component, const Eigen::VectorXd& field) {
  double sum = 0.0, mass = 0.0;
  for (const int node : nodes) {
    sum += solid.mass_kg()[node] * field[3 * node + component];
    mass += solid.mass_kg()[node];
  }
  return sum / mass;
}

void spread_force(const Solid& solid, const std::vector<int>& nodes, const Vec3& force_N, SolidLoads& loads) {
  if (loads.nodal_force_N.size() == 0) loads.nodal_force_N = Eigen::VectorXd::Zero(solid.rest_m().size());
  double mass = 0.0;
  for (const int node : nodes) mass += solid.mass_kg()[node];
  for (const int node : nodes) loads.nodal_force_N.segment<3>(3 * node) += solid.mass_kg()[node] / mass * force_N;
}

double support_force_N(const StaticResult& result, const std::vector<int>& nodes, int component) {
  double sum = 0.0;
  for (const int node : nodes) sum += result.reaction_N[3 * node + component];
  return sum;
}

double if_converged(const StaticResult& result, double value) {
  return result.converged ? value : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace myotact::measure

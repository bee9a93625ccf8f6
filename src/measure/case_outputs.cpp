#include "measure/case_outputs.h"

#include <algorithm>
#include <cmath>

#include "measure/case_sets.h"

namespace myotact::measure {

namespace {

const std::vector<std::string> kQuantities = {"displacement", "reaction",     "stress",
                                              "stretch",      "volume_ratio", "energy"};
const std::vector<std::string> kReductions = {"mean", "sum", "max", "l2"};

template <class Enum>
Enum enum_of(const JsonValue& value, const std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), value.one_of(names));
  return static_cast<Enum>(found - names.begin());
}

bool of_nodes(Quantity quantity) {
  return quantity == Quantity::Displacement || quantity == Quantity::Reaction;
}

CaseOutput read_output(const JsonValue& value, const NodeSets& sets, const SolveCase& solve_case) {
  JsonObject fields(value);
  const JsonValue quantity = fields.at("quantity");
  CaseOutput output;
  output.quantity = enum_of<Quantity>(quantity, kQuantities);
  const bool is_total = output.quantity == Quantity::Reaction || output.quantity == Quantity::Energy;
  const auto reduce = fields.find("reduce");
  output.reduce = reduce ? enum_of<Reduction>(*reduce, kReductions) : is_total ? Reduction::Sum : Reduction::Mean;
  const bool is_energy = output.quantity == Quantity::Energy;
  const auto name = is_energy ? fields.find("set") : fields.at("set");
  fields.finish();
  const NodeSet& set = name ? require_set(*name, sets) : sets.at("all");
  if (is_energy && set.nodes.size() != solve_case.mesh.mesh.nodes_m.size()) {
    throw name->error("the energy is that of the whole body; leave \"set\" out");
  }
  if (is_energy && output.reduce != Reduction::Sum) throw reduce->error("the energy is one number; must be \"sum\"");
  if (output.quantity == Quantity::Stretch && solve_case.mesh.fibres.empty()) {
    throw quantity.error("the body has no fibres to stretch; give \"fibre\" or ask for volume_ratio");
  }
  output.name = (name ? name->string() : std::string("all")) + "." +
                kQuantities[static_cast<std::size_t>(output.quantity)] + "." +
                kReductions[static_cast<std::size_t>(output.reduce)];
  if (of_nodes(output.quantity)) output.nodes = set.nodes;
  if (!of_nodes(output.quantity) && !is_energy) output.tets = tets_of(set, solve_case.mesh.mesh);
  return output;
}

/// One entry of the list that is reduced.
struct Entry {
  std::vector<double> components;
  double size = 0.0;     // for max
  double squares = 0.0;  // for l2
  double weight = 1.0;   // for mean
};

Entry vector_entry(const Vec3& vector) {
  return {{vector.x(), vector.y(), vector.z()}, vector.norm(), vector.squaredNorm(), 1.0};
}

Entry stress_entry(const Mat3& s, double weight) {
  return {{s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(2, 0)}, von_mises_Pa(s), s.squaredNorm(), weight};
}

Entry scalar_entry(double value, double weight) {
  return {{value}, value, value * value, weight};
}

std::vector<Entry> entries_of(const CaseOutput& output, const SolvedState& state) {
  std::vector<Entry> entries;
  const bool is_displacement = output.quantity == Quantity::Displacement;
  for (const int node : output.nodes) {
    const auto n = static_cast<std::size_t>(node);
    entries.push_back(vector_entry(is_displacement ? state.displacement_m[n] : state.reaction_N[n]));
  }
  for (const int tet : output.tets) {
    const auto t = static_cast<std::size_t>(tet);
    const double weight = state.rest_volume_m3[t];
    if (output.quantity == Quantity::Stress) entries.push_back(stress_entry(state.cauchy_Pa[t], weight));
    if (output.quantity == Quantity::Stretch) entries.push_back(scalar_entry(state.stretch[t], weight));
    if (output.quantity == Quantity::VolumeRatio) entries.push_back(scalar_entry(state.volume_ratio[t], weight));
  }
  if (output.quantity == Quantity::Energy) entries.push_back(scalar_entry(state.energy_J, 1.0));
  return entries;
}

}  // namespace

const char* unit_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::Displacement:
      return "m";
    case Quantity::Reaction:
      return "N";
    case Quantity::Stress:
      return "Pa";
    case Quantity::Energy:
      return "J";
    default:
      return "1";
  }
}

std::vector<CaseOutput> read_outputs(const JsonValue& value, const NodeSets& sets, const SolveCase& solve_case) {
  std::vector<CaseOutput> outputs;
  for (const JsonValue& entry : value.elements()) outputs.push_back(read_output(entry, sets, solve_case));
  return outputs;
}

double von_mises_Pa(const Mat3& cauchy_Pa) {
  const Mat3 deviator = cauchy_Pa - cauchy_Pa.trace() / 3.0 * Mat3::Identity();
  return std::sqrt(1.5 * deviator.squaredNorm());
}

std::vector<double> evaluate_output(const CaseOutput& output, const SolvedState& state) {
  const std::vector<Entry> entries = entries_of(output, state);
  std::vector<double> sum(entries.front().components.size(), 0.0);
  double weights = 0.0;
  double squares = 0.0;
  double largest = entries.front().size;
  for (const Entry& entry : entries) {
    const double weight = output.reduce == Reduction::Mean ? entry.weight : 1.0;
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * entry.components[k];
    weights += weight;
    squares += entry.squares;
    largest = std::max(largest, entry.size);
  }
  if (output.reduce == Reduction::Max) return {largest};
  if (output.reduce == Reduction::L2) return {std::sqrt(squares)};
  if (output.reduce == Reduction::Mean) {
    for (double& component : sum) component /= weights;
  }
  return sum;
}

}  // namespace myotact::measure

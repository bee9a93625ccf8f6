#include "simulation/solid/solid.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/at.h"
#include "core/error.h"
#include "core/text.h"
#include "simulation/solid/law_batch.h"
#include "simulation/solid/patches.h"

namespace myotact::simulation {
namespace {

/// A mid-side node may lie this far off the middle of its edge, over the edge's length.
constexpr double kStraight = 1e-6;

Error refuse(const std::string& file, std::size_t tet, const std::string& problem) {
  return bad_data(file, "tet " + std::to_string(tet), problem);
}

void check_tet(const geometry::TetMesh& mesh, std::size_t t, const std::string& file) {
  const double volume = geometry::corner_volume_m3(mesh, t);
  if (!(volume > 0.0)) {
    throw refuse(file, t, "has volume " + to_text(volume) + " m^3; must be > 0. Swap two corners, or mesh again.");
  }
  if (!mesh.quadratic()) return;
  for (std::size_t e = 0; e < 6; ++e) {
    const Vec3& a = mesh.nodes_m[at(mesh.corners[t][at(geometry::kTetEdges[e][0])])];
    const Vec3& b = mesh.nodes_m[at(mesh.corners[t][at(geometry::kTetEdges[e][1])])];
    const Vec3& middle = mesh.nodes_m[at(mesh.midsides[t][e])];
    const double off = (middle - 0.5 * (a + b)).norm() / (b - a).norm();
    if (!(off <= kStraight)) {
      throw refuse(file, t,
                   "mid-side node " + std::to_string(mesh.midsides[t][e]) + " lies " + to_text(off) +
                       " of the edge's length off its middle; at most " + to_text(kStraight) +
                       ". Curved sides are not supported: move it to the middle.");
    }
  }
}

void check_fibre(const SolidInput& input, std::size_t t, int material, const std::string& file) {
  const std::vector<Law>& laws = input.materials[at(material)].laws;
  if (!std::any_of(laws.begin(), laws.end(), needs_fibre)) return;
  const double length = input.fibre.empty() ? 0.0 : input.fibre[t].norm();
  if (!(std::abs(length - 1.0) <= 1e-3)) {
    throw refuse(file, t,
                 "its material has fibres, but the fibre direction given has length " + to_text(length) +
                     "; must be 1. Give a unit vector a tet.");
  }
}

TetShape<double> shape_of(const SolidInput& input, const geometry::TetMesh& mesh, std::size_t t) {
  std::array<Vec3, 4> corners;
  for (std::size_t c = 0; c < 4; ++c) corners[c] = mesh.nodes_m[at(mesh.corners[t][c])];
  return make_tet_shape(corners, input.fibre.empty() ? Vec3::Zero() : Vec3(input.fibre[t].normalized()));
}

template <class Tet>
std::array<int, Tet::kNodes> nodes_of(const geometry::TetMesh& mesh, std::size_t t) {
  std::array<int, Tet::kNodes> nodes{};
  for (std::size_t a = 0; a < 4; ++a) nodes[a] = mesh.corners[t][a];
  if constexpr (Tet::kNodes == 10) {
    for (std::size_t e = 0; e < 6; ++e) nodes[4 + e] = mesh.midsides[t][e];
  }
  return nodes;
}

}  // namespace

Solid::Solid(const SolidInput& input, const std::string& file)
    : mesh_(input.mesh), kind_(input.kind), materials_(input.materials), material_(input.material) {
  if (mesh_.corners.empty()) throw bad_data(file, "", "holds no tets; at least 1 is needed");
  if (kind_ == ElementKind::Quadratic && !mesh_.quadratic()) mesh_ = geometry::make_quadratic(mesh_);
  if (kind_ != ElementKind::Quadratic) mesh_.midsides.clear();
  material_.resize(mesh_.corners.size(), 0);
  const auto node_count = static_cast<Eigen::Index>(mesh_.nodes_m.size());
  rest_m_.resize(3 * node_count);
  for (Eigen::Index n = 0; n < node_count; ++n) rest_m_.segment<3>(3 * n) = mesh_.nodes_m[static_cast<std::size_t>(n)];
  mass_kg_ = Eigen::VectorXd::Zero(node_count);
  for (std::size_t t = 0; t < mesh_.corners.size(); ++t) {
    check_tet(mesh_, t, file);
    check_fibre(input, t, material_[t], file);
    shapes_.push_back(shape_of(input, mesh_, t));
    add_mass(t);
  }
  if (kind_ == ElementKind::Patched) {
    make_patches(input.patch.empty() ? find_patches(mesh_, material_) : input.patch);
  }
  make_pattern();
  if (mesh_.quadratic()) {
    add_batches(quadratic_);
  } else {
    add_batches(linear_);
  }
}

/// Lumps by the diagonal of the consistent mass matrix, scaled to the tet's mass: row sums would give the corners of a
/// quadratic tet negative mass.
void Solid::add_mass(std::size_t t) {
  const double mass = materials_[at(material_[t])].density_kg_m3 * shapes_[t].volume_m3;
  for (const int node : mesh_.corners[t]) mass_kg_[node] += mass * (mesh_.quadratic() ? 1.0 / 36.0 : 0.25);
  if (!mesh_.quadratic()) return;
  for (const int node : mesh_.midsides[t]) mass_kg_[node] += mass * (4.0 / 27.0);
}

void Solid::make_patches(const std::vector<int>& patch_of) {
  patch_of_ = patch_of;
  patches_.resize(at(1 + *std::max_element(patch_of_.begin(), patch_of_.end())));
  for (std::size_t t = 0; t < mesh_.corners.size(); ++t) {
    Patch& patch = patches_[at(patch_of_[t])];
    patch.material = at(material_[t]);
    patch.volume_m3 += shapes_[t].volume_m3;
    patch.nodes.insert(patch.nodes.end(), mesh_.corners[t].begin(), mesh_.corners[t].end());
  }
  for (Patch& patch : patches_) {
    std::sort(patch.nodes.begin(), patch.nodes.end());
    patch.nodes.erase(std::unique(patch.nodes.begin(), patch.nodes.end()), patch.nodes.end());
  }
}

/// Nodes of a tet, or of a patch, are coupled pair by pair.
void Solid::make_pattern() {
  std::vector<std::vector<int>> cliques;
  for (std::size_t t = 0; t < mesh_.corners.size(); ++t) {
    std::vector<int>& clique = cliques.emplace_back(mesh_.corners[t].begin(), mesh_.corners[t].end());
    if (mesh_.quadratic()) clique.insert(clique.end(), mesh_.midsides[t].begin(), mesh_.midsides[t].end());
  }
  for (const Patch& patch : patches_) cliques.push_back(patch.nodes);
  pattern_ = BlockMatrix(nodes(), cliques);
  for (Patch& patch : patches_) patch.slots = pair_slots(pattern_, patch.nodes);
}

template <class Tet>
void Solid::add_batches(std::vector<TetBatch<Tet>>& batches) {
  for (std::size_t material = 0; material < materials_.size(); ++material) {
    for (std::size_t t = 0; t < shapes_.size(); ++t) {
      if (at(material_[t]) != material) continue;
      if (batches.empty() || batches.back().material != material || batches.back().count == kBatch) {
        batches.emplace_back();
        batches.back().material = material;
      }
      TetBatch<Tet>& batch = batches.back();
      const std::size_t lane = at(batch.count++);
      const std::array<int, Tet::kNodes> nodes = nodes_of<Tet>(mesh_, t);
      set_lane(batch, lane, static_cast<int>(t), shapes_[t], nodes);
      set_slots<Tet>(pattern_, nodes, lane, batch.slots);
    }
  }
}

double Solid::rest_volume_m3(std::size_t tet) const {
  return shapes_[tet].volume_m3;
}

Solid::Evaluation Solid::make_evaluation() const {
  Evaluation out;
  out.force_N = Eigen::VectorXd::Zero(rest_m_.size());
  out.stiffness = pattern_;
  return out;
}

std::vector<Point<double>> Solid::points_of(std::size_t tet, const Eigen::VectorXd& position_m) const {
  const auto deformed = [&]<class Tet>(std::type_identity<Tet>) {
    TetNodeVectors<double, Tet> position;
    const auto nodes = nodes_of<Tet>(mesh_, tet);
    for (std::size_t a = 0; a < Tet::kNodes; ++a) {
      for (std::size_t i = 0; i < 3; ++i) position[a][i] = position_m[3 * nodes[a] + static_cast<int>(i)];
    }
    std::array<Point<double>, Tet::kPoints> points;
    deform_tet<Tet>(shapes_[tet], position, points);
    return std::vector<Point<double>>(points.begin(), points.end());
  };
  return mesh_.quadratic() ? deformed(std::type_identity<QuadraticTet>{}) : deformed(std::type_identity<LinearTet>{});
}

double Solid::energy_J(const Eigen::VectorXd& position_m, double activation) const {
  double energy = 0.0;
  std::vector<double> patch_volume_m3(patches_.size(), 0.0);
  for (std::size_t t = 0; t < shapes_.size(); ++t) {
    const SolidMaterial& material = materials_[at(material_[t])];
    const std::vector<Point<double>> points = points_of(t, position_m);
    const double weight = shapes_[t].volume_m3 / static_cast<double>(points.size());
    double mean_J = 0.0;
    for (const Point<double>& point : points) mean_J += point.J / static_cast<double>(points.size());
    const bool averaged = mesh_.quadratic() && material.fluctuation_Pa >= 0.0;
    for (const Point<double>& point : points) {
      energy += weight * shape_energy_Pa(material.laws, point, activation);
      if (averaged) {
        const MeanVolume<double> mean{mean_J, volume_term_at(material.laws, mean_J), material.fluctuation_Pa};
        energy += weight * point_volume(mean, point.J).energy_Pa;
      }
      if (!averaged && patches_.empty()) energy += weight * volume_energy_Pa(material.laws, point.J);
    }
    if (averaged) energy += shapes_[t].volume_m3 * volume_energy_Pa(material.laws, mean_J);
    if (!patches_.empty()) patch_volume_m3[at(patch_of_[t])] += shapes_[t].volume_m3 * mean_J;
  }
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    const Patch& patch = patches_[p];
    energy += patch.volume_m3 * volume_energy_Pa(materials_[patch.material].laws, patch_volume_m3[p] / patch.volume_m3);
  }
  return energy;
}

Solid::TetState Solid::state_of(std::size_t tet, const Eigen::VectorXd& position_m, double activation) const {
  const SolidMaterial& material = materials_[at(material_[tet])];
  const std::vector<Point<double>> points = points_of(tet, position_m);
  const double share = 1.0 / static_cast<double>(points.size());
  TetState state;
  state.J = 0.0;
  state.fibre_stretch = 0.0;
  for (const Point<double>& point : points) {
    state.J += share * point.J;
    state.fibre_stretch += share * std::sqrt(point.I4);
  }
  const bool averaged = mesh_.quadratic() && material.fluctuation_Pa >= 0.0;
  for (Point<double> point : points) {
    Response<double> response = respond_at(material.laws, point, activation);
    if (averaged) {  // its volume term is that of the mean
      const VolumeTerm<double> here = volume_term_at(material.laws, point.J);
      const MeanVolume<double> mean{state.J, volume_term_at(material.laws, state.J), material.fluctuation_Pa};
      const double change = mean.term.slope_Pa + point_volume(mean, point.J).slope_Pa - here.slope_Pa;
      for (std::size_t k = 0; k < 9; ++k) response.P[k] += change * point.cofactor[k];
    }
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        double sum = 0.0;
        for (std::size_t A = 0; A < 3; ++A) sum += response.P[3 * i + A] * point.F[3 * j + A];
        state.cauchy_Pa(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) += share * sum / point.J;
      }
    }
  }
  return state;
}

}  // namespace myotact::simulation

#include "exchange/febio_limb.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/at.h"
#include "core/text.h"
#include "simulation/muscle/tissue_material.h"
#include "simulation/tissue_snapshot.h"

namespace myotact::exchange {

namespace {

using simulation::TissueMechanics;

/// Peak stresses that differ by less become one material.
constexpr double kAlike = 0.02;
constexpr int kLimbLoadSteps = 10;

class LimbCase {
 public:
  LimbCase(const scene::Scene& scene, const simulation::Simulation& simulation)
      : scene_(scene), simulation_(simulation) {
    out_.solve_case.name = scene.name;
    out_.solve_case.element = measure::Element::T10;
    out_.solve_case.load_steps = kLimbLoadSteps;
    out_.solve_case.loads.gravity_m_s2 = scene.settings.gravity_m_s2;
    out_.notes.emplace_back(
        "Muscles at a pose, loaded from the file pose. In Myotact a muscle's active force goes by the mean length of "
        "its "
        "fibres; here each point goes by its own. Contact, fascia and the damping of the fibres are left out; tendons "
        "are "
        "soft sheaths, and what their strings pull with now are nodal forces.");
    out_.notes.push_back(fmt::format("Peak stresses of the fibres are in steps of {} %.", to_text(100.0 * kAlike)));
  }

  void add(int muscle) {
    const anatomy::Muscle& anatomy = scene_.specimen.muscles[at(muscle)];
    const TissueMechanics mechanics = simulation_.mechanics(muscle);
    add_nodes(mechanics);
    add_tets(anatomy, mechanics);
    measure::SolveCase& out = out_.solve_case;
    out.loads.activation = std::max(out.loads.activation, mechanics.activation);
    if (mechanics.rest_length != mechanics.passive_length) {
      out_.notes.push_back(fmt::format("{}: passive force is taken at the active fibres' length, {} instead of {}.",
                                       anatomy.key, to_text(mechanics.rest_length), to_text(mechanics.passive_length)));
    }
    first_node_ += static_cast<int>(mechanics.rest.nodes_m.size());
  }

  FebioLimb finish() {
    measure::SolveCase& out = out_.solve_case;
    out.mesh.regions = out.material_of_tet;
    out.loads.nodal_force_N =
        Eigen::Map<const Eigen::VectorXd>(forces_N_.data(), static_cast<Eigen::Index>(forces_N_.size()));
    out.mesh.node_of_file.resize(out.mesh.mesh.nodes_m.size());
    for (std::size_t n = 0; n < out.mesh.node_of_file.size(); ++n) out.mesh.node_of_file[n] = static_cast<int>(n);
    return std::move(out_);
  }

 private:
  void add_nodes(const TissueMechanics& mechanics) {
    measure::SolveCase& out = out_.solve_case;
    for (std::size_t n = 0; n < mechanics.rest.nodes_m.size(); ++n) {
      const Vec3& rest_m = mechanics.rest.nodes_m[n];
      out.mesh.mesh.nodes_m.push_back(rest_m);
      const int body = mechanics.body[n];
      const Vec3& pull_N = mechanics.string_N[n];
      forces_N_.insert(forces_N_.end(), {pull_N.x(), pull_N.y(), pull_N.z()});
      if (body < 0) continue;
      const Vec3 moved_m = simulation_.body_pose(body) * rest_m - rest_m;
      for (int k = 0; k < 3; ++k) out.loads.held.push_back({first_node_ + static_cast<int>(n), k, moved_m[k]});
    }
  }

  void add_tets(const anatomy::Muscle& anatomy, const TissueMechanics& mechanics) {
    geometry::TetMesh& mesh = out_.solve_case.mesh.mesh;
    std::map<int, int> materials;  // by the step of their peak stress
    for (std::size_t t = 0; t < mechanics.rest.corners.size(); ++t) {
      mesh.corners.push_back(mechanics.rest.corners[t]);
      mesh.midsides.push_back(mechanics.rest.midsides[t]);
      for (int& node : mesh.corners.back()) node += first_node_;
      for (int& node : mesh.midsides.back()) node += first_node_;
      out_.solve_case.mesh.fibres.push_back(anatomy.fibres[t].normalized());
      const double peak_Pa = mechanics.peak_Pa[t];
      constexpr int kSheath = -1'000'000;
      const int step = peak_Pa > 0.0 ? static_cast<int>(std::lround(std::log(peak_Pa) / std::log1p(kAlike))) : kSheath;
      const auto [place, is_new] = materials.emplace(step, static_cast<int>(out_.solve_case.materials.size()));
      if (is_new)
        add_material(mechanics, mechanics.sheath[t], step == kSheath ? 0.0 : std::exp(step * std::log1p(kAlike)));
      out_.solve_case.material_of_tet.push_back(place->second);
    }
  }

  void add_material(const TissueMechanics& mechanics, bool sheath, double peak_Pa) {
    const simulation::TissueMaterial& tissue = sheath ? simulation::kTendonSheath : simulation::kMuscleMatrix;
    measure::CaseMaterial material;
    material.laws.push_back(tissue.matrix);
    material.density_kg_m3 = tissue.density_kg_m3;
    if (peak_Pa > 0.0) {
      const double n = mechanics.activation > 0.0 ? mechanics.rest_length : mechanics.passive_length;
      material.laws.push_back(simulation::UnsplitFibres<simulation::MuscleFibre>{
          {peak_Pa, n, mechanics.gain, simulation::CurveSet::DeGrooteFregly2016}});
    }
    out_.solve_case.materials.push_back(std::move(material));
    out_.activations.push_back(mechanics.activation);
  }

  const scene::Scene& scene_;
  const simulation::Simulation& simulation_;
  FebioLimb out_;
  std::vector<double> forces_N_;
  int first_node_ = 0;
};

}  // namespace

FebioLimb febio_limb(const scene::Scene& scene, const simulation::Simulation& simulation,
                     const std::vector<int>& muscles) {
  LimbCase limb(scene, simulation);
  for (const int muscle : muscles) limb.add(muscle);
  return limb.finish();
}

}  // namespace myotact::exchange

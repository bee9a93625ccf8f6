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
constexpr double kAlike = 0.01;
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
        "fibres; here that mean is held as it is now, so that it is a straight line of each point's stretch. Contact, "
        "fascia and the damping of the fibres are left out; tendons are soft sheaths, and where their strings pull, "
        "the belly is held as it is now.");
    out_.notes.push_back(fmt::format("Peak stresses of the fibres are in steps of {} %.", to_text(100.0 * kAlike)));
  }

  void add(int muscle) {
    const anatomy::Muscle& anatomy = scene_.specimen.muscles[at(muscle)];
    const TissueMechanics mechanics = simulation_.mechanics(muscle);
    add_nodes(mechanics, simulation_.tissue(muscle).position_m);
    add_tets(anatomy, mechanics);
    measure::SolveCase& out = out_.solve_case;
    out.loads.activation = std::max(out.loads.activation, mechanics.activation);
    first_node_ += static_cast<int>(mechanics.rest.nodes_m.size());
  }

  FebioLimb finish() {
    measure::SolveCase& out = out_.solve_case;
    out.mesh.regions = out.material_of_tet;
    out.loads.nodal_force_N = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * out.mesh.mesh.nodes_m.size()));
    out.mesh.node_of_file.resize(out.mesh.mesh.nodes_m.size());
    for (std::size_t n = 0; n < out.mesh.node_of_file.size(); ++n) out.mesh.node_of_file[n] = static_cast<int>(n);
    return std::move(out_);
  }

 private:
  void add_nodes(const TissueMechanics& mechanics, const std::vector<Vec3>& now_m) {
    measure::SolveCase& out = out_.solve_case;
    for (std::size_t n = 0; n < mechanics.rest.nodes_m.size(); ++n) {
      const Vec3& rest_m = mechanics.rest.nodes_m[n];
      out.mesh.mesh.nodes_m.push_back(rest_m);
      const int body = mechanics.body[n];
      if (body < 0 && !mechanics.on_string[n]) continue;
      const Vec3 moved_m = (body >= 0 ? simulation_.body_pose(body) * rest_m : now_m[n]) - rest_m;
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
      material.laws.push_back(simulation::UnsplitFibres<simulation::PosedFibre>{
          {peak_Pa, mechanics.active, mechanics.active_slope, mechanics.passive_length, mechanics.gain}});
    }
    out_.solve_case.materials.push_back(std::move(material));
    out_.activations.push_back(mechanics.activation);
  }

  const scene::Scene& scene_;
  const simulation::Simulation& simulation_;
  FebioLimb out_;
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

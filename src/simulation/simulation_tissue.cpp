#include <array>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "core/at.h"
#include "simulation/curves/fibre_curves.h"
#include "simulation/element/muscle_batch.h"
#include "simulation/muscle/build_tissue.h"
#include "simulation/muscle/fibre_field.h"
#include "simulation/simulation_impl.h"
#include "simulation/tissue_snapshot.h"

// The tets of a muscle one by one, for files: what a step keeps of them batch by batch, computed again from the nodes.

namespace myotact::simulation {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

std::array<double, 9> rows_of(const Mat3& matrix) {
  std::array<double, 9> rows{};
  for (int k = 0; k < 9; ++k) rows[at(k)] = matrix(k / 3, k % 3);
  return rows;
}

/// Gradients of the four barycentric coordinates over the tet at rest, a column each.
Eigen::Matrix<double, 3, 4> gradients_of(const geometry::TetMesh& rest, std::size_t tet) {
  const auto corner = [&](std::size_t c) -> const Vec3& { return rest.nodes_m[at(rest.corners[tet][c])]; };
  Mat3 edges;
  for (int c = 0; c < 3; ++c) edges.col(c) = corner(at(c) + 1) - corner(0);
  const Mat3 inverse = edges.inverse();
  Eigen::Matrix<double, 3, 4> gradients;
  gradients.rightCols<3>() = inverse.transpose();
  gradients.col(0) = -gradients.rightCols<3>().rowwise().sum();
  return gradients;
}

/// Deformation gradients at the points of a tet.
template <class Tet>
std::array<Mat3, Tet::kPoints> deformations_of(const TissueSnapshot& now, std::size_t tet) {
  const Eigen::Matrix<double, 3, 4> gradients = gradients_of(now.rest, tet);
  std::array<Mat3, Tet::kPoints> F;
  for (std::size_t p = 0; p < Tet::kPoints; ++p) {
    Eigen::Matrix<double, 3, 4> slopes = Eigen::Matrix<double, 3, 4>::Zero();
    for (std::size_t a = 0; a < Tet::kNodes; ++a) {
      const int node = a < 4 ? now.rest.corners[tet][a] : now.rest.midsides[tet][a - 4];
      for (std::size_t m = 0; m < 4; ++m) {
        slopes.col(static_cast<Eigen::Index>(m)) += shape_slope<Tet>(a, m, p) * now.position_m[at(node)];
      }
    }
    F[p] = slopes * gradients.transpose();
  }
  return F;
}

/// Adds what follows from the shape alone.
template <class Tet>
void add_shape(const Vec3& fibre, std::size_t tet, TissueSnapshot& now) {
  const auto F = deformations_of<Tet>(now, tet);
  Vec3 along = Vec3::Zero();
  double stretch = 0.0, ratio = 0.0;
  for (const Mat3& point : F) {
    along += point * fibre;
    stretch += (point * fibre).norm() / static_cast<double>(Tet::kPoints);
    ratio += point.determinant() / static_cast<double>(Tet::kPoints);
  }
  now.fibre.push_back(along.norm() > 0.0 ? Vec3(along.normalized()) : along);
  now.stretch.push_back(stretch);
  now.volume_ratio.push_back(ratio);
}

/// Adds the stress of a finite element as its forces have it: the volume term on the tet's mean ratio.
void add_stress(const FibreInputs& inputs, const Vec3& fibre, std::size_t tet, TissueSnapshot& now) {
  const TissueElement& element = inputs.tissue.elements[tet];
  const TissueMaterial& material = element.sheath ? kTendonSheath : kMuscleMatrix;
  const double c_Pa = material.fluctuation_Pa + kActiveFluctuation * inputs.state.activation * element.peak_Pa;
  const double mean_J = now.volume_ratio[tet];
  const MeanVolume<double> volume{mean_J, material.matrix.volume<double>(mean_J), c_Pa};
  const auto F = deformations_of<QuadraticTet>(now, tet);
  Mat3 cauchy_Pa = Mat3::Zero();
  double fibre_Pa = 0.0;
  for (std::size_t p = 0; p < F.size(); ++p) {
    const Point<double> point = make_point<double>(rows_of(F[p]), {fibre.x(), fibre.y(), fibre.z()});
    Response<double> response;
    material.matrix.add<double>(point, 0.0, response);
    const double along_Pa = fibre_stress(inputs, tet, p).stress_Pa, length = std::sqrt(point.I4);
    Mat3 nominal_Pa;
    for (std::size_t k = 0; k < 9; ++k) {
      const double volume_Pa =
          (volume.term.slope_Pa + point_volume(volume, point.J, kMuscleFoldedJ).slope_Pa) * point.cofactor[k];
      const double fibres_Pa = length > 0.0 ? along_Pa * point.f[k / 3] / length * point.fibre[k % 3] : 0.0;
      nominal_Pa(static_cast<int>(k / 3), static_cast<int>(k % 3)) = response.P[k] + volume_Pa + fibres_Pa;
    }
    cauchy_Pa += nominal_Pa * F[p].transpose() / point.J / static_cast<double>(F.size());
    fibre_Pa += along_Pa / static_cast<double>(F.size());
  }
  now.cauchy_Pa.push_back(cauchy_Pa);
  now.fibre_Pa.push_back(fibre_Pa);
}

}  // namespace

TissueSnapshot Simulation::tissue(int muscle) const {
  const LimbMuscle& m = impl_->limb.muscles[at(muscle)];
  const std::vector<Vec3>& fibres = impl_->specimen.muscles[at(muscle)].fibres;
  TissueSnapshot now;
  now.rest = m.tissue.mesh;
  const bool moves = is_solved(m) && m.state.now.velocity_m_s.size() == m.state.now.position_m.size();
  for (int node = 0; node < static_cast<int>(now.rest.nodes_m.size()); ++node) {
    now.position_m.push_back(node_vector(m.state.now.position_m, node));
    now.velocity_m_s.push_back(moves ? node_vector(m.state.now.velocity_m_s, node) : Vec3(Vec3::Constant(kUnknown)));
  }
  const bool quadratic = now.rest.quadratic();
  for (std::size_t t = 0; t < now.rest.corners.size(); ++t) {
    if (quadratic) {
      add_shape<QuadraticTet>(fibres[t].normalized(), t, now);
    } else {
      add_shape<LinearTet>(fibres[t].normalized(), t, now);
    }
  }
  if (m.rigid || m.tissue.model != TissueModel::Fem) {
    now.fibre_Pa.assign(now.rest.corners.size(), kUnknown);
    now.cauchy_Pa.assign(now.rest.corners.size(), Mat3::Constant(kUnknown));
    return now;
  }
  const TissueLoad at_rest;
  const FibreInputs inputs = fibre_inputs(m.tissue, m.state, at_rest);
  for (std::size_t t = 0; t < now.rest.corners.size(); ++t) add_stress(inputs, fibres[t].normalized(), t, now);
  return now;
}

TissueMechanics Simulation::mechanics(int muscle) const {
  const LimbMuscle& m = impl_->limb.muscles[at(muscle)];
  const bool elements = !m.rigid && m.tissue.model == TissueModel::Fem;
  const MuscleTissue built = elements ? MuscleTissue{} : build_muscle_tissue(impl_->specimen, muscle);
  const MuscleTissue& tissue = elements ? m.tissue : built;
  TissueMechanics out;
  out.rest = tissue.mesh;
  out.body = tissue.body;
  out.on_string.assign(out.body.size(), false);
  const FibreMap& map = tissue.fibre_map;
  const double mean = elements ? mean_fibre_length(tissue, m.state.now.stretch)
                               : impl_->fibre_stretch(muscle, impl_->read_lines()[at(muscle)]);
  out.passive_length = map.passive_length(1.0);
  out.gain = map.gain;
  out.active = active_force_length(map.on_curve(mean)) + kEvenness * (map.length(1.0) - mean);
  out.active_slope = kEvenness * map.gain;
  out.activation = activation(muscle);
  for (const TissueElement& element : tissue.elements) {
    out.sheath.push_back(element.sheath);
    out.peak_Pa.push_back(tissue.fibre_map.scale * element.peak_Pa);
  }
  for (const TendonStrand& strand : tissue.strands) {
    for (const int node : strand.nodes) out.on_string[at(node)] = true;
  }
  return out;
}

}  // namespace myotact::simulation

#include "simulation/muscle/build_tissue.h"

#include <algorithm>
#include <cmath>

#include <Eigen/SparseCholesky>

#include "core/at.h"
#include "core/error.h"
#include "core/text.h"
#include "simulation/muscle/lay_springs.h"
#include "simulation/muscle/strand_layout.h"

namespace myotact::simulation {
namespace {

Error refuse(const anatomy::Muscle& muscle, const std::string& problem) {
  return bad_data("specimen", "muscle " + muscle.key, problem);
}

/// Whole path of the fibres through the belly, and the section of each tet. Sections that are not given are taken as
/// uniform: belly volume over the line's length.
struct BellyShape {
  double length_m = 0.0;
  std::vector<double> sections_m2;
};

bool is_belly(anatomy::TissueRegion region) {
  return region != anatomy::TissueRegion::Tendon;
}

BellyShape belly_shape(const anatomy::Muscle& muscle, const anatomy::MuscleLine& line) {
  BellyShape shape;
  shape.sections_m2 = muscle.sections_m2;
  const std::size_t tets = muscle.tets.corners.size();
  if (shape.sections_m2.empty()) {
    double volume = 0.0;
    for (std::size_t t = 0; t < tets; ++t) {
      if (is_belly(muscle.regions[t])) volume += geometry::corner_volume_m3(muscle.tets, t);
    }
    shape.sections_m2.assign(tets, volume / line_length_m(line));
  }
  for (std::size_t t = 0; t < tets; ++t) {
    if (!is_belly(muscle.regions[t])) continue;
    shape.length_m += geometry::corner_volume_m3(muscle.tets, t) / shape.sections_m2[t];
  }
  return shape;
}

void add_elements(const anatomy::Muscle& muscle, const BellyShape& shape, MuscleTissue& tissue) {
  for (std::size_t t = 0; t < muscle.tets.corners.size(); ++t) {
    const double volume = geometry::corner_volume_m3(muscle.tets, t);
    if (!(volume > 0.0)) {
      throw refuse(muscle, "tet " + std::to_string(t) + " has volume " + to_text(volume) +
                               " m^3; must be > 0. Run myotact-prepare on the surface again.");
    }
    TissueElement element;
    std::array<Vec3, 4> corners;
    for (std::size_t c = 0; c < 4; ++c) {
      element.nodes[c] = tissue.mesh.corners[t][c];
      corners[c] = tissue.mesh.nodes_m[at(element.nodes[c])];
    }
    if (tissue.mesh.quadratic()) {
      for (std::size_t e = 0; e < 6; ++e) element.nodes[4 + e] = tissue.mesh.midsides[t][e];
    } else {
      element.nodes.count = LinearTet::kNodes;
    }
    element.shape = make_tet_shape(corners, muscle.fibres[t].normalized());
    element.section_m2 = shape.sections_m2[t];
    element.sheath = !is_belly(muscle.regions[t]);
    if (!element.sheath) element.peak_Pa = muscle.peak_force_N * std::cos(muscle.pennation_rad) / element.section_m2;
    tissue.elements.push_back(element);
  }
}

/// Lumps by the diagonal of the consistent mass matrix, scaled to the element's mass: corners 1/36, mid-sides 4/27.
/// (Row sums would give the corners of a quadratic tet negative mass.) A linear tet's corners carry a quarter each.
void add_masses(MuscleTissue& tissue) {
  tissue.mass_kg.assign(tissue.mesh.nodes_m.size(), 0.0);
  for (const TissueElement& element : tissue.elements) {
    const TissueMaterial& material = element.sheath ? kTendonSheath : kMuscleMatrix;
    const double mass = material.density_kg_m3 * element.shape.volume_m3;
    const double corner = element.nodes.size() == LinearTet::kNodes ? 1.0 / 4.0 : 1.0 / 36.0;
    for (std::size_t a = 0; a < element.nodes.size(); ++a)
      tissue.mass_kg[at(element.nodes[a])] += mass * (a < 4 ? corner : 4.0 / 27.0);
  }
}

/// Corners as given; a mid-side node is clamped when both its corners are clamped to the same body.
void add_clamps(const anatomy::Muscle& muscle, const std::vector<std::array<int, 2>>& edges, MuscleTissue& tissue) {
  tissue.body = muscle.attachments;
  for (const auto& [a, b] : edges) {
    tissue.body.push_back(tissue.body[at(a)] == tissue.body[at(b)] ? tissue.body[at(a)] : -1);
  }
  for (int body : tissue.body) {
    tissue.free_index.push_back(body < 0 ? tissue.free_nodes++ : -1);
    const bool known = std::find(tissue.bodies.begin(), tissue.bodies.end(), body) != tissue.bodies.end();
    if (body >= 0 && !known) tissue.bodies.push_back(body);
  }
  std::sort(tissue.bodies.begin(), tissue.bodies.end());
  if (tissue.bodies.empty()) throw refuse(muscle, "no node is attached to a body; at least one must be");
  if (tissue.free_nodes == 0) throw refuse(muscle, "every node is attached to a body; nothing is left to simulate");
}

/// Elements of one material, eight at a time.
void add_batches(bool sheath, MuscleTissue& tissue) {
  bool open = false;  // the last batch takes more
  for (std::size_t t = 0; t < tissue.elements.size(); ++t) {
    const TissueElement& element = tissue.elements[t];
    if (element.sheath != sheath) continue;
    if (!open) tissue.batches.emplace_back().sheath = sheath;
    TissueBatch& batch = tissue.batches.back();
    const std::size_t lane = at(batch.tets.count++);
    set_lane(batch.tets, lane, static_cast<int>(t), element.shape, element.nodes.node);
    batch.peak_Pa.lane[lane] = element.peak_Pa;
    set_slots<QuadraticTet>(tissue.pattern, free_nodes(tissue, element.nodes.node), lane, batch.tets.slots);
    open = batch.tets.count < kBatch;
  }
}

/// Pattern of the matrix of free nodes: nodes of one element, and the border nodes of one strand.
void add_pattern(MuscleTissue& tissue) {
  std::vector<std::vector<int>> cliques;
  const auto add = [&](const auto& nodes) {
    std::vector<int> clique;
    for (int node : nodes) clique.push_back(tissue.free_index[at(node)]);
    cliques.push_back(clique);
  };
  for (const TissueElement& element : tissue.elements) add(element.nodes);
  for (const TendonStrand& strand : tissue.strands) add(strand.nodes);
  tissue.pattern = BlockMatrix(tissue.free_nodes, cliques);
  for (TissueElement& element : tissue.elements) {
    element.clamped = std::any_of(element.nodes.begin(), element.nodes.end(),
                                  [&](int node) { return tissue.free_index[at(node)] < 0; });
  }
  if (tissue.model == TissueModel::MassSpring) {
    tissue.springs = lay_springs(tissue);
    return;
  }
  add_batches(false, tissue);
  add_batches(true, tissue);
}

/// Shares of the bodies' motions: harmonic on the graph of the mesh, 1 where a body clamps.
void add_blend(MuscleTissue& tissue) {
  const auto nodes = static_cast<Eigen::Index>(tissue.body.size());
  tissue.blend = Eigen::MatrixXd::Zero(nodes, static_cast<Eigen::Index>(tissue.bodies.size()));
  for (Eigen::Index k = 0; k < tissue.blend.cols(); ++k) {
    for (Eigen::Index i = 0; i < nodes; ++i) {
      tissue.blend(i, k) = tissue.body[static_cast<std::size_t>(i)] == tissue.bodies[static_cast<std::size_t>(k)];
    }
  }
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(tissue.free_nodes, tissue.blend.cols());
  for (const TissueElement& element : tissue.elements) {
    for (int a : element.nodes) {
      for (int b : element.nodes) {
        const int fa = tissue.free_index[at(a)], fb = tissue.free_index[at(b)];
        if (fa < 0 || a == b) continue;
        entries.emplace_back(fa, fa, 1.0);
        if (fb >= 0) entries.emplace_back(fa, fb, -1.0);
        if (fb < 0) right.row(fa) += tissue.blend.row(b);
      }
    }
  }
  Eigen::SparseMatrix<double> laplacian(tissue.free_nodes, tissue.free_nodes);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  // A part of the mesh that no body clamps would leave the matrix singular; a whisper of the unit matrix does not.
  for (int i = 0; i < tissue.free_nodes; ++i) laplacian.coeffRef(i, i) += 1e-9;
  const Eigen::MatrixXd solution = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(laplacian).solve(right);
  for (Eigen::Index i = 0; i < nodes; ++i) {
    const int f = tissue.free_index[static_cast<std::size_t>(i)];
    if (f >= 0) tissue.blend.row(i) = solution.row(f);
    const double sum = tissue.blend.row(i).sum();
    if (sum > 0.0) tissue.blend.row(i) /= sum;
    if (!(sum > 0.0)) tissue.blend(i, 0) = 1.0;
  }
}

/// Where one body holds both ends, as that of a muscle alone, the nodes nearer to the insertion: else the pulls of both
/// ends would cancel, and the muscle would seem to have no force.
void find_insertion_nodes(const anatomy::LinePoint& origin, MuscleTissue& tissue) {
  const bool one_body = origin.body == tissue.insertion_body;
  for (int node = 0; node < static_cast<int>(tissue.body.size()); ++node) {
    if (tissue.body[at(node)] != tissue.insertion_body) continue;
    const Vec3& rest_m = tissue.mesh.nodes_m[at(node)];
    const bool nearer_to_origin =
        (rest_m - origin.position_m).squaredNorm() < (rest_m - tissue.insertion_rest_m).squaredNorm();
    if (!one_body || !nearer_to_origin) tissue.insertion_nodes.push_back(node);
  }
}

}  // namespace

MuscleTissue build_muscle_tissue(const anatomy::Specimen& specimen, int index, TissueModel model) {
  const anatomy::Muscle& muscle = specimen.muscles[at(index)];
  if (muscle.tets.corners.empty()) throw refuse(muscle, "has no tets; at least 1 is needed");
  const auto found = std::find_if(specimen.lines.begin(), specimen.lines.end(),
                                  [&](const anatomy::MuscleLine& line) { return line.muscle == index; });
  if (found == specimen.lines.end() || found->points.size() < 2) {
    throw refuse(muscle, "has no muscle line of 2 or more points");
  }
  std::vector<std::array<int, 2>> edges;
  MuscleTissue tissue;
  tissue.model = model;
  tissue.mesh = model == TissueModel::MassSpring ? muscle.tets : geometry::make_quadratic(muscle.tets, &edges);
  const BellyShape shape = belly_shape(muscle, *found);
  tissue.fibre_map = {muscle.rest_stretch, shape.length_m / (muscle.optimal_fibre_m * std::cos(muscle.pennation_rad)),
                      0.0, 1.0};
  add_elements(muscle, shape, tissue);
  add_masses(tissue);
  add_clamps(muscle, edges, tissue);
  Skeleton skeleton(specimen);
  tissue.strands = lay_strands(muscle, *found, tissue, skeleton);
  add_pattern(tissue);
  add_blend(tissue);
  const anatomy::LinePoint& last = found->points.back();
  const anatomy::LinePoint& before = found->points[found->points.size() - 2];
  tissue.insertion_body = last.body;
  tissue.insertion_rest_m = last.position_m;
  find_insertion_nodes(found->points.front(), tissue);
  tissue.before_insertion_body = before.body;
  tissue.before_insertion_rest_m = before.position_m;
  if (const auto* wrap = anatomy::wrap_after(*found, found->points.size() - 2)) tissue.insertion_wrap = *wrap;
  return tissue;
}

}  // namespace myotact::simulation

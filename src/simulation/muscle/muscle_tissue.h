#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "anatomy/specimen.h"
#include "geometry/tet_mesh.h"
#include "simulation/contact/bone_contact.h"
#include "simulation/linear/block_matrix.h"
#include "simulation/muscle/spring_net.h"
#include "simulation/muscle/tendon_strand.h"
#include "simulation/muscle/tissue_material.h"
#include "simulation/muscle/tissue_model.h"

namespace myotact::simulation {

/// Of a finite-element muscle's quadratic tets; no tet has more.
inline constexpr std::size_t kTetNodes = QuadraticTet::kNodes;
inline constexpr std::size_t kTetPoints = QuadraticTet::kPoints;

/// Nodes of a tet: 4 of a linear one, 10 of a quadratic one; the corners come first.
struct TetNodeList {
  std::array<int, kTetNodes> node{};  // of the muscle's mesh
  std::size_t count = kTetNodes;      // in use

  /// The list as a range.
  std::size_t size() const { return count; }
  const int* begin() const { return node.data(); }
  const int* end() const { return node.data() + count; }
  int operator[](std::size_t a) const { return node[a]; }
  int& operator[](std::size_t a) { return node[a]; }
};

/// One tet of a muscle's mesh, as it is at rest.
struct TissueElement {
  TetNodeList nodes;        // of the muscle's mesh
  TetShape<double> shape;   // fibre: unit, from origin to insertion
  double section_m2 = 0.0;  // of the muscle here, along the fibres
  double peak_Pa = 0.0;     // nominal fibre stress at full activation and optimal length; 0: no fibres (sheath)
  bool sheath = false;      // of tendon tets; else belly
  bool clamped = false;     // some of its nodes are

  /// Integration points, and the part of the tet's rest volume that each stands for.
  std::size_t points() const { return nodes.size() == LinearTet::kNodes ? LinearTet::kPoints : kTetPoints; }
  double point_volume_m3() const { return shape.volume_m3 / static_cast<double>(points()); }
};

/// Eight tets of one material.
struct TissueBatch {
  TetBatch<QuadraticTet> tets;  // slots in the matrix of free nodes
  Eight peak_Pa;                // of each tet's fibres
  bool sheath = false;          // all of them, or none
};

/// Normalised fibre length n = rest_stretch + offset + gain (stretch - 1), and the scale of the peak stress. Offset and
/// scale, and what the gain differs from belly length over (lo cos pennation), come from calibration.h.
struct FibreMap {
  double rest_stretch = 0.8;  // n at the file pose, without the offset
  double gain = 1.0;          // dn / d(stretch)
  double offset = 0.0;        // of n
  double scale = 1.0;         // of the peak stress
  double beyond = 1.0;        // how much of what n exceeds 1 by counts for active force, in (0, 1]

  /// n by which active force goes, and that by which passive force goes.
  double length(double stretch) const { return passive_length(stretch) + offset; }
  /// The offset compensates what active fibres shorten by against their soft ends; at rest they are as long as given.
  double passive_length(double stretch) const { return rest_stretch + gain * (stretch - 1.0); }
  /// Where on the force-length curve a muscle of that mean n is. An offset that is large would put the resting muscle
  /// beyond the curve's end, from where it could never begin to pull.
  double on_curve(double n) const { return n > 1.0 ? 1.0 + beyond * (n - 1.0) : n; }
  double on_curve_slope(double n) const { return n > 1.0 ? beyond : 1.0; }
};

/// A muscle as the solver sees it: everything that does not change while it moves. n nodes, of which some are clamped
/// to bodies and move exactly with them; the rest are free and numbered in the order of the nodes.
struct MuscleTissue {
  TissueModel model = TissueModel::Fem;  // Line and Rigid: only mesh and clamps are used
  geometry::TetMesh mesh;                // rest position; linear for a mass-spring muscle, else quadratic
  std::vector<int> body;                 // n: body that clamps the node, or -1
  std::vector<int> free_index;           // n: number among the free nodes, or -1
  int free_nodes = 0;                    // how many
  std::vector<double> mass_kg;           // n, lumped
  std::vector<TissueElement> elements;
  std::vector<TissueBatch> batches;      // of all elements: belly, then sheath; none of a mass-spring muscle
  std::vector<SpringBatch> springs;      // of a mass-spring muscle: all elements
  FibreMap fibre_map;                    // from stretch to normalised fibre length
  std::vector<TendonStrand> strands;     // at most one an end, the origin first
  std::vector<int> bodies;               // that clamp nodes
  Eigen::MatrixXd blend;                 // n x bodies: share of each body's motion in a smooth guess, rows sum to 1
  BlockMatrix pattern;                   // of the free nodes, zero
  BoneContact bone_contact;              // none unless the limb puts it there
  int insertion_body = -1;               // of the last point of the muscle's line
  Vec3 insertion_rest_m = Vec3::Zero();  // where the muscle's line ends, and the point before it
  std::vector<int> insertion_nodes;      // clamped to that body, at that end
  int before_insertion_body = -1;
  Vec3 before_insertion_rest_m = Vec3::Zero();
  std::optional<anatomy::LineWrap> insertion_wrap;  // the surface between the two
};

/// Numbers of an element's nodes among the free ones; -1 for the clamped.
template <std::size_t kNodes>
std::array<int, kNodes> free_nodes(const MuscleTissue& tissue, const std::array<int, kNodes>& nodes) {
  std::array<int, kNodes> free{};
  for (std::size_t a = 0; a < kNodes; ++a) free[a] = tissue.free_index[static_cast<std::size_t>(nodes[a])];
  return free;
}

}  // namespace myotact::simulation

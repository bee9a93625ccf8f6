#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "geometry/tet_mesh.h"
#include "simulation/element/tet_elements.h"
#include "simulation/linear/block_matrix.h"
#include "simulation/solid/law.h"

namespace myotact::simulation {

/// How a solid's tets carry it: linear; linear with the volume term on the mean volume ratio of a patch of neighbours
/// (F-bar in energy form, does not lock when nearly incompressible); quadratic with the volume term on the tet's mean
/// volume ratio and a small term that holds the points inside it together.
enum class ElementKind { Linear, Patched, Quadratic };

/// Laws add up: a matrix and its fibres, for example.
struct SolidMaterial {
  /// Their stresses and volume terms are summed.
  std::vector<Law> laws;
  double density_kg_m3 = 1000.0;
  /// c of 1/2 c (J - mean J)^2 inside a quadratic tet; negative: each point has its own volume term (no mean).
  double fluctuation_Pa = 0.0;
};

/// What a Solid is built from. Indices are not checked.
struct SolidInput {
  geometry::TetMesh mesh;  // linear, or quadratic with straight sides
  ElementKind kind = ElementKind::Quadratic;
  std::vector<SolidMaterial> materials;  // at least 1
  std::vector<int> material;             // of each tet; empty: all the first
  std::vector<Vec3> fibre;               // of each tet, unit; empty: none
  std::vector<int> patch;                // of each tet, for Patched, from 0; empty: found by clustering
};

/// A body of tets whose nodes are all unknowns. Built once; const functions may be called from several threads.
/// Positions and forces are in the frame of the mesh, 3 numbers a node.
class Solid {
 public:
  /// A linear mesh is made quadratic for Quadratic; mid-side nodes are ignored for the other kinds.
  /// Throws Error BadData naming `file` and the tet: no tet at all, not positive volume, curved side, missing or
  /// non-unit fibre where a law needs one.
  Solid(const SolidInput& input, const std::string& file);

  int nodes() const { return static_cast<int>(rest_m_.size() / 3); }  // mid-side nodes included
  const Eigen::VectorXd& rest_m() const { return rest_m_; }           // 3 numbers a node
  const Eigen::VectorXd& mass_kg() const { return mass_kg_; }         // lumped, one a node
  const BlockMatrix& pattern() const { return pattern_; }             // of all nodes, values zero
  const geometry::TetMesh& mesh() const { return mesh_; }             // at rest; of the order that `kind` asks for
  /// Volume of one tet at rest.
  double rest_volume_m3(std::size_t tet) const;

  /// What evaluate() finds in one place.
  struct Evaluation {
    Eigen::VectorXd force_N;     // slope of the energy at all nodes
    BlockMatrix stiffness;       // slope of the forces, when asked for
    double smallest_J = 1.0;     // over the integration points
    double force_scale_N = 0.0;  // size of the elements' forces, to compare a residual with
  };
  /// Zero, of the right size and pattern, for evaluate() to fill.
  Evaluation make_evaluation() const;

  /// Which slope of the forces is wanted: none, the true one, or a safe one for Newton's method.
  enum class Tangent { None, Exact, Definite };
  /// Forces, and the tangent if wanted, at positions x. Overwrites `out`, which make_evaluation() has sized; its
  /// stiffness stays for None. Definite: every point's tangent is projected, so that the stiffness
  /// is positive semi-definite for certain.
  void evaluate(const Eigen::VectorXd& position_m, double activation, Tangent tangent, Evaluation& out) const;
  /// Elastic energy [J]; slower than evaluate().
  double energy_J(const Eigen::VectorXd& position_m, double activation) const;

  /// State of one tet, mean over its points; Cauchy stress in the frame of the positions.
  struct TetState {
    Mat3 cauchy_Pa = Mat3::Zero();
    double J = 1.0;              // volume ratio
    double fibre_stretch = 1.0;  // 0 where the tet has no fibre
  };
  /// `activation` 0 .. 1. The volume term of a Patched solid is taken on the tet's own ratio here, not on its patch's.
  TetState state_of(std::size_t tet, const Eigen::VectorXd& position_m, double activation) const;

 private:
  void add_mass(std::size_t tet);
  void make_patches(const std::vector<int>& patch_of);
  void make_pattern();
  template <class Tet>
  void add_batches(std::vector<TetBatch<Tet>>& batches);
  template <class Tet>
  void evaluate_batches(const std::vector<TetBatch<Tet>>& batches, const Eigen::VectorXd& position_m, double activation,
                        Tangent tangent, Evaluation& out) const;
  void evaluate_patches(const Eigen::VectorXd& position_m, double activation, Tangent tangent, Evaluation& out) const;
  std::vector<double> patch_ratios(const Eigen::VectorXd& position_m, std::vector<PointBatch<LinearTet>>& points,
                                   Evaluation& out) const;
  void add_volume_slopes(const TetBatch<LinearTet>& batch, const PointBatch<LinearTet>& points,
                         std::vector<Eigen::VectorXd>& slopes_m2) const;
  std::vector<Point<double>> points_of(std::size_t tet, const Eigen::VectorXd& position_m) const;

  /// Neighbouring linear tets with one volume term.
  struct Patch {
    std::vector<int> nodes;
    std::size_t material = 0;
    double volume_m3 = 0.0;
    std::vector<PairSlot> slots;  // of the pairs a <= b of its nodes
  };

  geometry::TetMesh mesh_;
  ElementKind kind_;
  std::vector<SolidMaterial> materials_;
  std::vector<int> material_;  // of each tet
  std::vector<TetShape<double>> shapes_;
  Eigen::VectorXd rest_m_, mass_kg_;
  BlockMatrix pattern_;
  std::vector<TetBatch<LinearTet>> linear_;
  std::vector<TetBatch<QuadraticTet>> quadratic_;
  std::vector<int> patch_of_;  // of each tet
  std::vector<Patch> patches_;
};

}  // namespace myotact::simulation

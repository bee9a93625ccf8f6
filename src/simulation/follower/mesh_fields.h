#pragma once

#include <vector>

#include <Eigen/SparseCore>

#include "geometry/tet_mesh.h"

namespace myotact::simulation {

/// Linear elements over a mesh: of a quadratic one over the eight straight parts of each tet, so that all its nodes
/// count. For smooth fields over the nodes, one number a node.
struct MeshFields {
  Eigen::SparseMatrix<double> stiffness_m;  // of the gradient's square [m]
  Eigen::VectorXd volume_m3;                // that falls to each node
};

MeshFields make_mesh_fields(const geometry::TetMesh& mesh);

/// Smooths values over about `length_m`: minimises volume (f - values)^2 + length^2 |grad f|^2.
Eigen::VectorXd smoothed(const MeshFields& fields, const Eigen::VectorXd& values, double length_m);
/// Is `values` (one column a field) where `held`, and fades to 0 away from there over about `length_m`.
Eigen::MatrixXd faded(const MeshFields& fields, const std::vector<char>& held, const Eigen::MatrixXd& values,
                      double length_m);

}  // namespace myotact::simulation

#include "simulation/follower/mesh_fields.h"

#include <array>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>

#include "core/at.h"

namespace myotact::simulation {
namespace {

using Corners = std::array<int, 4>;

/// The straight parts of a tet: four at its corners, four in the octahedron between, about its diagonal 01 - 23.
std::vector<Corners> parts_of(const geometry::TetMesh& mesh, std::size_t t) {
  const auto& c = mesh.corners[t];
  if (!mesh.quadratic()) return {Corners{c[0], c[1], c[2], c[3]}};
  std::array<std::array<int, 4>, 4> middle{};  // of two corners
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [a, b] = geometry::kTetEdges[e];
    middle[at(a)][at(b)] = middle[at(b)][at(a)] = mesh.midsides[t][e];
  }
  const int m01 = middle[0][1], m02 = middle[0][2], m03 = middle[0][3];
  const int m12 = middle[1][2], m13 = middle[1][3], m23 = middle[2][3];
  return {Corners{c[0], m01, m02, m03}, Corners{m01, c[1], m12, m13}, Corners{m02, m12, c[2], m23},
          Corners{m03, m13, m23, c[3]}, Corners{m01, m23, m02, m03},  Corners{m01, m23, m03, m13},
          Corners{m01, m23, m13, m12},  Corners{m01, m23, m12, m02}};
}

struct Fields {
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd volume_m3;
};

void add_part(const geometry::TetMesh& mesh, const Corners& part, Fields& fields) {
  Mat3 edges;
  for (int i = 0; i < 3; ++i) edges.col(i) = mesh.nodes_m[at(part[at(i + 1)])] - mesh.nodes_m[at(part[0])];
  const double volume_m3 = std::abs(edges.determinant()) / 6.0;
  const Mat3 inverse = edges.inverse();
  if (!inverse.allFinite()) return;
  Eigen::Matrix<double, 4, 3> gradient;
  gradient.bottomRows<3>() = inverse;
  gradient.row(0) = -inverse.colwise().sum();
  for (int a = 0; a < 4; ++a) {
    fields.volume_m3[part[at(a)]] += 0.25 * volume_m3;
    for (int b = 0; b < 4; ++b) {
      fields.entries.emplace_back(part[at(a)], part[at(b)], volume_m3 * gradient.row(a).dot(gradient.row(b)));
    }
  }
}

}  // namespace

MeshFields make_mesh_fields(const geometry::TetMesh& mesh) {
  const auto nodes = static_cast<Eigen::Index>(mesh.nodes_m.size());
  Fields fields{{}, Eigen::VectorXd::Zero(nodes)};
  for (std::size_t t = 0; t < mesh.corners.size(); ++t) {
    for (const Corners& part : parts_of(mesh, t)) add_part(mesh, part, fields);
  }
  MeshFields made{Eigen::SparseMatrix<double>(nodes, nodes), fields.volume_m3};
  made.stiffness_m.setFromTriplets(fields.entries.begin(), fields.entries.end());
  // A node that no tet has would leave the matrices singular.
  const double least_m3 = 1e-6 * fields.volume_m3.sum() / static_cast<double>(nodes);
  made.volume_m3 = made.volume_m3.cwiseMax(least_m3);
  return made;
}

Eigen::VectorXd smoothed(const MeshFields& fields, const Eigen::VectorXd& values, double length_m) {
  Eigen::SparseMatrix<double> matrix = length_m * length_m * fields.stiffness_m;
  for (Eigen::Index i = 0; i < values.size(); ++i) matrix.coeffRef(i, i) += fields.volume_m3[i];
  return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(fields.volume_m3.cwiseProduct(values));
}

Eigen::MatrixXd faded(const MeshFields& fields, const std::vector<char>& held, const Eigen::MatrixXd& values,
                      double length_m) {
  constexpr double kHard = 1e6;  // against the mesh's own: held to six digits
  Eigen::SparseMatrix<double> matrix = length_m * length_m * fields.stiffness_m;
  const double hold_m3 = kHard * (matrix.diagonal().maxCoeff() + fields.volume_m3.maxCoeff());
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(values.rows(), values.cols());
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    matrix.coeffRef(i, i) += fields.volume_m3[i];
    if (!held[static_cast<std::size_t>(i)]) continue;
    matrix.coeffRef(i, i) += hold_m3;
    right.row(i) = hold_m3 * values.row(i);
  }
  return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right);
}

}  // namespace myotact::simulation

#include "prepare/architecture/fibre_field.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include "core/error.h"

namespace myotact::prepare {

namespace {

using geometry::TetMesh;
using geometry::TriangleMesh;

/// Gradients below this part of the median point anywhere: rounding and the pole of a small patch decide.
constexpr double kWeakGradient = 0.05;

/// Gradients of the four linear shape functions, constant in the tet [1/m].
std::array<Vec3, 4> shape_gradients(const TetMesh& tets, std::size_t t) {
  const auto& c = tets.corners[t];
  const Vec3& x0 = tets.nodes_m[static_cast<std::size_t>(c[0])];
  Mat3 edges;
  for (std::size_t k = 1; k < 4; ++k) {
    edges.row(static_cast<Eigen::Index>(k - 1)) = (tets.nodes_m[static_cast<std::size_t>(c[k])] - x0).transpose();
  }
  const Mat3 inverse = edges.inverse();
  std::array<Vec3, 4> gradients;
  gradients[0] = Vec3::Zero();
  for (std::size_t k = 1; k < 4; ++k) {
    gradients[k] = inverse.col(static_cast<Eigen::Index>(k - 1));
    gradients[0] -= gradients[k];
  }
  return gradients;
}

/// Adds `flux`, spread evenly over the patches, to the nodes' right-hand side.
void add_flux(const TriangleMesh& surface, const AttachmentPatches& patches, double flux, Eigen::VectorXd& rhs) {
  double whole_m2 = 0.0;
  for (const AttachmentPatch& patch : patches) whole_m2 += patch.area_m2;
  for (const AttachmentPatch& patch : patches) {
    for (const int t : patch.triangles) {
      const auto& c = surface.triangles[static_cast<std::size_t>(t)];
      const Vec3& a = surface.positions_m[static_cast<std::size_t>(c[0])];
      const double area_m2 = 0.5 * (surface.positions_m[static_cast<std::size_t>(c[1])] - a)
                                       .cross(surface.positions_m[static_cast<std::size_t>(c[2])] - a)
                                       .norm();
      for (const int v : c) rhs[v] += flux * area_m2 / whole_m2 / 3.0;
    }
  }
}

Vec3 centroid_m(const AttachmentPatches& patches) {
  Vec3 moment = Vec3::Zero();
  double whole_m2 = 0.0;
  for (const AttachmentPatch& patch : patches) {
    moment += patch.area_m2 * patch.centroid_m;
    whole_m2 += patch.area_m2;
  }
  return moment / whole_m2;
}

Eigen::SparseMatrix<double> laplace_matrix(const TetMesh& tets) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t t = 0; t < tets.corners.size(); ++t) {
    const auto gradients = shape_gradients(tets, t);
    const double volume_m3 = geometry::corner_volume_m3(tets, t);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        entries.emplace_back(tets.corners[t][i], tets.corners[t][j], volume_m3 * gradients[i].dot(gradients[j]));
      }
    }
  }
  // A potential is known up to a constant: a spring to zero at the first node fixes it. As the fluxes in and out are
  // equal, the spring carries none and changes no gradient. Its stiffness is that of the mesh.
  double trace_m = 0.0;
  for (const auto& entry : entries) trace_m += entry.row() == entry.col() ? entry.value() : 0.0;
  const auto nodes = static_cast<Eigen::Index>(tets.nodes_m.size());
  entries.emplace_back(0, 0, trace_m / static_cast<double>(nodes));
  Eigen::SparseMatrix<double> matrix(nodes, nodes);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

std::vector<std::vector<int>> face_neighbours(const TetMesh& tets) {
  std::map<std::array<int, 3>, int> open;
  std::vector<std::vector<int>> neighbours(tets.corners.size());
  for (std::size_t t = 0; t < tets.corners.size(); ++t) {
    for (std::size_t skip = 0; skip < 4; ++skip) {
      std::array<int, 3> face{};
      for (std::size_t k = 0, n = 0; k < 4; ++k) {
        if (k != skip) face[n++] = tets.corners[t][k];
      }
      std::sort(face.begin(), face.end());
      const auto [other, first] = open.try_emplace(face, static_cast<int>(t));
      if (first) continue;
      neighbours[t].push_back(other->second);
      neighbours[static_cast<std::size_t>(other->second)].push_back(static_cast<int>(t));
    }
  }
  return neighbours;
}

/// The line that the neighbours' directions agree on best, turned their way; zero when no neighbour is known.
Vec3 shared_direction(const std::vector<int>& neighbours, const std::vector<Vec3>& direction) {
  Mat3 lines = Mat3::Zero();
  Vec3 sum = Vec3::Zero();
  for (const int n : neighbours) {
    const Vec3& d = direction[static_cast<std::size_t>(n)];
    lines += d * d.transpose();
    sum += d;
  }
  if (lines.trace() == 0.0) return Vec3::Zero();
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(lines);
  const Vec3 line = solver.eigenvectors().col(2);
  return line.dot(sum) < 0.0 ? Vec3(-line) : line;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Directions of the trusted gradients, then layer by layer those of the others.
void fill_directions(const TetMesh& tets, const Vec3& axis, FibreField& field) {
  std::vector<double> norms;
  for (const Vec3& g : field.gradient) norms.push_back(g.norm());
  const double weak = kWeakGradient * median(norms);
  field.direction.assign(norms.size(), Vec3::Zero());
  std::vector<std::size_t> missing;
  for (std::size_t t = 0; t < norms.size(); ++t) {
    if (norms[t] > weak)
      field.direction[t] = field.gradient[t] / norms[t];
    else
      missing.push_back(t);
  }
  field.filled_tets = static_cast<int>(missing.size());
  const auto neighbours = face_neighbours(tets);
  while (!missing.empty()) {
    std::vector<std::size_t> left;
    std::vector<std::pair<std::size_t, Vec3>> found;
    for (const std::size_t t : missing) {
      const Vec3 direction = shared_direction(neighbours[t], field.direction);
      if (direction.isZero())
        left.push_back(t);
      else
        found.emplace_back(t, direction.normalized());
    }
    for (const auto& [t, direction] : found) field.direction[t] = direction;
    if (found.empty()) {  // no neighbour anywhere is known
      for (const std::size_t t : left) field.direction[t] = axis;
      return;
    }
    missing = std::move(left);
  }
}

}  // namespace

FibreField solve_fibres(const std::string& name, const TetMesh& tets, const TriangleMesh& surface,
                        const AttachmentPatches& origins, const AttachmentPatches& insertions) {
  Eigen::VectorXd flux = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(tets.nodes_m.size()));
  add_flux(surface, origins, -1.0, flux);
  add_flux(surface, insertions, 1.0, flux);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(laplace_matrix(tets));
  const Eigen::VectorXd potential = solver.solve(flux);
  if (solver.info() != Eigen::Success || !potential.allFinite()) {
    throw bad_data(name, "fibres", "the potential has no solution; the muscle must be one connected body");
  }
  FibreField field;
  field.potential.assign(potential.data(), potential.data() + potential.size());
  for (std::size_t t = 0; t < tets.corners.size(); ++t) {
    const auto gradients = shape_gradients(tets, t);
    Vec3 g = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k) g += potential[tets.corners[t][k]] * gradients[k];
    field.gradient.push_back(g);
  }
  const Vec3 axis = (centroid_m(insertions) - centroid_m(origins)).normalized();
  fill_directions(tets, axis, field);
  double sum = 0.0;
  for (std::size_t t = 0; t < tets.corners.size(); ++t) {
    sum += geometry::corner_volume_m3(tets, t) * std::acos(std::clamp(axis.dot(field.direction[t]), -1.0, 1.0));
  }
  field.mean_angle_to_axis_deg = sum / geometry::total_volume_m3(tets) * 180.0 / std::numbers::pi;
  return field;
}

}  // namespace myotact::prepare

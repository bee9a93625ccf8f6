#include "view/render/strand_coordinates.h"

#include <Eigen/Geometry>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include "core/at.h"
#include "view/look/posing.h"

namespace myotact::view {

namespace {

/// Of a place's own change, what is left along the fibres: strands are about thirty times as long as wide.
constexpr double kAlongShare = 0.03;
/// Holds what no triangle holds; far below the rest.
constexpr double kAnchor = 1e-6;
/// The pattern needs to be straight over some centimetres, not over the whole muscle: a few tens of vertices.
constexpr int kIterations = 60;
constexpr double kTolerance = 1e-3;

using Matrix = Eigen::SparseMatrix<double>;

/// Slopes of the three linear functions that are 1 at a corner, and the area.
struct Triangle {
  std::array<Vec3, 3> slopes;
  double area_m2 = 0.0;
};

Triangle triangle_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a);
  const double squared = normal.squaredNorm();
  if (!(squared > 1e-24)) return {{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}, 0.0};
  return {{normal.cross(c - b) / squared, normal.cross(a - c) / squared, normal.cross(b - a) / squared},
          0.5 * std::sqrt(squared)};
}

}  // namespace

std::vector<glm::vec3> strand_coordinates(const geometry::TriangleMesh& skin, const std::vector<Vec3>& fibres) {
  if (skin.positions_m.empty()) return {};
  const auto n = static_cast<Eigen::Index>(skin.positions_m.size());
  Eigen::Matrix<double, Eigen::Dynamic, 3> places(n, 3), wanted(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) places.row(i) = skin.positions_m[static_cast<std::size_t>(i)];
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(9 * skin.triangles.size() + skin.positions_m.size());
  for (Eigen::Index i = 0; i < n; ++i) entries.emplace_back(static_cast<int>(i), static_cast<int>(i), kAnchor);
  wanted = kAnchor * places;
  for (const auto& corners : skin.triangles) {
    const auto place = [&](std::size_t k) -> const Vec3& { return skin.positions_m[at(corners[k])]; };
    const Triangle triangle = triangle_of(place(0), place(1), place(2));
    if (!(triangle.area_m2 > 0.0)) continue;
    const Vec3 fibre = (fibres[at(corners[0])] + fibres[at(corners[1])] + fibres[at(corners[2])]) / 3.0;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        const double own = kAlongShare * triangle.area_m2 * triangle.slopes[i].dot(triangle.slopes[j]);
        const double along = triangle.area_m2 * triangle.slopes[i].dot(fibre) * triangle.slopes[j].dot(fibre);
        entries.emplace_back(corners[i], corners[j], own + along);
        wanted.row(corners[i]) += own * place(j).transpose();
      }
    }
  }
  Matrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper> solver;
  solver.setMaxIterations(kIterations);
  solver.setTolerance(kTolerance);
  solver.compute(matrix);
  std::vector<glm::vec3> coordinates(skin.positions_m.size());
  Eigen::Matrix<double, Eigen::Dynamic, 3> solved = places;
  for (int axis = 0; axis < 3; ++axis) {
    solved.col(axis) = solver.solveWithGuess(wanted.col(axis), places.col(axis));
  }
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    coordinates[i] = to_glm(Vec3(solved.row(static_cast<Eigen::Index>(i)).transpose()));
  }
  return coordinates;
}

}  // namespace myotact::view

#include "simulation/element/tet_elements.h"

#include <Eigen/LU>

namespace myotact::simulation {

TetShape<double> make_tet_shape(const std::array<Vec3, 4>& corners_m, const Vec3& fibre) {
  Mat3 edges;
  for (std::size_t k = 0; k < 3; ++k) edges.col(static_cast<Eigen::Index>(k)) = corners_m[k + 1] - corners_m[0];
  const Mat3 inverse = edges.inverse();
  TetShape<double> shape;
  for (std::size_t A = 0; A < 3; ++A) {
    for (std::size_t k = 0; k < 3; ++k) {
      shape.gradient_1_m[k + 1][A] = inverse(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(A));
    }
    shape.gradient_1_m[0][A] = -(shape.gradient_1_m[1][A] + shape.gradient_1_m[2][A] + shape.gradient_1_m[3][A]);
    shape.fibre[A] = fibre[static_cast<Eigen::Index>(A)];
  }
  shape.volume_m3 = edges.determinant() / 6.0;
  return shape;
}

}  // namespace myotact::simulation

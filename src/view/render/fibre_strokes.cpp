#include "view/render/fibre_strokes.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace myotact::view {

namespace {

constexpr double kHalfStroke_m = 2.2e-3;
constexpr double kAreaOfAStroke_m2 = 9e-6;
/// Fibres that leave the skin more steeply than this are not shown on it: sin of 45 degrees lies in the plane.
constexpr double kFlattest = 0.7;

Vec3 tet_middle_m(const geometry::TetMesh& mesh, std::size_t tet) {
  Vec3 sum = Vec3::Zero();
  for (const int node : mesh.corners[tet]) sum += mesh.nodes_m[static_cast<std::size_t>(node)];
  return 0.25 * sum;
}

std::size_t nearest_tet(const std::vector<Vec3>& middles_m, const Vec3& p) {
  const auto nearer = [&](const Vec3& a, const Vec3& b) { return (a - p).squaredNorm() < (b - p).squaredNorm(); };
  return static_cast<std::size_t>(std::min_element(middles_m.begin(), middles_m.end(), nearer) - middles_m.begin());
}

/// Of the point a + x, x in the plane of the triangle with edges ab and ac.
glm::vec3 shares_of(const Vec3& x, const Vec3& ab, const Vec3& ac) {
  const double bb = ab.dot(ab), bc = ab.dot(ac), cc = ac.dot(ac), det = bb * cc - bc * bc;
  const double b = (cc * ab.dot(x) - bc * ac.dot(x)) / det, c = (bb * ac.dot(x) - bc * ab.dot(x)) / det;
  return {1.0 - b - c, b, c};
}

/// Places in a triangle, one after the other, never on a lattice (R2 sequence of Roberts 2018, folded).
std::pair<double, double> place_in_triangle(int i) {
  double b = std::fmod(0.5 + 0.7548776662466927 * i, 1.0), c = std::fmod(0.5 + 0.5698402909980532 * i, 1.0);
  if (b + c > 1.0) {
    b = 1.0 - b;
    c = 1.0 - c;
  }
  return {b, c};
}

}  // namespace

std::vector<FibreStroke> fibre_strokes(const anatomy::Muscle& muscle) {
  std::vector<FibreStroke> strokes;
  if (muscle.fibres.empty()) return strokes;
  std::vector<Vec3> middles_m;
  for (std::size_t t = 0; t < muscle.tets.corners.size(); ++t) middles_m.push_back(tet_middle_m(muscle.tets, t));
  double owed = 0.0;  // strokes due to the triangles so far
  int made = 0;
  for (std::size_t t = 0; t < muscle.skin.triangles.size(); ++t) {
    const auto& [ia, ib, ic] = muscle.skin.triangles[t];
    const auto at = [&](int i) { return muscle.skin.positions_m[static_cast<std::size_t>(i)]; };
    const Vec3 a = at(ia), ab = at(ib) - a, ac = at(ic) - a, normal = ab.cross(ac);
    owed += 0.5 * normal.norm() / kAreaOfAStroke_m2;
    for (; owed >= 1.0; owed -= 1.0) {
      const auto [b, c] = place_in_triangle(made++);
      const Vec3 from_a = b * ab + c * ac;
      const Vec3& fibre = muscle.fibres[nearest_tet(middles_m, a + from_a)];
      const Vec3 along = fibre - fibre.dot(normal) / normal.squaredNorm() * normal;
      if (along.norm() < kFlattest) continue;
      const Vec3 half = kHalfStroke_m * along.normalized();
      strokes.push_back({static_cast<int>(t), {shares_of(from_a - half, ab, ac), shares_of(from_a + half, ab, ac)}});
    }
  }
  return strokes;
}

}  // namespace myotact::view

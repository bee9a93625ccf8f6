#include "prepare/repair/fan_pull.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "prepare/surface/edge_table.h"

//  Seen along k, to which all triangles of a fan turn their backs, the fan is a landscape over the plane: what other
//  fans have in common with it lies either above it, outside, or below, inside. It moves the other way.
//
//        other fan                          . other fan
//           \ | /                          / \      .
//   outside  \|/                          '   '
//      ------ * ------    moves down:   ---.     .---
//   inside                                   ' * '

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

/// No farther than this part of the shortest edge: triangles there keep their shape.
constexpr double kPullOfEdge = 0.1;
/// A triangle that leans more than this against the way of its fan would be turned over by a move along it [cosine].
constexpr double kLeastCosine = 0.1;
/// Corrections of the direction; a fan of ten triangles needs about twenty.
constexpr int kCorrections = 100;

struct FanShape {
  std::vector<Vec3> normals;               // unit, one a triangle
  std::vector<std::pair<Vec3, Vec3>> rim;  // of each triangle, from the vertex
  Vec3 into = Vec3::Zero();                // unit: against all normals, as far as there is such a direction
  double least = -1.0;                     // smallest cosine between it and them turned round
  double area = 0.0;                       // doubled
  double shortest = std::numeric_limits<double>::infinity();
};

/// The direction with the largest smallest cosine, by steps towards what is worst (a perceptron).
void find_direction(FanShape& fan) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& n : fan.normals) sum -= n;
  if (sum.norm() < 1e-9) sum = -fan.normals.front();
  for (int i = 0; i < kCorrections; ++i) {
    const Vec3 direction = sum.normalized();
    const auto worst = std::max_element(fan.normals.begin(), fan.normals.end(), [&](const Vec3& a, const Vec3& b) {
      return a.dot(direction) < b.dot(direction);
    });
    const double least = -worst->dot(direction);
    if (least > fan.least) fan.least = least, fan.into = direction;
    sum -= *worst;
    if (sum.norm() < 1e-9) break;
  }
}

FanShape shape_of(const TriangleMesh& mesh, const std::vector<int>& corners) {
  FanShape fan;
  const Vec3 p = mesh.positions_m[at(tail_of(mesh, corners.front()))];
  for (const int c : corners) {
    const Vec3 a = mesh.positions_m[at(head_of(mesh, c))] - p;
    const Vec3 b = mesh.positions_m[at(head_of(mesh, next_corner(c)))] - p;
    fan.normals.push_back(a.cross(b).normalized());
    fan.rim.emplace_back(a, b);
    fan.area += a.cross(b).norm();
    fan.shortest = std::min({fan.shortest, a.norm(), b.norm()});
  }
  find_direction(fan);
  return fan;
}

/// Positive: the direction leads outside of the fan; negative: inside; 0: along it, or past all of its triangles.
double side_of(const FanShape& fan, const Vec3& direction) {
  for (std::size_t t = 0; t < fan.rim.size(); ++t) {
    const auto& [a, b] = fan.rim[t];
    // Within the wedge between both edges, seen along `into`; outward triangles run round it clockwise.
    const bool after_a = a.cross(direction).dot(fan.into) <= 0.0;
    const bool before_b = direction.cross(b).dot(fan.into) <= 0.0;
    const bool ahead = (a.normalized() + b.normalized()).dot(direction - direction.dot(fan.into) * fan.into) > 0.0;
    if (after_a && before_b && ahead) return fan.normals[t].dot(direction.normalized());
  }
  return 0.0;
}

/// Whether the other fans lie outside of this one, on the whole.
bool others_lie_outside(const std::vector<FanShape>& fans, std::size_t of) {
  double side = 0.0;
  for (std::size_t other = 0; other < fans.size(); ++other) {
    if (other == of) continue;
    for (const auto& [a, b] : fans[other].rim) side += side_of(fans[of], a.normalized() + b.normalized());
  }
  return side >= 0.0;
}

/// A fan that has no direction to move in; else the largest, which is rather the body than a speck on it.
std::size_t which_stays(const std::vector<FanShape>& fans) {
  const auto crooked = std::min_element(fans.begin(), fans.end(),
                                        [](const FanShape& a, const FanShape& b) { return a.least < b.least; });
  if (crooked->least < kLeastCosine) return static_cast<std::size_t>(crooked - fans.begin());
  const auto largest =
      std::max_element(fans.begin(), fans.end(), [](const FanShape& a, const FanShape& b) { return a.area < b.area; });
  return static_cast<std::size_t>(largest - fans.begin());
}

}  // namespace

std::vector<Vec3> pulled_apart(const TriangleMesh& mesh, const std::vector<std::vector<int>>& fans, double farthest) {
  std::vector<FanShape> shapes;
  for (const std::vector<int>& corners : fans) shapes.push_back(shape_of(mesh, corners));
  const std::size_t stays = which_stays(shapes);
  const Vec3 p = mesh.positions_m[at(tail_of(mesh, fans.front().front()))];
  std::vector<Vec3> places(fans.size(), p);
  for (std::size_t f = 0; f < fans.size(); ++f) {
    if (f == stays) continue;
    const double way = std::min(farthest, kPullOfEdge * shapes[f].shortest);
    places[f] += (others_lie_outside(shapes, f) ? way : -way) * shapes[f].into;
  }
  return places;
}

}  // namespace myotact::prepare

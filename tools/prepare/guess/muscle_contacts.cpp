#include "prepare/guess/muscle_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <Eigen/Eigenvalues>

#include "core/at.h"
#include "prepare/surface/edge_table.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

/// What counts as a muscle's tip, as a part of its length.
constexpr double kTip = 0.05;
/// A patch along more of the muscle than this is where both ends may be.
constexpr double kLongPatch = 0.5;
/// Ends nearer to each other than this part of the length are one end.
constexpr double kLeastApart = 1.0 / 3.0;
/// A muscle that moves something goes from bone to bone: worth this factor in distance.
constexpr double kOtherBone = 1.5;
/// Patches below this part of the muscle's surface are touches by chance: they count less, by the fourth root, so that
/// a thin tendon's end is still one.
constexpr double kFullArea = 3e-3;

Vec3 centre_of(const TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return (mesh.positions_m[at(a)] + mesh.positions_m[at(b)] + mesh.positions_m[at(c)]) / 3.0;
}

double area_of(const TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  const Vec3& p = mesh.positions_m[at(a)];
  return 0.5 * (mesh.positions_m[at(b)] - p).cross(mesh.positions_m[at(c)] - p).norm();
}

/// The bone that each triangle lies on, or -1: by its middle or a corner, whichever is nearest to one.
std::vector<int> bone_of_triangles(const TriangleMesh& muscle, const std::vector<BoneDistance>& bones, double reach_m) {
  std::vector<double> nearest_m(muscle.positions_m.size());
  std::vector<int> bone_of_vertex(muscle.positions_m.size(), -1);
  const auto nearest_bone = [&](const Vec3& p, double& distance_m) {
    int bone = -1;
    distance_m = reach_m;
    for (std::size_t b = 0; b < bones.size(); ++b) {
      const double here_m = bones[b].distance_m(p, distance_m);
      if (here_m <= reach_m && (bone < 0 || here_m < distance_m)) bone = static_cast<int>(b), distance_m = here_m;
    }
    return bone;
  };
  for (std::size_t v = 0; v < nearest_m.size(); ++v) {
    bone_of_vertex[v] = nearest_bone(muscle.positions_m[v], nearest_m[v]);
  }
  std::vector<int> bone_of(muscle.triangles.size(), -1);
  for (std::size_t t = 0; t < bone_of.size(); ++t) {
    double least_m = 0.0;
    bone_of[t] = nearest_bone(centre_of(muscle, t), least_m);
    for (const int v : muscle.triangles[t]) {
      if (bone_of_vertex[at(v)] < 0 || (bone_of[t] >= 0 && nearest_m[at(v)] >= least_m)) continue;
      bone_of[t] = bone_of_vertex[at(v)];
      least_m = nearest_m[at(v)];
    }
  }
  return bone_of;
}

/// Triangles on one bone that are joined by corners, by first triangle.
std::vector<std::vector<int>> patches_of(const TriangleMesh& muscle, const std::vector<int>& bone_of) {
  Groups groups(muscle.triangles.size());
  std::map<std::pair<int, int>, int> first_at;  // bone, vertex -> triangle
  for (std::size_t t = 0; t < bone_of.size(); ++t) {
    if (bone_of[t] < 0) continue;
    for (const int v : muscle.triangles[t]) {
      const auto [known, added] = first_at.try_emplace({bone_of[t], v}, static_cast<int>(t));
      if (!added) groups.join(known->second, static_cast<int>(t));
    }
  }
  std::map<int, std::vector<int>> by_group;
  for (std::size_t t = 0; t < bone_of.size(); ++t) {
    if (bone_of[t] >= 0) by_group[groups.group_of(static_cast<int>(t))].push_back(static_cast<int>(t));
  }
  std::vector<std::vector<int>> patches;
  for (auto& [group, triangles] : by_group) patches.push_back(std::move(triangles));
  return patches;
}

MuscleContact contact_of(const TriangleMesh& muscle, const std::vector<int>& triangles, int bone) {
  MuscleContact contact;
  contact.bone = bone;
  Vec3 middle = Vec3::Zero();
  for (const int t : triangles) {
    const double area = area_of(muscle, at(t));
    contact.area_m2 += area;
    middle += area * centre_of(muscle, at(t));
  }
  if (contact.area_m2 > 0.0) middle /= contact.area_m2;
  double nearest_m2 = std::numeric_limits<double>::infinity();
  for (const int t : triangles) {
    const Vec3 centre = centre_of(muscle, at(t));
    if ((centre - middle).squaredNorm() >= nearest_m2) continue;
    nearest_m2 = (centre - middle).squaredNorm();
    contact.centre_m = centre;
  }
  return contact;
}

}  // namespace

LongAxis long_axis(const TriangleMesh& surface) {
  Vec3 mean = Vec3::Zero();
  double area = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    mean += area_of(surface, t) * centre_of(surface, t);
    area += area_of(surface, t);
  }
  LongAxis axis;
  if (!surface.positions_m.empty()) axis.tips_m.fill(surface.positions_m.front());
  if (!(area > 0.0)) return axis;
  mean /= area;
  Mat3 spread = Mat3::Zero();
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Vec3 away = centre_of(surface, t) - mean;
    spread += area_of(surface, t) * away * away.transpose();
  }
  axis.direction = Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvectors().col(2).normalized();
  Eigen::Index largest = 0;
  axis.direction.cwiseAbs().maxCoeff(&largest);
  if (axis.direction[largest] < 0.0) axis.direction = -axis.direction;
  axis.lowest_m = std::numeric_limits<double>::infinity();
  axis.highest_m = -axis.lowest_m;
  for (const auto& triangle : surface.triangles) {
    for (const int v : triangle) {
      const double along_m = axis.direction.dot(surface.positions_m[at(v)]);
      axis.lowest_m = std::min(axis.lowest_m, along_m);
      axis.highest_m = std::max(axis.highest_m, along_m);
    }
  }
  for (const int end : {0, 1}) {
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (const Vec3& p : surface.positions_m) {
      const double along_m = axis.direction.dot(p);
      const double from_end_m = end == 0 ? along_m - axis.lowest_m : axis.highest_m - along_m;
      if (!(from_end_m <= kTip * axis.length_m())) continue;
      sum += p;
      ++count;
    }
    axis.tips_m[static_cast<std::size_t>(end)] = count > 0 ? Vec3(sum / count) : mean;
  }
  return axis;
}

BoneDistance::BoneDistance(const TriangleMesh& surface) : surface_(surface), tree_(surface) {
  for (const Vec3& p : surface.positions_m) box_.extend(p);
}

double BoneDistance::distance_m(const Vec3& p, double reach_m) const {
  if (box_.squaredExteriorDistance(p) > reach_m * reach_m) return std::numeric_limits<double>::infinity();
  return tree_.nearest(p, surface_.positions_m, reach_m).distance_m;
}

double BoneDistance::nearest_m(const Vec3& p, Vec3& place_m) const {
  const geometry::SurfacePlace place = tree_.nearest(p, surface_.positions_m);
  place_m = place.point.position_m;
  return place.distance_m;
}

std::vector<MuscleContact> find_contacts(const TriangleMesh& muscle, const LongAxis& axis,
                                         const std::vector<BoneDistance>& bones, double reach_m) {
  const std::vector<int> bone_of = bone_of_triangles(muscle, bones, reach_m);
  std::vector<MuscleContact> contacts;
  for (const std::vector<int>& patch : patches_of(muscle, bone_of)) {
    const int bone = bone_of[at(patch.front())];
    double lowest_m = std::numeric_limits<double>::infinity(), highest_m = -lowest_m;
    const auto along_m = [&](int t) { return axis.direction.dot(centre_of(muscle, at(t))); };
    for (const int t : patch) {
      lowest_m = std::min(lowest_m, along_m(t));
      highest_m = std::max(highest_m, along_m(t));
    }
    if (highest_m - lowest_m <= kLongPatch * axis.length_m()) {
      contacts.push_back(contact_of(muscle, patch, bone));
      continue;
    }
    std::vector<int> low, high;
    for (const int t : patch) {
      if (along_m(t) < lowest_m + (highest_m - lowest_m) / 3.0) low.push_back(t);
      if (along_m(t) > highest_m - (highest_m - lowest_m) / 3.0) high.push_back(t);
    }
    for (const auto& part : {low, high}) contacts.push_back(contact_of(muscle, part, bone));
  }
  return contacts;
}

ContactPair choose_ends(const std::vector<MuscleContact>& contacts, const TriangleMesh& muscle, const LongAxis& axis) {
  const double full_m2 = kFullArea * geometry::surface_area_m2(muscle);
  const auto weight = [&](const MuscleContact& c) { return std::pow(std::min(1.0, c.area_m2 / full_m2), 0.25); };
  ContactPair best;
  double best_score = 0.0;
  for (int a = 0; a < static_cast<int>(contacts.size()); ++a) {
    for (int b = a + 1; b < static_cast<int>(contacts.size()); ++b) {
      const MuscleContact &one = contacts[at(a)], &two = contacts[at(b)];
      const double apart_m = (one.centre_m - two.centre_m).norm();
      if (apart_m < kLeastApart * axis.length_m()) continue;
      const double score = apart_m * weight(one) * weight(two) * (one.bone != two.bone ? kOtherBone : 1.0);
      if (score > best_score) best_score = score, best = {a, b};
    }
  }
  if (best.first >= 0 || contacts.empty()) return best;
  const auto largest = std::max_element(contacts.begin(), contacts.end(),
                                        [](const auto& a, const auto& b) { return a.area_m2 < b.area_m2; });
  best.first = static_cast<int>(largest - contacts.begin());
  return best;
}

}  // namespace myotact::prepare

#include "view/pictures/moving_limb_model.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/synthetic_specimen.h"
#include "view/look/start_view.h"

namespace myotact::view {
namespace {

constexpr int kMoments = 21;

double angle_at(int moment) {
  return 0.05 * moment;
}

/// The lower body rotates about y, and each skin bulges and is carried along by half.
std::vector<LimbMoment> moments_of(const anatomy::Specimen& specimen) {
  std::vector<LimbMoment> moments;
  for (int k = 0; k < kMoments; ++k) {
    const double angle = angle_at(k), c = std::cos(angle), s = std::sin(angle);
    LimbMoment moment{
        2.0 + 0.05 * k, {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}, {c, 0, s, 0.01 * k, 0, 1, 0, 0, -s, 0, c, 0}}, {}};
    const double half = std::cos(0.5 * angle), turned = std::sin(0.5 * angle);
    for (const anatomy::Muscle& muscle : specimen.muscles) {
      moment.skins_world_m.emplace_back();
      for (const Vec3& p : muscle.skin.positions_m) {
        const double swell = 1.0 + 0.2 * std::sin(3.0 * angle);
        moment.skins_world_m.back().push_back({static_cast<float>(half * p.x() + turned * p.z()),
                                               static_cast<float>(swell * p.y()),
                                               static_cast<float>(half * p.z() - turned * p.x())});
      }
    }
    moments.push_back(moment);
  }
  return moments;
}

/// A vertex of a node as a program shows it at a time of the model.
Vec3 shown(const geometry::GlbNode& node, std::size_t vertex, std::size_t time) {
  const auto vec3 = [](const std::array<float, 3>& v) { return Vec3(v[0], v[1], v[2]); };
  Vec3 p = vec3(node.positions_m[vertex]);
  for (std::size_t s = 0; s < node.shapes.size(); ++s) {
    p += static_cast<double>(node.motion.weights[time][s]) * vec3(node.shapes[s].positions_m[vertex]);
  }
  if (node.motion.rotations.empty()) return p;
  const auto& q = node.motion.rotations[time];
  return Eigen::Quaterniond(q[3], q[0], q[1], q[2]) * p + vec3(node.motion.translations_m[time]);
}

TEST(MovingLimbModel, EveryVertexIsWhereItsMomentHasIt) {
  const anatomy::Specimen specimen = testing::antagonist_hinge();
  const std::vector<LimbMoment> moments = moments_of(specimen);
  const geometry::GlbScene model = moving_limb_model(specimen, moments, start_view(specimen, 1.0f));
  ASSERT_EQ(model.times_s.size(), moments.size());
  EXPECT_EQ(model.times_s.front(), 0.0f);
  EXPECT_NEAR(model.times_s.back(), 1.0f, 1e-6f);
  for (std::size_t k = 0; k < moments.size(); ++k) {
    for (std::size_t m = 0; m < specimen.muscles.size(); ++m) {
      for (std::size_t v = 0; v < moments[k].skins_world_m[m].size(); ++v) {
        const auto& p = moments[k].skins_world_m[m][v];
        EXPECT_LT((shown(model.groups[1].nodes[m], v, k) - Vec3(p[0], p[1], p[2])).norm(), kModelTolerance_m + 1e-6);
      }
    }
    const auto& pose = moments[k].body_poses[1];
    const Vec3& rest = specimen.bones[1].surface.positions_m[0];
    const Vec3 bone{pose[0] * rest.x() + pose[2] * rest.z() + pose[3], rest.y(),
                    pose[8] * rest.x() + pose[10] * rest.z()};
    EXPECT_LT((shown(model.groups[0].nodes[1], 0, k) - bone).norm(), 1e-6);
  }
}

/// A rotation has two shapes, a bulge one more.
TEST(MovingLimbModel, FewShapesAreEnough) {
  const anatomy::Specimen specimen = testing::antagonist_hinge();
  const geometry::GlbScene model = moving_limb_model(specimen, moments_of(specimen), start_view(specimen, 1.0f));
  for (const geometry::GlbNode& node : model.groups[1].nodes) {
    EXPECT_GE(node.shapes.size(), 2u);
    EXPECT_LE(node.shapes.size(), 3u);
    for (const auto& weights : node.motion.weights) EXPECT_EQ(weights.size(), node.shapes.size());
  }
}

TEST(MovingLimbModel, WhatStandsStillHasNoShapes) {
  const anatomy::Specimen specimen = testing::antagonist_hinge();
  const LimbMoment moment = moments_of(specimen)[0];
  const geometry::GlbScene model = moving_limb_model(specimen, {moment, moment}, start_view(specimen, 1.0f));
  for (const geometry::GlbNode& node : model.groups[1].nodes) EXPECT_TRUE(node.shapes.empty());
}

}  // namespace
}  // namespace myotact::view

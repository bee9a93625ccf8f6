#include "core/pose.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace myotact {
namespace {

Pose example(double angle_rad, const Vec3& axis, const Vec3& translation_m) {
  return {Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix(), translation_m};
}

TEST(Pose, AQuarterTurnAboutZTakesXToY) {
  const Pose X_WB = example(1.5707963267948966, Vec3::UnitZ(), {0.0, 0.0, 1.0});
  EXPECT_LT((X_WB * Vec3(2.0, 0.0, 0.0) - Vec3(0.0, 2.0, 1.0)).norm(), 1e-15);
}

TEST(Pose, CompositionAndInverseAgreeWithPoints) {
  const Pose X_WA = example(0.7, {1.0, 2.0, 3.0}, {0.1, -0.2, 0.3});
  const Pose X_AB = example(-1.9, {0.0, 1.0, 1.0}, {-0.4, 0.0, 0.2});
  const Vec3 p_B(0.05, -0.06, 0.07);
  EXPECT_LT(((X_WA * X_AB) * p_B - X_WA * (X_AB * p_B)).norm(), 1e-15);
  EXPECT_LT((X_WA.inverse() * (X_WA * p_B) - p_B).norm(), 1e-15);
}

}  // namespace
}  // namespace myotact

#include "device/drivers/falcon/kinematics.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "device/drivers/falcon/packet.h"

namespace myotact::device::falcon {
namespace {

constexpr int kPoses = 10000;

/// Poses in reach of all legs, all over the workspace.
class Poses {
 public:
  Vec3 next() {
    for (;;) {
      const Vec3 grip_m(across_(random_), across_(random_), along_(random_));
      if (angles_of(grip_m)) return grip_m;
    }
  }

 private:
  std::mt19937 random_{5};
  std::uniform_real_distribution<double> across_{-0.05, 0.05}, along_{0.075, 0.175};
};

TEST(FalconKinematics, ForwardUndoesInverse) {
  Poses poses;
  double worst_m = 0.0;
  for (int i = 0; i < kPoses; ++i) {
    const Vec3 grip_m = poses.next();
    const auto again_m = grip_of(*angles_of(grip_m));
    ASSERT_TRUE(again_m) << grip_m.transpose();
    worst_m = std::max(worst_m, (*again_m - grip_m).norm());
  }
  EXPECT_LT(worst_m, 1e-9);
  RecordProperty("worst_m", std::to_string(worst_m));
}

TEST(FalconKinematics, SlopesAreThoseOfFiniteDifferences) {
  Poses poses;
  constexpr double kStep_m = 1e-6;
  int compared = 0;
  for (int i = 0; i < kPoses; ++i) {
    const Vec3 grip_m = poses.next();
    if ((grip_m - Vec3(0.0, 0.0, 0.125)).norm() > 0.04) continue;  // a stretched leg's slope has no end
    ++compared;
    const auto slope = angles_per_metre(grip_m, *angles_of(grip_m));
    ASSERT_TRUE(slope);
    for (int axis = 0; axis < 3; ++axis) {
      const auto ahead = angles_of(grip_m + kStep_m * Vec3::Unit(axis)),
                 back = angles_of(grip_m - kStep_m * Vec3::Unit(axis));
      ASSERT_TRUE(ahead && back);
      for (std::size_t leg = 0; leg < 3; ++leg) {
        const double difference = ((*ahead)[leg] - (*back)[leg]) / (2.0 * kStep_m);
        const double wanted = (*slope)(static_cast<int>(leg), axis);
        EXPECT_NEAR(difference, wanted, 1e-6 * std::max(1.0, slope->norm())) << grip_m.transpose();
      }
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST(FalconKinematics, ArmsAndGripDoTheSameWork) {
  Poses poses;
  std::mt19937 random(6);
  std::normal_distribution<double> number(0.0, 1.0);
  for (int i = 0; i < kPoses; ++i) {
    const Vec3 grip_m = poses.next();
    const auto slope = angles_per_metre(grip_m, *angles_of(grip_m));
    ASSERT_TRUE(slope);
    const Vec3 force_N(number(random), number(random), number(random));
    const Vec3 moved_m = 1e-3 * Vec3(number(random), number(random), number(random));
    const auto torque_Nm = torque_of(force_N, *slope);
    ASSERT_TRUE(torque_Nm);
    EXPECT_NEAR(torque_Nm->dot(*slope * moved_m), force_N.dot(moved_m), 1e-9);
  }
}

/// Angles, counts and torques on the axis, as worked out beforehand from the same lengths.
TEST(FalconKinematics, OnTheAxisTheTableHolds) {
  struct Row {
    double z_m, angle_deg, counts, torque_Nm;
  };
  for (const Row& row :
       {Row{0.075, -18.3, -1463, -0.168}, Row{0.100, 8.0, -741, -0.280}, Row{0.125, 27.7, -200, -0.316},
        Row{0.150, 47.2, 336, -0.285}, Row{0.175, 73.5, 1056, -0.158}}) {
    const Vec3 grip_m(0.0, 0.0, row.z_m);
    const auto angles_rad = angles_of(grip_m);
    ASSERT_TRUE(angles_rad);
    const auto torque_Nm = torque_of({0.0, 0.0, -12.5}, *angles_per_metre(grip_m, *angles_rad));
    ASSERT_TRUE(torque_Nm);
    for (std::size_t leg = 0; leg < 3; ++leg) {
      EXPECT_NEAR((*angles_rad)[leg] * 180.0 / std::numbers::pi, row.angle_deg, 0.06);
      EXPECT_NEAR(counts_of_angle((*angles_rad)[leg]), row.counts, 1.5);
      EXPECT_NEAR((*torque_Nm)[static_cast<int>(leg)], row.torque_Nm, 6e-4);
    }
  }
}

/// Motor counts that the maker's library sent for a force, as captured by libnifalcon's authors. The pose is not known:
/// the signs and the order of size are what they tell.
TEST(FalconKinematics, MotorsTurnTheWayTheyDidForTheMakersLibrary) {
  struct Capture {
    Vec3 force_N;
    std::array<int, 3> counts;
  };
  const Vec3 grip_m(0.0, 0.0, 0.125);
  const Mat3 slope = *angles_per_metre(grip_m, *angles_of(grip_m));
  for (const Capture& capture : {Capture{{10, 0, 0}, {-679, 2529, -1862}}, Capture{{0, 10, 0}, {2481, -669, -1691}},
                                 Capture{{1, 0, 0}, {-65, 136, -159}}, Capture{{0, 0, -12.5}, {661, 731, 766}},
                                 Capture{{0, 0, -50}, {2752, 2780, 2888}}}) {
    const auto counts = motor_counts(*torque_of(capture.force_N, slope), 4000.0);
    for (std::size_t leg = 0; leg < 3; ++leg)
      EXPECT_GT(counts[leg] * capture.counts[leg], 0) << capture.force_N.transpose() << ", motor " << leg;
  }
}

TEST(FalconKinematics, MotorsAreScaledTogether) {
  const auto counts = motor_counts({0.99999, -2.0, 0.5}, 4000.0);
  EXPECT_EQ(counts, (std::array<std::int16_t, 3>{-2047, 4095, -1024}));
  const auto small = motor_counts({0.01, -0.02, 0.0}, 4000.0);
  EXPECT_EQ(small, (std::array<std::int16_t, 3>{-40, 80, 0}));
  const auto none = motor_counts({1.0, std::numeric_limits<double>::quiet_NaN(), 0.0}, 4000.0);
  EXPECT_EQ(none, (std::array<std::int16_t, 3>{}));
}

TEST(FalconKinematics, WhatNoLegReachesIsRefused) {
  EXPECT_FALSE(angles_of({0.0, 0.0, 0.5}));
  EXPECT_FALSE(angles_of({0.3, 0.0, 0.125}));
  EXPECT_FALSE(angles_of(Vec3::Constant(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_FALSE(grip_of({0.0, std::numeric_limits<double>::quiet_NaN(), 0.0}));
}

TEST(FalconKinematics, CountsAndAnglesAreTheSameScale) {
  EXPECT_NEAR(angle_of_counts(0.0) * 180.0 / std::numbers::pi, 35.0, 1e-12);
  EXPECT_NEAR((angle_of_counts(1000.0) - angle_of_counts(0.0)) * 180.0 / std::numbers::pi, 36.43466, 1e-4);
  EXPECT_NEAR(counts_of_angle(angle_of_counts(-741.0)), -741.0, 1e-9);
}

}  // namespace
}  // namespace myotact::device::falcon

#include "prepare/architecture/muscle_line.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "prepare/shapes.h"

namespace myotact::prepare {
namespace {

/// A straight muscle along x from 0 to 0.1 m, slices every centimetre.
MuscleProfile straight_profile() {
  MuscleProfile profile;
  profile.length_m = 0.1;
  for (int s = 0; s < 10; ++s) {
    profile.arc_m.push_back(0.005 + 0.01 * s);
    profile.centre_m.emplace_back(0.005 + 0.01 * s, 0.0, 0.0);
    profile.section_m2.push_back(1e-4);
  }
  return profile;
}

struct Line {
  testing::SmallLimb limb = testing::small_limb();
  LineBones bones{limb.anatomy.bodies, limb.anatomy.joints, 0, 1};
  anatomy::MuscleLine line = trace_line("rod", straight_profile(), {0.02, 0.1}, {Vec3::Zero(), {0.1, 0.0, 0.0}}, bones);
};

TEST(TraceLine, BeginsAndEndsOnBoneWithFourToEightPoints) {
  const Line l;
  EXPECT_GE(l.line.points.size(), 4u);
  EXPECT_LE(l.line.points.size(), 8u);
  EXPECT_EQ(l.line.points.front().kind, anatomy::LinePointKind::Origin);
  EXPECT_EQ(l.line.points.back().kind, anatomy::LinePointKind::Insertion);
}

TEST(TraceLine, HasAPointWhereTheBellyBegins) {
  const Line l;
  EXPECT_NEAR(l.line.points[1].position_m.x(), 0.02, 1e-9);
}

TEST(TraceLine, ChangesTheBodyAtTheJointAndKeepsClearOfIt) {
  const Line l;  // the joint lies at x = 0.05
  for (const anatomy::LinePoint& point : l.line.points) {
    EXPECT_EQ(point.body, point.position_m.x() < 0.05 ? 0 : 1);
    EXPECT_GE(std::abs(point.position_m.x() - 0.05), 0.012);
  }
}

TEST(MomentArm, IsTheDistanceOfAStraightLineFromTheAxis) {
  const Line l;
  EXPECT_NEAR(moment_arm_m(l.line, l.limb.anatomy.joints[0], l.bones), 0.02, 1e-12);  // above the axis: flexes
}

TEST(JointsBetween, RefusesBodiesThatNoJointConnects) {
  Line l;
  l.limb.anatomy.joints.clear();
  EXPECT_THROW(joints_between("rod", l.bones), Error);
}

}  // namespace
}  // namespace myotact::prepare

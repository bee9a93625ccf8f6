#include "prepare/architecture/muscle_line.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "anatomy/read_wrap.h"
#include "core/error.h"
#include "prepare/shapes.h"
#include "support/complaint.h"

namespace myotact::prepare {
namespace {

using myotact::testing::complaint;
using ::testing::HasSubstr;

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

/// The same rod, 20 mm above the axis, with a crossing.
struct CrossedLine : Line {
  explicit CrossedLine(const CrossingData& crossing) {
    LineGuide guide{Vec3::Zero(), {0.1, 0.0, 0.0}, {crossing}};
    line = trace_line("rod", straight_profile(), {0.02, 0.1}, guide, bones);
  }
};

/// Distances in the plane across the axis.
double from_axis_m(const anatomy::Joint& joint, const Vec3& p) {
  return (p - joint.centre_m).cross(joint.axes[0]).norm();
}

TEST(TraceLine, CrossesAJointAtTheDistancesGiven) {
  const CrossedLine l({0, 0.025, 0.03, {}});
  const auto& points = l.line.points;
  const anatomy::Joint& joint = l.limb.anatomy.joints[0];
  int crossings = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i - 1].body == points[i].body) continue;
    ++crossings;
    EXPECT_NEAR(from_axis_m(joint, points[i - 1].position_m), 0.025, 2e-5);
    EXPECT_NEAR(from_axis_m(joint, points[i].position_m), 0.03, 2e-5);
  }
  EXPECT_EQ(crossings, 1);
}

TEST(TraceLine, CrossesToTheInsertionOrToAGivenPoint) {
  const CrossedLine to_end({0, 0.025, 0.0, {}});
  EXPECT_EQ(to_end.line.points[to_end.line.points.size() - 2].body, 0);
  const Vec3 tuberosity(0.09, 0.01, 0.0);
  const CrossedLine to_point({0, 0.025, 0.0, tuberosity});
  EXPECT_EQ(to_point.line.points.back().position_m, tuberosity);
  EXPECT_EQ(to_point.line.points.back().body, 1);
}

TEST(TraceLine, PassesAJointAndGoesOnToAGivenPoint) {
  const Vec3 fascia(0.13, 0.01, 0.0);
  const CrossedLine l({0, 0.025, 0.03, fascia});
  const auto& points = l.line.points;
  EXPECT_EQ(points.back().position_m, fascia);
  const auto first = std::find_if(points.begin(), points.end(), [](const auto& point) { return point.body == 1; });
  ASSERT_NE(first, points.end());
  EXPECT_NEAR(from_axis_m(l.limb.anatomy.joints[0], first->position_m), 0.03, 2e-5);
}

/// The rod's middle as it was measured, 5 mm aside of the profile's; it reaches 20 mm past both ends of the line.
LineGuide measured_guide() {
  LineGuide guide{Vec3::Zero(), {0.1, 0.0, 0.0}, {}};
  for (int s = -2; s <= 12; ++s) guide.middle_m.emplace_back(0.01 * s, 0.005, 0.0);
  return guide;
}

TEST(TraceLine, FollowsTheMeasuredMiddleWhereThereIsOne) {
  const Line l;
  const auto points = trace_line("rod", straight_profile(), {0.02, 0.1}, measured_guide(), l.bones).points;
  ASSERT_GE(points.size(), 4u);
  for (std::size_t i = 1; i + 1 < points.size(); ++i) EXPECT_NEAR(points[i].position_m.y(), 0.005, 1e-9);
}

TEST(TraceLine, LeavesOutWhatOfTheMiddleLiesPastItsEnds) {
  const Line l;
  const auto points = trace_line("rod", straight_profile(), {0.02, 0.1}, measured_guide(), l.bones).points;
  for (std::size_t i = 1; i < points.size(); ++i) EXPECT_GT(points[i].position_m.x(), points[i - 1].position_m.x());
  EXPECT_EQ(points.front().position_m, Vec3::Zero());
  EXPECT_EQ(points.back().position_m, Vec3(0.1, 0.0, 0.0));
}

/// How many points lie beside the joint at x = 0.05 on the line of a longer rod whose middle sinks by 20 mm there, as
/// tendons do in front of a carpus.
int points_beside_joint(double radius_m) {
  const Line l;
  MuscleProfile profile = straight_profile();
  profile.length_m = 0.3;
  for (double& arc_m : profile.arc_m) arc_m *= 3.0;
  profile.radius_m = {5e-3, 5e-3, 5e-3, 5e-3, radius_m, radius_m, radius_m, radius_m, radius_m, radius_m};
  LineGuide guide{{-0.1, 0.0, 0.0}, {0.2, 0.0, 0.0}, {}};
  for (double x = -0.095; x < 0.2; x += 0.005) {
    guide.middle_m.emplace_back(x, 0.0, -0.02 * (1.0 - std::abs(x - 0.05) / 0.15));
  }
  int beside = 0;
  for (const anatomy::LinePoint& point : trace_line("rod", profile, {0.0, 0.12}, guide, l.bones).points) {
    const double x = point.position_m.x();
    EXPECT_EQ(point.body, x < 0.05 ? 0 : 1) << x;
    if (std::abs(x - 0.05) < 0.013) ++beside;
  }
  return beside;
}

TEST(TraceLine, HoldsATendonOnBothSidesOfAJointOverWhichItWouldBeABowstring) {
  EXPECT_EQ(points_beside_joint(1e-3), 2);
  EXPECT_EQ(points_beside_joint(4e-3), 0);  // needs no retinaculum
}

TEST(TraceLine, RefusesACrossingOfAJointThatIsNotOnTheWay) {
  Line l;
  l.limb.anatomy.joints.push_back(l.limb.anatomy.joints[0]);
  l.limb.anatomy.joints.back().key = "other";
  l.limb.anatomy.bodies.push_back(l.limb.anatomy.bodies[0]);
  l.limb.anatomy.joints.back().child = 2;
  const LineGuide guide{Vec3::Zero(), {0.1, 0.0, 0.0}, {{1, 0.02, 0.02, {}}}};
  EXPECT_THAT(complaint(ExitStatus::BadData,
                        [&] {
                          trace_line("rod", straight_profile(), {0.02, 0.1}, guide, l.bones);
                        }),
              ::testing::AllOf(HasSubstr("rod"), HasSubstr("does not cross the joint other")));
}

WrapData cylinder(const Line& l, double radius_m) {
  WrapData data;
  data.joint = 0;
  data.wrap.body = 0;
  data.wrap.centre_m = l.limb.anatomy.joints[0].centre_m;
  data.wrap.axes = anatomy::axes_about(l.limb.anatomy.joints[0].axes[0]);
  data.wrap.radii_m.setConstant(radius_m);
  return data;
}

TEST(AddWraps, LieOnTheCrossingSegmentAndGiveTheirRadiusAsMomentArm) {
  Line l;
  add_wraps("rod", {cylinder(l, 0.0205)}, l.bones, l.line);
  ASSERT_EQ(l.line.wraps.size(), 1u);
  const auto after = static_cast<std::size_t>(l.line.wraps[0].after);
  EXPECT_NE(l.line.points[after].body, l.line.points[after + 1].body);
  for (const int body : {0, 1}) {
    l.line.wraps[0].body = body;
    EXPECT_NEAR(moment_arm_m(l.line, l.limb.anatomy.joints[0], l.bones), 0.0205, 1e-12);
  }
}

TEST(AddWraps, RefusesWhatTheLineCannotGoRound) {
  Line l;
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { add_wraps("rod", {cylinder(l, 0.04)}, l.bones, l.line); }),
              ::testing::AllOf(HasSubstr("rod"), HasSubstr("lies inside it")));
  Line same;
  for (anatomy::LinePoint& point : same.line.points) point.body = 1;
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { add_wraps("rod", {cylinder(l, 0.02)}, same.bones, same.line); }),
              HasSubstr("does not cross the joint"));
}

TEST(JointsBetween, RefusesBodiesThatNoJointConnects) {
  Line l;
  l.limb.anatomy.joints.clear();
  EXPECT_THROW(joints_between("rod", l.bones), Error);
}

}  // namespace
}  // namespace myotact::prepare

#include "measure/stiffness_reason.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myotact::measure {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Two muscles; K of the tissue is that of the lines, so that nothing lies beyond them.
StiffnessRow row_of(double muscle_Nm_rad, double geometry_Nm_rad) {
  StiffnessRow row;
  row.held = row.converged = true;
  row.K_passive_Nm_rad = 0.1;
  row.K_muscle_Nm_rad = muscle_Nm_rad;
  row.K_geometry_Nm_rad = geometry_Nm_rad;
  row.K_schur_Nm_rad = muscle_Nm_rad + geometry_Nm_rad + 0.1;
  row.K_low_Nm_rad = row.K_schur_Nm_rad - 0.05;
  row.K_high_Nm_rad = row.K_schur_Nm_rad + 0.05;
  row.muscles = {{"biceps_brachii", 1.0, 1.0, 0.0, 0.75 * muscle_Nm_rad, 0.25 * geometry_Nm_rad},
                 {"fore.anconeus", 1.0, -1.0, 0.0, 0.25 * muscle_Nm_rad, 0.75 * geometry_Nm_rad}};
  return row;
}

TEST(StiffnessReason, NamesTheLargestPartItsMuscleAndWhatWorksAgainstIt) {
  const std::string why = explain_stiffness(row_of(4.0, -1.0));
  EXPECT_THAT(why,
              HasSubstr("K = 3.10 N m/rad; its largest part is the fibres' own stiffness at their moment arms (r^2 k), "
                        "+4.00 (the biceps brachii most: +3.00)"));
  EXPECT_THAT(why, HasSubstr("against it: the moment arms that change as the joint rotates (-(dr/dq) F), -1.00 (the "
                             "anconeus most: -0.75)"));
  EXPECT_THAT(why, Not(HasSubstr("unstable")));
}

TEST(StiffnessReason, AnUnstableJointIsToldWhatWouldChangeIt) {
  EXPECT_THAT(explain_stiffness(row_of(1.0, -3.0)), AllOf(HasSubstr("its largest part is the moment arms"),
                                                          HasSubstr("unstable"), HasSubstr("lines that wrap")));
  EXPECT_THAT(explain_stiffness(row_of(-3.0, 1.0)), AllOf(HasSubstr("its largest part is the fibres"),
                                                          HasSubstr("a shorter rest stretch, which brings the")));
  StiffnessRow bulk = row_of(1.0, 0.5);
  bulk.K_schur_Nm_rad = -2.0;
  EXPECT_THAT(explain_stiffness(bulk), AllOf(HasSubstr("the bulk of the muscles beyond their lines, -3.60"),
                                             HasSubstr("hold the bellies in place")));
}

TEST(StiffnessReason, ContactIsAPartOfItsOwn) {
  StiffnessRow row = row_of(1.0, -0.5);
  row.K_contact_Nm_rad = 5.0;
  row.K_schur_Nm_rad += 5.0;
  EXPECT_THAT(explain_stiffness(row), HasSubstr("its largest part is contact between tissues, +5.00;"));
}

TEST(StiffnessReason, WeightIsToldApart) {
  StiffnessRow row = row_of(4.0, -1.0);
  EXPECT_THAT(explain_stiffness(row), Not(HasSubstr("weight")));
  row.K_gravity_Nm_rad = -0.3;
  EXPECT_THAT(explain_stiffness(row), HasSubstr("The weight of the bones, which is not in it, adds -0.30."));
}

TEST(StiffnessReason, SaysWhatIsOpenOrNotToBeQuoted) {
  StiffnessRow open = row_of(4.0, -1.0);
  open.K_low_Nm_rad = -0.2;
  EXPECT_THAT(explain_stiffness(open), HasSubstr("Whether it is stable at all is open"));
  StiffnessRow loose = row_of(4.0, -1.0);
  loose.held = loose.converged = false;
  EXPECT_THAT(explain_stiffness(loose), AllOf(HasSubstr("do not quote"), HasSubstr("do not hold the joint")));
  StiffnessRow lost;
  lost.K_schur_Nm_rad = std::nan("");
  EXPECT_THAT(explain_stiffness(lost), HasSubstr("not known"));
}

TEST(StiffnessReason, AJointWithoutMusclesHasItsSpring) {
  StiffnessRow row;
  row.held = row.converged = true;
  row.K_passive_Nm_rad = row.K_schur_Nm_rad = 0.1;
  EXPECT_THAT(explain_stiffness(row), HasSubstr("its largest part is the joint's own spring, +0.10."));
}

TEST(StiffnessReason, NamesALineThatIsCaughtInItsWrap) {
  StiffnessRow row = row_of(4.0, -1.0);
  EXPECT_THAT(explain_stiffness(row), Not(HasSubstr("wrap")));
  row.stuck_line = "biceps_brachii";
  EXPECT_THAT(explain_stiffness(row), HasSubstr("The line of biceps_brachii cannot clear its wrap surface"));
}

}  // namespace
}  // namespace myotact::measure

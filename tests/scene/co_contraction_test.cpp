#include "scene/co_contraction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/complaint.h"
#include "support/synthetic_specimen.h"

namespace myotact::scene {
namespace {

/// Flexor 0 of at most 2 N m, extensor 1 of at most -5 N m, each with 0.1 N m of passive pull, torque linear in level.
TorqueTable two_muscles() {
  return {{0.0, 0.5, 1.0}, {{0.1, 1.05, 2.0}, {-0.1, -2.55, -5.0}}};
}

CoContraction set_of(double common, double difference = 0.0) {
  CoContraction set;
  set.joint = 0;
  set.flexors = {0};
  set.extensors = {1};
  set.common = common;
  set.difference = difference;
  return set;
}

constexpr double kNoTorque[] = {0.0, 0.0};

TEST(Balance, WeakerSideWorksAtTheCommonLevelAndTheOtherCancelsIt) {
  const TorqueTable table = two_muscles();
  for (const double common : {0.2, 0.6, 1.0}) {
    const Balance levels = balance(table, set_of(common), kNoTorque);
    EXPECT_TRUE(levels.held);
    EXPECT_DOUBLE_EQ(levels.flexors, common);
    EXPECT_NEAR(table.torque(0, levels.flexors) + table.torque(1, levels.extensors), 0.0, 1e-9);
  }
}

TEST(Balance, RaisesTheWeakerSideWhereThePassivePullOfTheStrongerWins) {
  TorqueTable table = two_muscles();
  table.torque_Nm[1] = {-0.5, -2.75, -5.0};
  const Balance levels = balance(table, set_of(0.0), kNoTorque);
  EXPECT_TRUE(levels.held);
  EXPECT_DOUBLE_EQ(levels.extensors, 0.0);
  EXPECT_NEAR(table.torque(0, levels.flexors), 0.5, 1e-9);
}

TEST(Balance, SaysWhenTheWantedTorqueIsOutOfReach) {
  EXPECT_FALSE(balance(two_muscles(), set_of(0.0), kNoTorque, 3.0).held);
}

TEST(Balance, DifferenceIsAddedToOneSide) {
  const Balance flexed = balance(two_muscles(), set_of(0.5, 0.2), kNoTorque);
  EXPECT_DOUBLE_EQ(flexed.flexors, 0.7);
  const Balance straight = balance(two_muscles(), set_of(0.5), kNoTorque);
  const Balance extended = balance(two_muscles(), set_of(0.5, -0.2), kNoTorque);
  EXPECT_NEAR(extended.extensors - straight.extensors, 0.2, 1e-12);
}

TEST(Balance, CountsTheTorqueOfMusclesThatAreNotDriven) {
  TorqueTable table = two_muscles();
  table.torque_Nm.push_back({0.0, 0.25, 0.5});
  const double activations[] = {0.0, 0.0, 1.0};
  const Balance levels = balance(table, set_of(0.5), activations);
  EXPECT_NEAR(table.torque(0, levels.flexors) + table.torque(1, levels.extensors) + 0.5, 0.0, 1e-9);
}

/// A hinge with groups, and a second one without.
Scene scene_of_two_joints() {
  Scene scene;
  scene.specimen = testing::antagonist_hinge();
  scene.specimen.joints.push_back(scene.specimen.joints[0]);
  scene.specimen.joints[1].key = "carpus";
  return scene;
}

TEST(CoContractionOf, TakesTheGroupsOfAJointUnlessTheSceneHasItsOwnLists) {
  Scene scene = scene_of_two_joints();
  EXPECT_EQ(co_contraction_of(scene, "elbow").flexors, std::vector<int>{0});
  EXPECT_EQ(co_contraction_of(scene, "elbow").extensors, std::vector<int>{1});
  scene.co_contraction = set_of(0.3, 0.1);
  scene.co_contraction->flexors = {1};
  const CoContraction own = co_contraction_of(scene, "elbow");
  EXPECT_EQ(own.flexors, std::vector<int>{1});
  EXPECT_DOUBLE_EQ(own.difference, 0.1);
}

TEST(CoContractionOf, RefusesJointsThatCannotBeBalanced) {
  Scene scene = scene_of_two_joints();
  const auto complaint = [&](const std::string& key) {
    return testing::complaint(ExitStatus::Usage, [&] { co_contraction_of(scene, key); });
  };
  EXPECT_THAT(complaint("elbo"), ::testing::HasSubstr("no such joint"));
  EXPECT_THAT(complaint("elbo"), ::testing::HasSubstr("nearest: elbow"));
  EXPECT_THAT(complaint("carpus"), ::testing::HasSubstr("lacks flexors or extensors"));
  scene.specimen.joints[0].type = anatomy::JointType::Weld;
  EXPECT_THAT(complaint("elbow"), ::testing::HasSubstr("does not rotate"));
}

TEST(DrivenActivations, ReplaceThoseOfTheTwoSidesAlone) {
  CoContraction set = set_of(0.0);
  set.flexors = {2};
  EXPECT_EQ(driven_activations(set, {0.7, 0.4, true}, {0.1, 0.2, 0.3}), (std::vector<double>{0.1, 0.4, 0.7}));
}

simulation::JointReadout joint_at(double angle_rad, double net_torque_Nm) {
  simulation::JointReadout joint;
  joint.angle_rad = angle_rad;
  joint.net_torque_Nm = net_torque_Nm;
  joint.stiffness_Nm_rad = 2.0;
  return joint;
}

TEST(PostureTrim, AsksForTorqueAgainstALastingDrift) {
  PostureTrim trim;
  trim.restart(joint_at(0.1, 0.0));
  double torque = 0.0;
  for (int i = 0; i < 100; ++i) torque = trim.update(joint_at(0.11, 0.0), 0.01);
  EXPECT_LT(torque, 0.0);
  EXPECT_EQ(trim.torque_Nm(), torque);
}

TEST(PostureTrim, WhatAPushBalancesIsLeftAlone) {
  PostureTrim trim;
  trim.restart(joint_at(0.1, 0.0));
  for (int i = 0; i < 100; ++i) trim.update(joint_at(0.12, -2.0 * 0.02), 0.01);
  EXPECT_NEAR(trim.torque_Nm(), 0.0, 1e-12);
}

TEST(PostureTrim, FarFromTheHeldAngleTheAngleAloneCounts) {
  PostureTrim trim;
  trim.restart(joint_at(0.1, 0.0));
  EXPECT_LT(trim.update(joint_at(0.3, -2.0 * 0.2), 0.01), 0.0);
}

TEST(PostureTrim, BearsTheJointsOwnTorqueFromTheStart) {
  PostureTrim trim;
  simulation::JointReadout joint = joint_at(0.1, 0.0);
  joint.own_torque_Nm = -0.03;
  trim.restart(joint);
  EXPECT_DOUBLE_EQ(trim.torque_Nm(), 0.03);
  joint.net_torque_Nm = 0.02;  // the table gave too little
  trim.correct(joint);
  EXPECT_DOUBLE_EQ(trim.torque_Nm(), 0.04);
}

}  // namespace
}  // namespace myotact::scene

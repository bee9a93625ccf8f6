#include <cmath>
#include <complex>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/data_folder.h"
#include "core/file.h"
#include "core/json_reader.h"
#include "measure/line/line_motion.h"
#include "measure/line/line_stiffness.h"
#include "support/complaint.h"
#include "support/temporary_folder.h"

namespace myotact::measure {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::filesystem::path shipped(const std::string& name) {
  return data_folder() / "assets" / "cases" / (name + ".json");
}

// ---- the path

/// Wraps until phi falls below acos(R/a) + acos(R/b), 2.13 rad.
const WrappedPath kPath{0.1, 0.04, 0.03, 2.4, -1.0, 0.012, 0.018};

TEST(WrappedPath, ArmAndItsSlopeAreTheDerivativesOfTheLength) {
  constexpr double h = 1e-6;
  for (const double sign : {-1.0, 1.0}) {
    WrappedPath path = kPath;
    path.sign = sign;
    for (double q = -0.6; q < 0.9; q += 0.0371) {
      const PathGeometry here = measure_path(path, q), ahead = measure_path(path, q + h);
      const PathGeometry behind = measure_path(path, q - h);
      EXPECT_NEAR(here.arm_m, -(ahead.length_m - behind.length_m) / (2 * h), 1e-9) << q;
      EXPECT_NEAR(here.arm_slope_m_rad, (ahead.arm_m - behind.arm_m) / (2 * h), 1e-8) << q;
    }
  }
}

TEST(WrappedPath, StraightPathIsATriangleSide) {
  WrappedPath path{0.1, 0.03, 0.04, std::numbers::pi / 2.0, 1.0, 0.0, 0.0};
  EXPECT_NEAR(measure_path(path, 0.0).length_m, 0.15, 1e-15);
  EXPECT_NEAR(measure_path(path, 0.0).arm_m, -0.03 * 0.04 / 0.05, 1e-15);  // twice the area over the base
  path.offset_m = 0.12;
  EXPECT_NEAR(measure_path(path, 0.0).length_m, 0.23, 1e-15);  // 5-12-13
}

TEST(WrappedPath, WrappedPathHasTheCylindersMomentArm) {
  WrappedPath path = kPath;
  path.offset_m = 0.0;
  const PathGeometry wrapped = measure_path(path, 0.0);
  EXPECT_NEAR(wrapped.arm_m, 0.018, 1e-15);
  EXPECT_EQ(wrapped.arm_slope_m_rad, 0.0);
  const double off_rad = 2.4 - std::acos(0.018 / 0.04) - std::acos(0.018 / 0.03);
  EXPECT_NEAR(measure_path(path, off_rad + 1e-9).length_m, measure_path(path, off_rad - 1e-9).length_m, 1e-10);
  EXPECT_NEAR(measure_path(path, off_rad + 1e-9).arm_m, 0.018,
              1e-9);  // the moment arm does not jump where it lifts off
}

// ---- balance, stiffness, oscillation

LineModel with_tendon(LineModel model, simulation::Tendon tendon) {
  for (LineMuscle& muscle : model.joint.muscles) muscle.unit.tendon = tendon;
  return model;
}

TEST(LineStiffness, EveryRowIsInBalanceAndAgreesWithItsDifference) {
  for (const char* name : {"line_elbow", "line_stifle", "line_hock"}) {
    for (const auto tendon : {simulation::Tendon::Rigid, simulation::Tendon::Elastic}) {
      LineModel model = with_tendon(load_line_model(shipped(name)), tendon);
      for (const double q : {-0.17, -0.05, 0.04, 0.17}) model.q_rad.push_back(model.q_rad.front() + q);
      for (const LineRow& row : line_stiffness(model)) {
        EXPECT_TRUE(agrees(row)) << name << " " << row.q_rad << " " << row.level << " " << row.K_perturbed_Nm_rad;
        if (row.balance.held) {
          EXPECT_NEAR(row.state.all().torque_Nm, 0.0, 1e-12) << name << " " << row.q_rad << " " << row.level;
        }
      }
    }
  }
}

// On rigid tendons all forces are affine in the activations, and the balance keeps those affine in the level.
TEST(LineStiffness, RigidTendonsMakeEveryColumnAffineInTheLevel) {
  for (const char* name : {"line_elbow", "line_stifle", "line_hock"}) {
    const LineModel model = with_tendon(load_line_model(shipped(name)), simulation::Tendon::Rigid);
    const std::vector<LineRow> rows = line_stiffness(model);  // levels 0, .25, .5, .75, 1
    ASSERT_EQ(rows.size(), 5U);
    const auto affine = [&](auto value) {
      const double half = value(rows[2]), full = value(rows[4]);
      EXPECT_NEAR(value(rows[1]), 1.5 * half - 0.5 * full, 1e-10 * std::abs(full)) << name;
      EXPECT_NEAR(value(rows[3]), 0.5 * (half + full), 1e-10 * std::abs(full)) << name;
    };
    affine([](const LineRow& row) { return row.balance.levels.flexors; });
    affine([](const LineRow& row) { return row.balance.levels.extensors; });
    affine([](const LineRow& row) { return row.state.flexors.torque_Nm; });
    affine([](const LineRow& row) { return row.state.all().muscle_Nm_rad; });
    affine([](const LineRow& row) { return row.state.all().geometry_Nm_rad; });
    affine([](const LineRow& row) { return row.state.all().damping_Nms_rad; });
    affine([](const LineRow& row) { return row.K_short_range_Nm_rad; });
  }
}

TEST(LineStiffness, SideThatCannotBeHeldSaysSo) {
  LineModel model = load_line_model(shipped("line_elbow"));
  for (LineMuscle& muscle : model.joint.muscles) {
    if (muscle.key == "triceps_brachii_long") muscle.unit.tendon_slack_m -= 0.03;  // stretched far beyond 1.4 lo
  }
  for (const LineRow& row : line_stiffness(model)) {
    EXPECT_FALSE(row.balance.held);
    EXPECT_EQ(row.balance.levels.flexors, 1.0);
    EXPECT_EQ(row.balance.levels.extensors, 0.0);
  }
}

TEST(JointMode, RigidTendonsGiveTheTextbookOscillator) {
  const LineModel model = with_tendon(load_line_model(shipped("line_elbow")), simulation::Tendon::Rigid);
  const LineRow row = line_stiffness(model).front();
  const double K = row.state.all().stiffness_Nm_rad(), B = row.state.all().damping_Nms_rad;
  const double I = model.joint.inertia_kg_m2;
  const double ratio = B / (2.0 * std::sqrt(K * I));
  EXPECT_NEAR(row.mode.damping_ratio, ratio, 1e-12);
  EXPECT_NEAR(row.mode.frequency_hz, row.frequency_hz * std::sqrt(1.0 - ratio * ratio), 1e-12);
}

// One fibre on its tendon and an inertia: I s^2 + geo + r^2 kt (km + bm s)/(km + kt + bm s) = 0 at the oscillation.
TEST(JointMode, ElasticTendonSolvesTheCharacteristicEquation) {
  LineModel model = load_line_model(shipped("line_stifle"));
  LineJoint joint = model.joint;
  joint.muscles = {model.joint.muscles[0]};
  const LineJointState state = line_joint_state(joint, 0.3, {0.6, 0.0});
  const JointMode mode = mode_of(response_of(joint, state));
  ASSERT_GT(mode.frequency_hz, 0.0);
  const double modulus = 2.0 * std::numbers::pi * mode.frequency_hz / std::sqrt(1.0 - std::pow(mode.damping_ratio, 2));
  const std::complex<double> s(-mode.damping_ratio * modulus, 2.0 * std::numbers::pi * mode.frequency_hz);
  const auto& [activation, path, force] = state.muscles[0];
  const std::complex<double> fibre = force.fibre_stiffness_N_m + force.fibre_damping_Ns_m * s;
  const double kt = force.tendon_stiffness_N_m;
  const std::complex<double> residual = joint.inertia_kg_m2 * s * s - path.arm_slope_m_rad * force.force_N +
                                        path.arm_m * path.arm_m * kt * fibre / (fibre + kt);
  EXPECT_LT(std::abs(residual), 1e-9 * std::abs(joint.inertia_kg_m2 * s * s));
}

TEST(JointMode, UnstableJointRunsAway) {
  LineModel model = with_tendon(load_line_model(shipped("line_elbow")), simulation::Tendon::Rigid);
  LineJointState state = line_joint_state(model.joint, 0.0, {0.5, 0.3});
  for (LineMuscleState& muscle : state.muscles) muscle.path.arm_slope_m_rad = 1.0;
  EXPECT_LT(mode_of(response_of(model.joint, state)).damping_ratio, 0.0);
}

TEST(LineMotion, JointInBalanceStaysWhereItIs) {
  const LineModel model = load_line_model(shipped("line_elbow"));
  LineMotion motion;
  motion.levels = balance_sides(model.joint, 0.0, 0.5).levels;
  motion.dt_s = 0.005;
  motion.steps = 200;
  for (const double angle_rad : move_line_joint(model.joint, motion)) EXPECT_NEAR(angle_rad, 0.0, 1e-11);
}

// ---- the file

class LineModelFile : public ::testing::Test {
 protected:
  LineModel load(const json& model) const {
    write_file(folder_ / "model.json", model.dump());
    return load_line_model(folder_ / "model.json");
  }
  std::string problem(const json& model) const {
    return myotact::testing::complaint(ExitStatus::BadData, [&] { load(model); });
  }
  /// The complaint about the shipped elbow with the value at a pointer replaced or added.
  std::string problem(const std::string& pointer, const json& value) const {
    json changed = model_;
    changed[json::json_pointer(pointer)] = value;
    return problem(changed);
  }

  json model_ = read_json(shipped("line_elbow"));
  myotact::testing::TemporaryFolder folder_;
};

TEST_F(LineModelFile, ShippedElbowIsReadWhole) {
  const LineModel model = load(model_);
  EXPECT_EQ(model.joint.name, "elbow");
  EXPECT_EQ(model.joint.muscles.size(), 7U);
  EXPECT_EQ(model.joint.muscles[2].driven, false);
  EXPECT_EQ(model.levels, (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
  EXPECT_TRUE(model.short_range_stiffness);
  // Published slack length of the biceps' tendon, from its fibre stretch at the file pose.
  EXPECT_NEAR(model.joint.muscles[0].unit.tendon_slack_m, 0.217040, 1e-6);
}

TEST_F(LineModelFile, EveryMissingKeyIsNamed) {
  for (const char* key : {"schema", "joint", "tendon", "q_rad", "levels", "muscles"}) {
    json changed = model_;
    changed.erase(key);
    EXPECT_THAT(problem(changed), AllOf(HasSubstr("model.json: /: "), HasSubstr(key))) << key;
  }
  for (const char* key :
       {"key", "side", "driven", "path", "peak_force_N", "optimal_fibre_m", "pennation_rad", "rest_stretch"}) {
    json changed = model_;
    changed["muscles"][3].erase(key);
    EXPECT_THAT(problem(changed), AllOf(HasSubstr("/muscles/3"), HasSubstr(key))) << key;
  }
  for (const char* key : {"constant_m", "a_m", "b_m", "phi0_rad", "sign", "offset_m", "radius_m"}) {
    json changed = model_;
    changed["muscles"][3]["path"].erase(key);
    EXPECT_THAT(problem(changed), AllOf(HasSubstr("/muscles/3/path"), HasSubstr(key))) << key;
  }
}

TEST_F(LineModelFile, EveryUnknownKeyIsNamedWithTheNearest) {
  EXPECT_THAT(problem("/level", 1), AllOf(HasSubstr("/level"), HasSubstr("\"levels\"")));
  EXPECT_THAT(problem("/joint/inertia", 1), HasSubstr("\"inertia_kg_m2\""));
  EXPECT_THAT(problem("/muscles/1/peak_force", 1), HasSubstr("\"peak_force_N\""));
  EXPECT_THAT(problem("/muscles/1/path/radius", 1), HasSubstr("\"radius_m\""));
  EXPECT_THAT(problem("/tendon", "elastc"), HasSubstr("nearest: \"elastic\""));
  EXPECT_THAT(problem("/muscles/1/side", "flex"), HasSubstr("nearest: \"flexor\""));
}

TEST_F(LineModelFile, EveryValueOutOfRangeIsRefusedWithItsRange) {
  EXPECT_THAT(problem("/muscles/0/optimal_fibre_m", 0),
              AllOf(HasSubstr("/muscles/0/optimal_fibre_m"), HasSubstr("is 0")));
  EXPECT_THAT(problem("/levels", json::array({0, 1.2})), AllOf(HasSubstr("/levels/1"), HasSubstr("between 0 and 1")));
  EXPECT_THAT(problem("/levels", json::array()), HasSubstr("is empty"));
  EXPECT_THAT(problem("/q_rad", json::array({"a"})), HasSubstr("/q_rad/0"));
  EXPECT_THAT(problem("/muscles/0/path/radius_m", 0.031),
              AllOf(HasSubstr("/muscles/0/path/radius_m"), HasSubstr("0.031"), HasSubstr("between 0 and 0.03")));
  EXPECT_THAT(problem("/muscles/0/peak_force_N", -1), HasSubstr("is -1"));
  EXPECT_THAT(problem("/muscles/0/pennation_rad", 1.6), HasSubstr("between 0 and 1.5"));
  EXPECT_THAT(problem("/joint/inertia_kg_m2", 0), HasSubstr("is 0"));
  EXPECT_THAT(problem("/joint/paw_lever_m", 0), HasSubstr("is 0"));
  EXPECT_THAT(problem("/schema", 2), HasSubstr("between 1 and 1"));
  EXPECT_THAT(problem("/muscles", json::array()), HasSubstr("is empty"));
}

TEST_F(LineModelFile, WhatContradictsItselfIsRefusedWithARemedy) {
  EXPECT_THAT(problem("/muscles/0/path/sign", 1), HasSubstr("must be -1 for a flexor"));
  EXPECT_THAT(problem("/muscles/0/path/sign", 0), HasSubstr("must be 1 or -1"));
  EXPECT_THAT(problem("/muscles/0/rest_stretch", 0.6), HasSubstr("sine of the pennation"));
  EXPECT_THAT(problem("/muscles/0/tendon_slack_m", 0.2), HasSubstr("exactly one of rest_stretch and tendon_slack_m"));
  EXPECT_THAT(problem("/muscles/4/optimal_fibre_m", 0.3), HasSubstr("lower optimal_fibre_m"));
  EXPECT_THAT(problem("/muscles/1/key", "biceps_brachii"), HasSubstr("is there twice"));
  EXPECT_THAT(problem("/q_rad", json::array({0, 2.5})), HasSubstr("leave that angle out"));
  json passive = model_;
  for (json& muscle : passive["muscles"]) muscle["driven"] = muscle["side"] == "flexor";
  EXPECT_THAT(problem(passive), HasSubstr("no driven extensor"));
  json slack = model_;
  slack["muscles"][0].erase("rest_stretch");
  slack["muscles"][0]["tendon_slack_m"] = 0.2;
  EXPECT_THAT(problem(slack), HasSubstr("rest_q_rad"));
}

TEST_F(LineModelFile, SlackLengthMayBeGivenItself) {
  const double by_rule = load(model_).joint.muscles[0].unit.tendon_slack_m;
  model_["muscles"][0].erase("rest_stretch");
  model_["muscles"][0].erase("rest_q_rad");
  model_["muscles"][0]["tendon_slack_m"] = 0.21704;  // published, to a micrometre
  const LineModel model = load(model_);
  EXPECT_EQ(model.joint.muscles[0].unit.tendon_slack_m, 0.21704);
  const double K = line_stiffness(model).back().state.all().stiffness_Nm_rad();
  EXPECT_NEAR(K, 3.9716, 3e-4 * 3.9716);
  EXPECT_NEAR(by_rule, 0.21704, 1e-6);
}

TEST_F(LineModelFile, IsToldFromASceneByItsContent) {
  EXPECT_TRUE(is_line_model(shipped("line_hock")));
  EXPECT_FALSE(is_line_model(data_folder() / "assets" / "scenes" / "elbow.json"));
  EXPECT_FALSE(is_line_model("elbow"));
  EXPECT_FALSE(is_line_model(folder_ / "absent.json"));
  json nameless = model_;
  nameless.erase("muscles");
  write_file(folder_ / "scene.json", nameless.dump());
  EXPECT_TRUE(is_line_model(folder_ / "scene.json"));
  write_file(folder_ / "list.json", "[1, 2]");
  EXPECT_FALSE(is_line_model(folder_ / "list.json"));
}

}  // namespace
}  // namespace myotact::measure

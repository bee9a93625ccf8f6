// What an .osim file becomes, and what is said of files that are not as they should be.

#include <algorithm>
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exchange/opensim.h"
#include "exchange/opensim_arm.h"
#include "scene/scene_file.h"
#include "simulation/line/line_model.h"
#include "support/complaint.h"
#include "support/mutator.h"
#include "support/temporary_folder.h"

namespace myotact::testing {
namespace {

using exchange::opensim::Import;
using exchange::opensim::parse_model;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string refusal(const std::string& text) {
  const std::string said = complaint(ExitStatus::BadData, [&] { parse_model(text, "arm.osim"); });
  EXPECT_EQ(said.rfind("arm.osim: ", 0), 0u) << said;
  return said;
}

std::string all_not_taken(const Import& import) {
  std::string text;
  for (const auto& n : import.not_taken) {
    text += n.element + "|" + (n.objects.empty() ? "" : n.objects.front()) + "|" + n.place + "|" + n.reason + "\n";
  }
  return text;
}

/// Moment arm of the muscle's line about joint 0 at q.
double arm_m(const anatomy::Specimen& specimen, const std::string& muscle, double q_rad) {
  simulation::Skeleton skeleton(specimen);
  std::vector<double> q(specimen.joints.size(), 0.0);
  const int joint = anatomy::find_joint(specimen, "elbow");
  q[static_cast<std::size_t>(joint)] = q_rad;
  skeleton.set_pose(q);
  simulation::LineGeometry geometry;
  const int m = anatomy::find_muscle(specimen, muscle);
  simulation::measure_line(specimen.lines.at(static_cast<std::size_t>(m)), skeleton, geometry);
  return -geometry.slope_m_rad[joint];
}

TEST(OpenSim, TakesBodiesJointsAndMuscles) {
  const Import import = parse_model(arm_text(), "arm.osim");
  const anatomy::Specimen& s = import.specimen;
  ASSERT_EQ(s.bodies.size(), 2u);  // nothing is fixed to the ground, which is none
  EXPECT_EQ(s.bodies[0].key, "humerus");
  EXPECT_LT((s.bodies[0].com_m - Vec3(0.0, 0.0, -0.15)).norm(), 1e-12);  // OpenSim's y is up
  EXPECT_DOUBLE_EQ(s.bodies[1].inertia_kg_m2[1], 0.012);                 // about its z, here y
  ASSERT_EQ(s.joints.size(), 1u);
  EXPECT_EQ(s.joints[0].type, anatomy::JointType::Hinge);
  EXPECT_LT((s.joints[0].centre_m - Vec3(0.0, 0.0, -0.3)).norm(), 1e-12);
  EXPECT_LT((s.joints[0].axes[0] + Vec3::UnitY()).norm(), 1e-12);  // its z, to the right
  ASSERT_EQ(s.muscles.size(), 2u);
  EXPECT_DOUBLE_EQ(s.muscles[0].peak_force_N, 600.0);
  EXPECT_DOUBLE_EQ(s.muscles[0].activation_tau_s, 0.010);
  EXPECT_DOUBLE_EQ(s.muscles[1].activation_tau_s, 0.015);
  ASSERT_EQ(s.lines[1].wraps.size(), 1u);
  ASSERT_EQ(s.groups.size(), 1u);
  EXPECT_EQ(s.groups[0].flexors, std::vector<int>{0});
  EXPECT_EQ(s.groups[0].extensors, std::vector<int>{1});
  EXPECT_EQ(import.scene_joint, "elbow");
  EXPECT_EQ(all_not_taken(import), "");
}

TEST(OpenSim, FibresRestWhereTheTendonIsJustStraight) {
  const Import import = parse_model(arm_text(), "arm.osim");
  const double length_m = std::hypot(0.33, 0.01), width_m = 0.12 * std::sin(0.1);
  EXPECT_NEAR(import.specimen.muscles[0].rest_stretch, std::hypot(length_m - 0.2, width_m) / 0.12, 1e-12);
}

TEST(OpenSim, TheMomentArmIsThatOfPlaneGeometry) {
  const Import import = parse_model(arm_text(), "arm.osim");
  for (const double q : {0.1, 0.7, 1.5, 2.1}) {
    // In the plane of the joint, seen from its centre: origin p, insertion r turned by q; z adds 0.01 m.
    const double px = 0.03, py = 0.28, rx = 0.03, ry = -0.05;
    const auto length = [&](double angle) {
      const double x = rx * std::cos(angle) - ry * std::sin(angle) - px;
      const double y = rx * std::sin(angle) + ry * std::cos(angle) - py;
      return std::sqrt(x * x + y * y + 0.01 * 0.01);
    };
    const double expected_m = -(length(q + 1e-6) - length(q - 1e-6)) / 2e-6;
    EXPECT_NEAR(arm_m(import.specimen, "biceps", q), expected_m, 1e-8) << q;
  }
}

TEST(OpenSim, FramesAreTurnedAboutXThenYThenZ) {
  const double x = 0.3, y = -0.2, z = 0.5;
  const std::string text = with(arm_text(), "<orientation>0 0 0", "<orientation>0.3 -0.2 0.5");
  const Import import = parse_model(text, "arm.osim");
  // The third column of Rx Ry Rz, which is where a pin's z axis points, in OpenSim's axes.
  const Vec3 pin(std::sin(y), -std::sin(x) * std::cos(y), std::cos(x) * std::cos(y));
  EXPECT_LT((import.specimen.joints[0].axes[0] - Vec3(pin.x(), -pin.z(), pin.y())).norm(), 1e-12);
  // The forearm's frame is the joint's: its centre of mass lies along -y of that, the second column.
  const Vec3 up(-std::cos(y) * std::sin(z), std::cos(x) * std::cos(z) - std::sin(x) * std::sin(y) * std::sin(z),
                std::sin(x) * std::cos(z) + std::cos(x) * std::sin(y) * std::sin(z));
  const Vec3 com = Vec3(0.0, -0.3, 0.0) - 0.1 * up;
  EXPECT_LT((import.specimen.bodies[1].com_m - Vec3(com.x(), -com.z(), com.y())).norm(), 1e-12);
}

TEST(OpenSim, ItsSceneCanBePlayed) {
  TemporaryFolder folder;
  const Import import = parse_model(arm_text(), "arm.osim");
  anatomy::save_specimen(import.specimen, folder / "arm", {{"scene.json", import.scene_json}});
  const scene::Scene scene = scene::load_scene((folder / "arm" / "scene.json").string());
  ASSERT_TRUE(scene.co_contraction);
  simulation::Simulation simulation(scene.specimen, scene.settings);
  EXPECT_TRUE(simulation.settle(std::vector<double>{0.5}, std::vector<double>{0.2, 0.2}));
  simulation.step({});
  EXPECT_EQ(simulation.failed_steps(), 0);
}

TEST(OpenSim, AnExtensionIsTurned) {
  const Import import = parse_model(with(arm_text(), "elbow_flexion", "elbow_extension"), "arm.osim");
  EXPECT_LT((import.specimen.joints[0].axes[0] - Vec3::UnitY()).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(import.coordinates.at(0).factor, -1.0);
  EXPECT_DOUBLE_EQ(import.specimen.joints[0].range_rad[0].first, -2.2);
  const Import knee = parse_model(with(with(arm_text(), "elbow_flexion", "knee_angle"), "0 2.2", "-2.2 0"), "arm.osim");
  EXPECT_DOUBLE_EQ(knee.coordinates.at(0).factor, -1.0);
}

TEST(OpenSim, WhatIsNotTakenIsListed) {
  const std::string marker =
      "<MarkerSet><objects><Marker name=\"m1\"><location>0 0 0</location></Marker></objects></MarkerSet>";
  const std::string actuator =
      "<CoordinateActuator name=\"motor\"><coordinate>elbow_flexion</coordinate></CoordinateActuator>";
  std::string text = with(arm_text(), "</ForceSet>", "</ForceSet>" + marker);
  text = with(text, "</objects></ForceSet>", actuator + "</objects></ForceSet>");
  text = with(text, "<GeometryPath name=\"geometrypath\">", "<Flux>3</Flux><GeometryPath name=\"geometrypath\">");
  const Import import = parse_model(text, "arm.osim");
  const std::string told = all_not_taken(import);
  EXPECT_THAT(told, AllOf(HasSubstr("MarkerSet|arm|line "), HasSubstr("CoordinateActuator|motor|line "),
                          HasSubstr("Flux|biceps|line ")));
  const auto flux =
      std::find_if(import.not_taken.begin(), import.not_taken.end(), [](const auto& n) { return n.element == "Flux"; });
  ASSERT_NE(flux, import.not_taken.end());
  EXPECT_EQ(flux->count, 2u);
  EXPECT_EQ(flux->objects, (std::vector<std::string>{"biceps", "triceps"}));
}

TEST(OpenSim, PointsThatComeGoOrMoveAreTold) {
  const std::string conditional =
      "<ConditionalPathPoint name=\"c\"><socket_parent_frame>/bodyset/humerus</socket_parent_frame>"
      "<location>0.05 -0.2 0</location><socket_coordinate>/jointset/elbow/elbow_flexion</socket_coordinate>"
      "<range>1 2</range></ConditionalPathPoint>";
  const std::string moving =
      "<MovingPathPoint name=\"v\"><socket_parent_frame>/bodyset/humerus</socket_parent_frame>"
      "<socket_x_coordinate>/jointset/elbow/elbow_flexion</socket_x_coordinate><SimmSpline name=\"x_location\">"
      "<x>0 2</x><y>0.06 0.01</y></SimmSpline><location>0 -0.25 0</location></MovingPathPoint>";
  std::string text = arm_text();
  text.replace(text.find("<PathPoint name=\"biceps-P2\">"), 0, conditional + moving);
  const Import import = parse_model(text, "arm.osim");
  ASSERT_EQ(import.specimen.lines[0].points.size(), 3u);  // 0 lies outside of 1 .. 2
  EXPECT_LT((import.specimen.lines[0].points[1].position_m - Vec3(0.06, 0.0, -0.25)).norm(), 1e-12);
  EXPECT_THAT(all_not_taken(import), AllOf(HasSubstr("ConditionalPathPoint|c|"), HasSubstr("MovingPathPoint|v|")));
}

TEST(OpenSim, ACustomJointOfCurvesIsHeldAndTold) {
  const std::string custom = "<CustomJoint name=\"elbow\">";
  const std::string transform =
      "<SpatialTransform><TransformAxis name=\"rotation1\"><coordinates>elbow_flexion</coordinates>"
      "<axis>0 0 1</axis><LinearFunction name=\"function\"><coefficients>1 "
      "0</coefficients></LinearFunction></TransformAxis>"
      "<TransformAxis name=\"translation1\"><coordinates>elbow_flexion</coordinates><axis>1 0 0</axis>"
      "<SimmSpline name=\"function\"><x>0 1 2</x><y>0.001 0.004 "
      "0.006</y></SimmSpline></TransformAxis></SpatialTransform>";
  const std::string text =
      with(with(arm_text(), "<PinJoint name=\"elbow\">", custom), "</PinJoint>", transform + "</CustomJoint>");
  const Import import = parse_model(text, "arm.osim");
  EXPECT_LT((import.specimen.joints[0].centre_m - Vec3(0.001, 0.0, -0.3)).norm(), 1e-12);
  EXPECT_THAT(all_not_taken(import), HasSubstr("moves it by 5.0 mm over its range"));
}

TEST(OpenSim, AnotherVersionNamesTheRemedy) {
  EXPECT_THAT(refusal(with(arm_text(), "40000", "30000")),
              AllOf(HasSubstr("line 2"), HasSubstr("open the model with OpenSim 4 and save it")));
  EXPECT_THAT(refusal(with(arm_text(), " Version=\"40000\"", "")), HasSubstr("Version is \"\""));
  EXPECT_THAT(refusal("<html/>"), HasSubstr("begins with <html>"));
  EXPECT_THAT(refusal("<OpenSimDocument Version=\"40000\"/>"), HasSubstr("holds no <Model>"));
}

TEST(OpenSim, EveryBeginningOfAFileIsRefused) {
  const std::string text = arm_text();
  for (std::size_t size = 0; size + 30 < text.size(); size += 37) refusal(text.substr(0, size));
}

TEST(OpenSim, HugeAndDeepFilesAreRefused) {
  EXPECT_THAT(refusal(std::string(exchange::opensim::kLargestModel_bytes + 1, ' ')), HasSubstr("a model has at most"));
  std::string deep = "<OpenSimDocument Version=\"40000\"><Model>";
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  for (int i = 0; i < 100000; ++i) deep += "</a>";
  EXPECT_THAT(refusal(deep + "</Model></OpenSimDocument>"), HasSubstr("more than 64 deep"));
}

TEST(OpenSim, EntityBombsDoNothing) {
  std::string bomb = "<!DOCTYPE bomb [<!ENTITY a \"aaaaaaaaaa\">";
  for (char c = 'b'; c <= 'k'; ++c) {
    const std::string before(1, static_cast<char>(c - 1));
    bomb += "<!ENTITY " + std::string(1, c) + " \"";
    for (int i = 0; i < 10; ++i) bomb += "&" + before + ";";
    bomb += "\">";
  }
  const std::string text = with(arm_text(), "<OpenSimDocument", bomb + "]>\n<OpenSimDocument");
  EXPECT_THAT(refusal(text), HasSubstr("has a DOCTYPE"));
  const Import import = parse_model(with(arm_text(), "\"arm\"", "\"&k;\""), "arm.osim");
  EXPECT_EQ(import.specimen.name, "&k;");  // as it stands
}

TEST(OpenSim, BytesMustBeUtf8) {
  for (const char* name : {"\xff", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe2\x82"}) {
    EXPECT_THAT(refusal(with(arm_text(), "\"arm\"", "\"" + std::string(name) + "\"")), HasSubstr("is no UTF-8"));
  }
  const Import import =
      parse_model(with(arm_text(), "\"arm\"", "\"\xc3\xa4 \xe2\x82\xac \xf0\x9f\xa6\xb4\""), "arm.osim");
  EXPECT_EQ(import.specimen.name, "\xc3\xa4 \xe2\x82\xac \xf0\x9f\xa6\xb4");
}

TEST(OpenSim, NumbersMustBeFinite) {
  EXPECT_THAT(refusal(with(arm_text(), "<mass>2</mass>", "<mass>nan</mass>")),
              AllOf(HasSubstr("mass of humerus"), HasSubstr("\"nan\"; must be a finite number")));
  EXPECT_THAT(refusal(with(arm_text(), "600", "1e999")), HasSubstr("must be a finite number"));
  EXPECT_THAT(refusal(with(arm_text(), "0.02 0.003 0.02 0 0 0", "1 2")), HasSubstr("must be six"));
  EXPECT_THAT(refusal(with(arm_text(), "0 2.2", "2.2 0")), HasSubstr("must rise"));
  EXPECT_THAT(refusal(with(arm_text(), "<radius>0.02", "<radius>-1")), HasSubstr("greater than 0"));
}

TEST(OpenSim, ReferencesMustLeadSomewhere) {
  EXPECT_THAT(refusal(with(arm_text(), "<socket_child_frame>/bodyset/forearm", "<socket_child_frame>/bodyset/forarm")),
              AllOf(HasSubstr("PinJoint of elbow"), HasSubstr("the nearest is \"forearm\"")));
  EXPECT_THAT(refusal(with(arm_text(), "<wrap_object>olecranon", "<wrap_object>olecranom")),
              AllOf(HasSubstr("which no body has"), HasSubstr("the nearest is \"olecranon\"")));
  EXPECT_THAT(refusal(with(arm_text(), "<socket_parent>/bodyset/humerus", "<socket_parent>humerus_offset")),
              HasSubstr("frames that hang on each other"));
}

TEST(OpenSim, JointsMustMakeATreeOnTheGround) {
  EXPECT_THAT(refusal(with(arm_text(), "<socket_child_frame>/bodyset/humerus", "<socket_child_frame>/bodyset/forearm")),
              HasSubstr("already hangs on the joint shoulder"));
  const std::string ring = with(arm_text(), "<socket_parent_frame>/ground", "<socket_parent_frame>/bodyset/forearm");
  EXPECT_THAT(refusal(ring), HasSubstr("no joint hangs on the ground"));
  const std::string extra =
      "<Body name=\"third\"><mass>1</mass><inertia>1 1 1 0 0 0</inertia></Body></objects></BodySet>";
  const std::string joint =
      "<WeldJoint "
      "name=\"base\"><socket_parent_frame>/ground</socket_parent_frame><socket_child_frame>/bodyset/third</"
      "socket_child_frame></WeldJoint></objects></JointSet>";
  EXPECT_THAT(refusal(with(with(ring, "</objects></BodySet>", extra), "</objects></JointSet>", joint)),
              HasSubstr("in a ring of joints that never comes to the ground"));
}

TEST(OpenSim, AMuscleOutsideOfItsCurvesIsLeftOutAndTold) {
  const Import import =
      parse_model(with(arm_text(), "<tendon_slack_length>0.2<", "<tendon_slack_length>0.5<"), "arm.osim");
  EXPECT_TRUE(import.specimen.muscles.empty());
  EXPECT_THAT(all_not_taken(import), HasSubstr("left out: with its tendon just straight"));
  EXPECT_EQ(import.scene_joint, "");
}

TEST(OpenSim, BrokenBytesAreReadOrRefused) {
  Mutator mutator;
  for (int i = 0; i < 400; ++i) {
    try {
      parse_model(mutator.broken(arm_text()), "arm.osim");
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::BadData);
      EXPECT_EQ(std::string(error.what()).rfind("arm.osim: ", 0), 0u) << error.what();
    }
  }
}

}  // namespace
}  // namespace myotact::testing

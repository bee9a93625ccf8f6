// How bodies on hinges move in both engines, against closed forms.

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/error.h"
#include "layer/engine_rig.h"

namespace myotact::layer {
namespace {

using namespace testing;

class EngineMotion : public BothEngines {};
INSTANTIATE_TEST_SUITE_P(, EngineMotion, ::testing::Values(Kind::Bullet, Kind::Simulation),
                         [](const auto& kind) { return kind.param == Kind::Bullet ? "bullet" : "myotact"; });

constexpr int kPlate = 1;  // surface and body
constexpr double kArm_m = 1.0;

double mass_kg(const anatomy::Specimen& specimen) {
  return specimen.bodies[kPlate].mass_kg;
}
/// About the hinge.
double inertia_kg_m2(const anatomy::Specimen& specimen) {
  return specimen.bodies[kPlate].inertia_kg_m2[1] + mass_kg(specimen) * kArm_m * kArm_m;
}
double angle_rad(const Engine& engine) {
  const Mat3 turned = engine.body_pose(kPlate).rotation;
  return std::atan2(turned(2, 0), turned(0, 0));
}

/// Mean time between upward passages of `level`, of equally spaced values, linearly between them.
double mean_period_s(const std::vector<double>& values, double level, double dt_s) {
  double first_s = -1.0, last_s = 0.0;
  int periods = -1;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!(values[i - 1] < level && values[i] >= level)) continue;
    last_s = dt_s * (static_cast<double>(i - 1) + (level - values[i - 1]) / (values[i] - values[i - 1]));
    if (first_s < 0.0) first_s = last_s;
    ++periods;
  }
  return (last_s - first_s) / periods;
}

TEST_P(EngineMotion, a_pendulum_has_the_period_of_a_physical_pendulum) {
  const anatomy::Specimen specimen = pendulum();
  // Gravity pulls along the arm, but for 0.05 rad: it swings by as much to both sides of where it would hang.
  const double tilt_rad = 0.05;
  const auto engine =
      make_engine(GetParam(), specimen, kGravity_m_s2 * Vec3(std::cos(tilt_rad), 0.0, std::sin(tilt_rad)));
  std::vector<double> angles_rad;
  for (int step = 0; step < 1200; ++step) {
    engine->advance();
    angles_rad.push_back(angle_rad(*engine));
  }
  const double small_s =
      2.0 * std::numbers::pi * std::sqrt(inertia_kg_m2(specimen) / (mass_kg(specimen) * kGravity_m_s2 * kArm_m));
  const double period_s = small_s * (1.0 + tilt_rad * tilt_rad / 16.0);
  // Our second-order rule at 60 Hz: relative error (w dt)^2 / 3 = 9e-4; Bullet's at 240 Hz: (w dt)^2 / 24 = 7e-6.
  EXPECT_NEAR(mean_period_s(angles_rad, tilt_rad, engine->step_s()), period_s, 1.5e-3 * period_s);
}

TEST_P(EngineMotion, a_plate_that_is_let_go_falls_as_its_inertia_says) {
  const anatomy::Specimen specimen = pendulum();
  const auto engine = make_engine(GetParam(), specimen);
  const double h_s = engine->step_s();
  double last_rad = 0.0, before_rad = 0.0;
  for (int step = 0; step < 6; ++step) {
    engine->advance();
    before_rad = std::exchange(last_rad, angle_rad(*engine));
  }
  // 0.1 s: the arm turns by 0.05 rad, whose cosine is 0.1 % from 1. Bullet's rule moves a body by the velocity at the
  // end of a substep: half a substep ahead.
  const double acceleration_rad_s2 = -mass_kg(specimen) * kGravity_m_s2 * kArm_m / inertia_kg_m2(specimen);
  EXPECT_NEAR((last_rad - before_rad) / h_s, acceleration_rad_s2 * 5.5 * h_s,
              std::abs(acceleration_rad_s2) * (0.5 * h_s / 4 + 1e-4));
}

/// The hand's spring on the plate's centre of mass.
messages::ToolState pull(const anatomy::Specimen& specimen, double force_N) {
  messages::ToolState tool = tool_at(specimen.bodies[kPlate].com_m + Vec3(0.0, 0.0, 0.01));
  tool.grabbed_body = kPlate;
  tool.body_stiffness_N_m = 800.0;
  tool.body_point_rest_m = to_array(specimen.bodies[kPlate].com_m);
  tool.body_target_world_m = to_array(specimen.bodies[kPlate].com_m + Vec3(0.0, 0.0, force_N / 800.0));
  return tool;
}

TEST_P(EngineMotion, a_plate_pulled_with_its_weight_stays) {
  const anatomy::Specimen specimen = plain_specimen("plate");
  const auto engine = make_engine(GetParam(), specimen);
  const double weight_N = mass_kg(specimen) * kGravity_m_s2;
  for (int step = 0; step < 300; ++step) {
    engine->move_tool(0, pull(specimen, weight_N));
    engine->advance();
    ASSERT_NEAR(angle_rad(*engine), 0.0, 1e-9) << step;
  }
  messages::LocalModel model;
  engine->write_surface(0, model);
  EXPECT_EQ(model.grip.body, kPlate);
  EXPECT_NEAR(model.grip.force_world_N[2], weight_N, 1e-6);
}

/// The force methods that go by reports name no triangle: the place alone.
TEST_P(EngineMotion, a_press_known_by_its_place_balances_the_weight_from_below) {
  const anatomy::Specimen specimen = pendulum();
  const auto engine = make_engine(GetParam(), specimen);
  const double weight_N = mass_kg(specimen) * kGravity_m_s2;
  const Vec3 below_m = specimen.bodies[kPlate].com_m - Vec3(0.0, 0.0, 0.005);
  messages::ToolState tool = tool_at(below_m - Vec3(0.0, 0.0, 0.004));
  tool.contact.surface = kPlate;
  tool.contact.normal_world = {0.0, 0.0, -1.0};
  tool.contact.stiffness_N_m = 800.0;
  tool.contact.target_world_m = to_array(below_m + Vec3(0.0, 0.0, weight_N / 800.0));
  tool.touched_world_m = to_array(below_m);
  for (int step = 0; step < 120; ++step) {
    engine->move_tool(0, tool);
    engine->advance();
    ASSERT_NEAR(angle_rad(*engine), 0.0, 1e-9) << step;
  }
}

TEST_P(EngineMotion, the_grip_tells_the_mobility_of_a_point_on_a_hinge) {
  const anatomy::Specimen specimen = plain_specimen("plate");
  const auto engine = make_engine(GetParam(), specimen);
  engine->move_tool(0, pull(specimen, mass_kg(specimen) * kGravity_m_s2));
  engine->advance();
  messages::LocalModel model;
  engine->write_surface(0, model);
  EXPECT_NEAR(model.grip.mobility_1_kg[8], kArm_m * kArm_m / inertia_kg_m2(specimen), 1e-6);
  EXPECT_NEAR(model.grip.mobility_1_kg[0], 0.0, 1e-9);
}

TEST_P(EngineMotion, a_plate_on_nothing_stops_at_the_end_of_its_range) {
  const auto engine = make_engine(GetParam(), plain_specimen("plate"));
  for (int step = 0; step < 600; ++step) engine->advance();
  EXPECT_LT(std::abs(angle_rad(*engine)), 0.0065);  // ours yields 5.5 mrad
}

TEST_P(EngineMotion, a_target_far_away_does_not_blow_up) {
  const anatomy::Specimen specimen = plain_specimen("plate");
  const auto engine = make_engine(GetParam(), specimen);
  messages::ToolState tool = pull(specimen, 800.0);
  tool.body_stiffness_N_m = 1e5;  // far more than a substep of 4 ms can take explicitly
  for (int step = 0; step < 300; ++step) {
    engine->move_tool(0, tool);
    engine->advance();
    ASSERT_LT(std::abs(angle_rad(*engine)), 0.9);  // the target lies at 45 degrees
  }
}

TEST_P(EngineMotion, the_same_calls_give_the_same_bits) {
  const anatomy::Specimen specimen = plain_specimen("plate");
  std::array<std::vector<double>, 2> runs;
  for (std::vector<double>& run : runs) {
    const auto engine = make_engine(GetParam(), specimen);
    for (int step = 0; step < 200; ++step) {
      engine->move_tool(0, pull(specimen, 0.5 + 0.01 * step));
      engine->advance();
      messages::ReportedContacts reported;
      engine->report_contacts(0, reported);
      run.push_back(angle_rad(*engine));
      run.push_back(reported.contacts[0].penetration_m);
    }
  }
  EXPECT_EQ(runs[0], runs[1]);
}

TEST(BulletEngine, what_it_cannot_hold_is_refused_by_name) {
  if (!has_bullet()) GTEST_SKIP() << "built without Bullet (libbullet-dev)";
  anatomy::Specimen specimen = plain_specimen("plate");
  EXPECT_THROW(make_bullet_engine(specimen, {.step_s = 0.0}), Error);
  specimen.joints[0].type = anatomy::JointType::Ball;
  EXPECT_THROW(make_bullet_engine(specimen), Error);
}

TEST(BulletEngine, where_it_is_missing_the_package_is_named) {
  if (has_bullet()) GTEST_SKIP() << "built with Bullet";
  try {
    make_bullet_engine(plain_specimen("plane"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::Unavailable);
    EXPECT_NE(std::string(error.what()).find("libbullet-dev"), std::string::npos);
  }
}

}  // namespace
}  // namespace myotact::layer

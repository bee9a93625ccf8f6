// What the engines report of a tool on a plane, at an edge and past it, against closed forms.

#include <cmath>

#include "layer/engine_rig.h"

namespace myotact::layer {
namespace {

using namespace testing;

constexpr double kRounding_m = 1e-9;

class EngineContacts : public BothEngines {};
INSTANTIATE_TEST_SUITE_P(, EngineContacts, ::testing::Values(Kind::Bullet, Kind::Simulation),
                         [](const auto& kind) { return kind.param == Kind::Bullet ? "bullet" : "myotact"; });

TEST_P(EngineContacts, a_sphere_on_the_plane_is_as_deep_as_it_is) {
  const auto engine = make_engine(GetParam(), plain_specimen("plane"));
  // In a triangle, over an edge between two of them, over a corner where six meet.
  for (const Vec3& place_m : {Vec3(0.011, 0.004, 0.0), Vec3(0.0, 0.013, 0.0), Vec3(0.03, 0.03, 0.0)}) {
    for (const double depth_m : {1e-6, 1e-4, 1e-3, 4e-3}) {
      const auto reported = report_at(*engine, place_m + Vec3(0.0, 0.0, kRadius_m - depth_m));
      ASSERT_GE(reported.count, 1) << depth_m;
      const messages::ReportedContact& deepest = reported.contacts[0];
      EXPECT_NEAR(deepest.penetration_m, depth_m, kRounding_m);
      EXPECT_NEAR((to_vec3(deepest.normal_world) - Vec3::UnitZ()).norm(), 0.0, 1e-9);
      EXPECT_NEAR((to_vec3(deepest.point_world_m) - place_m).norm(), 0.0, kRounding_m);
      EXPECT_EQ(deepest.surface, 0);
    }
  }
  EXPECT_EQ(report_at(*engine, {0.011, 0.004, kRadius_m + 1e-6}).count, 0);
}

TEST_P(EngineContacts, a_sphere_over_an_edge_is_pushed_away_from_the_edge) {
  const auto engine = make_engine(GetParam(), plain_specimen("plane"));
  const double aside_m = 0.003, above_m = 0.002;  // of the edge x = 0.15
  const double away_m = std::hypot(aside_m, above_m);
  const auto reported = report_at(*engine, {0.15 + aside_m, 0.004, above_m});
  ASSERT_GE(reported.count, 1);
  EXPECT_NEAR(reported.contacts[0].penetration_m, kRadius_m - away_m, kRounding_m);
  const Vec3 normal = Vec3(aside_m, 0.0, above_m) / away_m;
  EXPECT_NEAR((to_vec3(reported.contacts[0].normal_world) - normal).norm(), 0.0, 1e-6);
}

TEST_P(EngineContacts, a_plate_on_its_hinge_is_met_where_it_is) {
  const anatomy::Specimen specimen = plain_specimen("plate");
  const auto engine = make_engine(GetParam(), specimen, Vec3::Zero());
  engine->advance();
  const double top_m = specimen.bodies[1].com_m.z() + 0.005;
  // Hulls go through Bullet's iterations (GJK), which end at 1e-6 of the distance of the bodies' middles.
  const auto reported = report_at(*engine, {0.02, 0.01, top_m + kRadius_m - 1e-3});
  ASSERT_GE(reported.count, 1);
  EXPECT_EQ(reported.contacts[0].surface, 1);
  EXPECT_NEAR(reported.contacts[0].penetration_m, 1e-3, 1e-7);
  EXPECT_NEAR(reported.contacts[0].normal_world[2], 1.0, 1e-9);
}

TEST_P(EngineContacts, a_place_that_is_none_meets_nothing) {
  const auto engine = make_engine(GetParam(), plain_specimen("plane"));
  EXPECT_EQ(report_at(*engine, Vec3::Constant(std::nan(""))).count, 0);
  engine->advance();
}

TEST_P(EngineContacts, the_surface_near_the_tool_is_written) {
  const auto engine = make_engine(GetParam(), plain_specimen("plane"));
  engine->move_tool(0, tool_at({0.01, 0.01, 0.006}));
  messages::LocalModel model;
  engine->write_surface(0, model);
  EXPECT_GT(model.triangle_count, 20);
  EXPECT_GT(model.coverage_radius_m, 0.02);
  EXPECT_EQ(model.triangles[0].tissue.tissue, messages::Tissue::Bone);
  EXPECT_EQ(model.grip.body, 0);
  EXPECT_NEAR((to_vec3(model.grip.position_world_m) - Vec3(0.01, 0.01, 0.0)).norm(), 0.0, 1e-12);
}

TEST(BulletEngine, a_box_as_tool_is_as_deep_as_its_lowest_face) {
  if (!has_bullet()) GTEST_SKIP() << "built without Bullet (libbullet-dev)";
  const auto engine = make_bullet_engine(plain_specimen("plane"), {.tools = {{ToolBody::Shape::Box, kRadius_m}}});
  const auto reported = report_at(*engine, {0.011, 0.004, kRadius_m - 1e-3});
  ASSERT_GE(reported.count, 1);
  EXPECT_NEAR(reported.contacts[0].penetration_m, 1e-3, 1e-7);
  EXPECT_NEAR(reported.contacts[0].normal_world[2], 1.0, 1e-9);
}

}  // namespace
}  // namespace myotact::layer

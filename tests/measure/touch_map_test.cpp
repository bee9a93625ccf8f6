// Touch at random places of a block of muscle: where they lie, what is found there, and that the number of threads
// changes nothing.

#include "measure/fidelity/touch_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "measure/fidelity/touch_map_report.h"
#include "support/synthetic_specimen.h"

namespace myotact::measure {
namespace {

constexpr double kRadius_m = 3e-3;

/// A block 60 mm wide, held at both ends.
scene::Scene block_scene(int workers) {
  testing::BarShape shape;
  shape.width_m = 0.06;
  shape.cells = {6, 3, 3};
  scene::Scene scene;
  scene.name = "block";
  scene.specimen = testing::single_muscle(shape);
  scene.settings.workers = workers;
  scene.joints.resize(scene.specimen.joints.size());
  for (scene::JointSetting& joint : scene.joints) joint.locked = true;
  scene.activations.assign(scene.specimen.muscles.size(), 0.0);
  scene.tools.resize(1);
  scene.tools.front().radius_m = kRadius_m;
  return scene;
}

TouchMap mapped(int workers, std::uint64_t seed = 1) {
  TouchMapRequest request;
  request.places = 3;
  request.seed = seed;
  return map_touch(block_scene(workers), request, {});
}

TEST(TouchPlaces, LieOnTheSkinByAreaAndTheirDirectionsAreUnit) {
  const scene::Scene scene = block_scene(1);
  const simulation::Simulation simulation(scene.specimen, scene.settings);
  const std::vector<TouchPlace> places = touch_places(scene.specimen, simulation, kRadius_m, 400, 7);
  ASSERT_EQ(places.size(), 400u);
  Eigen::AlignedBox3d box;
  for (const Vec3& x : simulation.skin_world_m(0)) box.extend(x);
  const Vec3 size_m = box.sizes();
  Vec3 by_side = Vec3::Zero();
  for (const TouchPlace& place : places) {
    EXPECT_NEAR(place.normal.norm(), 1.0, 1e-12);
    EXPECT_NEAR(place.along.norm(), 1.0, 1e-12);
    EXPECT_NEAR(place.along.dot(place.normal), 0.0, 1e-12);
    int axis = 0;
    EXPECT_GT(place.normal.cwiseAbs().maxCoeff(&axis), 0.999);
    const double wall_m = place.normal[axis] > 0.0 ? box.max()[axis] : box.min()[axis];
    EXPECT_NEAR(place.position_m[axis], wall_m, 1e-9) << "the normal points out of the block";
    by_side[axis] += 1.0;
  }
  // Pairs of sides in proportion to their areas: three standard deviations of 400 draws are 30.
  const Vec3 areas_m2(size_m.y() * size_m.z(), size_m.x() * size_m.z(), size_m.x() * size_m.y());
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(by_side[axis], 400.0 * areas_m2[axis] / areas_m2.sum(), 30.0);
}

TEST(TouchPlaces, WhatLiesUnderAnotherMuscleIsLeftOut) {
  scene::Scene scene = block_scene(1);
  testing::BarShape cover;
  cover.width_m = 0.06;
  cover.cells = {6, 3, 3};
  cover.origin_m.z() += 0.062;  // 2 mm above the block: no tool comes between
  scene.specimen.muscles.push_back(testing::bar_muscle("cover", cover));
  scene.specimen.lines.push_back(scene.specimen.lines.front());
  scene.specimen.lines.back().muscle = 1;
  const simulation::Simulation simulation(scene.specimen, scene.settings);
  const std::vector<TouchPlace> places = touch_places(scene.specimen, simulation, kRadius_m, 50, 1);
  EXPECT_EQ(places.size(), 100u);
  for (const TouchPlace& place : places) {
    const double towards_the_other = place.muscle == 0 ? place.normal.z() : -place.normal.z();
    EXPECT_LT(towards_the_other, 0.5);
  }
}

TEST(TouchMap, OfABlockIsTheSameWithAnyNumberOfThreads) {
  const TouchMap one = mapped(1), two = mapped(2), other = mapped(1, 2);
  EXPECT_EQ(touch_map_json(one), touch_map_json(two));
  EXPECT_EQ(touch_map_csv(one), touch_map_csv(two));
  EXPECT_NE(touch_map_json(one), touch_map_json(other));
  std::fputs(touch_map_text(one).c_str(), stdout);
  ASSERT_EQ(one.places.size(), 3u);
  for (const TouchedPlace& touched : one.places) {
    EXPECT_GT(touched.felt_peak_N, 0.1);
    EXPECT_LT(touched.error_share, 0.15);
    EXPECT_LT(touched.held_swing_N, 0.02);
  }
}

TEST(TouchMap, StoppedItKeepsWhatItHas) {
  RunWatch watch;
  int asked = 0;
  watch.stopped = [&] { return ++asked > 1; };
  TouchMapRequest request;
  request.places = 3;
  const TouchMap map = map_touch(block_scene(1), request, watch);
  EXPECT_EQ(map.places.size(), 1u);
  EXPECT_FALSE(map.complete);
  EXPECT_NE(touch_map_text(map).find("interrupted"), std::string::npos);
}

TEST(TouchMap, AVerdictIsThatOfTheWorseFigure) {
  TouchedPlace place;
  place.error_share = 0.04;
  place.held_swing_N = 0.03;
  EXPECT_EQ(worst_grade(grade(place)), Grade::Fair);
  place.error_share = 0.2;
  EXPECT_EQ(worst_grade(grade(place)), Grade::Poor);
  place.error_share = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(worst_grade(grade(place)), Grade::Unknown);
  const TouchMap map{"limb", "", "", {"one", "two"}, 1, {place}, true, {}};
  EXPECT_EQ(places_of(map, Grade::Unknown), 1);
  EXPECT_EQ(places_of(map, Grade::Unknown, 0), 0) << "a place without a muscle is none of this one's";
  EXPECT_TRUE(nlohmann::json::parse(touch_map_json({"limb", "", "", {"one"}, 1, {}, true, {}}))["places"].empty());
  EXPECT_NE(touch_map_text(map).find("lies under others"), std::string::npos);
}

}  // namespace
}  // namespace myotact::measure

#include "prepare/partition/lay_tendons.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/triangle_mesh.h"
#include "prepare/field/signed_distance.h"
#include "prepare/part/film.h"
#include "prepare/partition/cut_parts.h"
#include "prepare/surface/surface_pieces.h"

// A muscle that ends in the air, 18 mm from its bone, with nothing or another muscle between them.

namespace myotact::prepare {
namespace {

using geometry::TriangleMesh;

constexpr double kStep_m = 1e-3, kArea_m2 = 1.2e-5;  // a tendon of 3.9 mm
constexpr std::uint16_t kBone = 1, kMuscle = 2, kWall = 3;
const Vec3 kBoneMiddle_m(-0.016, 0.0, 0.0), kMuscleMiddle_m(0.016, 0.0, 0.0);
constexpr double kBoneRadius_m = 8e-3, kMuscleRadius_m = 6e-3;

/// A sheet between the two [m].
struct Wall {
  double half_m = -1.0;  // of its thickness; less than 0: there is none
  double radius_m = 0.0;
};
constexpr Wall kNoWall, kSmallWall{2e-3, 6e-3}, kFilmAcross{1e-3, 1.0};

/// Depth [m] of the three in order.
std::vector<double> depths_m(const Vec3& p, const Wall& wall) {
  return {kBoneRadius_m - (p - kBoneMiddle_m).norm(), kMuscleRadius_m - (p - kMuscleMiddle_m).norm(),
          std::min(wall.half_m - std::abs(p.x()), wall.radius_m - std::hypot(p.y(), p.z()))};
}

PartVolume volume(const Wall& wall) {
  PartVolume volume{{}, {"bone", "muscle", "wall"}, {}, {}};
  volume.lattice.counts = {65, 41, 41};
  volume.lattice.steps_m = kStep_m * Mat3::Identity();
  volume.lattice.origin_m = Vec3(-0.032, -0.020, -0.020);
  for (std::size_t point = 0; point < volume.lattice.size(); ++point) {
    const std::vector<double> depth_m = depths_m(place_m(volume.lattice, point), wall);
    std::uint16_t label = 0;
    double margin = kLargestMargin;
    for (std::size_t p = 0; p < depth_m.size(); ++p) {
      if (depth_m[p] > 0.0) label = static_cast<std::uint16_t>(p + 1);
      margin = std::min(margin, std::abs(depth_m[p]) / kStep_m);
    }
    volume.labels.push_back(label);
    volume.margins.push_back(static_cast<std::uint8_t>(std::lround(kMarginsPerStep * margin)));
  }
  return volume;
}

/// The muscle is fixed to the bone, on the side that faces it.
std::vector<MuscleData> recipe(const std::string& bone = "bone") {
  std::vector<MuscleData> muscles(2);
  muscles[0].mechanics.key = "muscle";
  muscles[0].origins.push_back({{bone}, -1, kBoneMiddle_m + kBoneRadius_m * Vec3::UnitX(), kArea_m2});
  muscles[1].mechanics.key = "wall";
  return muscles;
}

TriangleMesh surface_of(const PartVolume& volume, std::uint16_t label) {
  return cut_parts(volume, 1).fine[label - std::size_t{1}];
}

TEST(LayTendons, AMuscleInTheAirGetsARoundTendonOfItsAttachmentsArea) {
  PartVolume parts = volume(kNoWall);
  const double before_m3 = geometry::enclosed_volume_m3(surface_of(parts, kMuscle));
  const double bone_before_m3 = geometry::enclosed_volume_m3(surface_of(parts, kBone));
  const std::vector<LaidTendon> laid = lay_tendons(parts, recipe());
  ASSERT_EQ(laid.size(), 1U);
  EXPECT_EQ(laid[0].muscle, "muscle");
  EXPECT_EQ(laid[0].bone, "bone");
  EXPECT_NEAR(laid[0].gap_m, 0.018, 1.5 * kStep_m);
  EXPECT_NEAR(laid[0].length_m, 0.018, 1.5 * kStep_m);
  const TriangleMesh muscle = surface_of(parts, kMuscle);
  EXPECT_EQ(geometry::bad_edge_count(muscle), 0);
  EXPECT_EQ(pieces_of(muscle).size(), 1U);
  EXPECT_EQ(genus(muscle), 0);
  // A cylinder of that section, less what its ends share with the two balls' round sides.
  const double tendon_m3 = geometry::enclosed_volume_m3(muscle) - before_m3;
  EXPECT_NEAR(tendon_m3 / (kArea_m2 * 0.018), 1.0, 0.12);
  EXPECT_NEAR(geometry::enclosed_volume_m3(surface_of(parts, kBone)) / bone_before_m3, 1.0, 0.01);
  // Its middle is as thick as wanted, all round.
  const SignedDistance distance(muscle);
  const double radius_m = std::sqrt(kArea_m2 / std::numbers::pi);
  for (int i = 0; i < 12; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 12;
    const Vec3 at_m(0.002, radius_m * std::cos(angle), radius_m * std::sin(angle));
    EXPECT_NEAR(distance(at_m), 0.0, 0.3 * kStep_m) << i;
  }
}

TEST(LayTendons, TheWayGoesRoundAnotherMuscle) {
  PartVolume parts = volume(kSmallWall);
  const std::vector<LaidTendon> laid = lay_tendons(parts, recipe());
  ASSERT_EQ(laid.size(), 1U);
  EXPECT_GT(laid[0].length_m, 0.02);
  for (const std::uint16_t label : {kMuscle, kWall}) {
    const TriangleMesh surface = surface_of(parts, label);
    EXPECT_EQ(pieces_of(surface).size(), 1U);
    EXPECT_EQ(genus(surface), 0);
  }
}

TEST(LayTendons, WhatIsThinIsNotPierced) {
  PartVolume parts = volume(kFilmAcross);
  const Labels before = parts.labels;
  EXPECT_TRUE(lay_tendons(parts, recipe()).empty());
  EXPECT_EQ(parts.labels, before);
}

/// Where two tendons meet, the first one stays whole.
TEST(LayTendons, ASecondTendonLeavesTheFirstWhole) {
  PartVolume parts = volume(kNoWall);
  ASSERT_EQ(lay_tendons(parts, recipe()).size(), 1U);
  // A ball that another muscle is now: its tendon is to run to the bone's far side, along the first one and round it.
  parts.keys.emplace_back("second");
  constexpr std::uint16_t kSecond = 4;
  const Vec3 second_m(0.002, 0.012, 0.0);
  for (std::size_t point = 0; point < parts.labels.size(); ++point) {
    const double depth = (4e-3 - (place_m(parts.lattice, point) - second_m).norm()) / kStep_m;
    if (depth > 0.0) parts.labels[point] = kSecond;
    const double margin = std::min(parts.margins[point] / kMarginsPerStep, std::abs(depth));
    parts.margins[point] = static_cast<std::uint8_t>(std::lround(kMarginsPerStep * margin));
  }
  std::vector<MuscleData> muscles = recipe();
  muscles.push_back(muscles[0]);
  muscles.back().mechanics.key = "second";
  muscles.back().origins[0].point_m = kBoneMiddle_m + kBoneRadius_m * Vec3(0.8, -0.6, 0.0);
  const std::vector<LaidTendon> laid = lay_tendons(parts, muscles);
  ASSERT_EQ(laid.size(), 1U);
  EXPECT_EQ(laid[0].muscle, "second");
  for (const std::uint16_t label : {kMuscle, kSecond}) {
    const TriangleMesh surface = surface_of(parts, label);
    EXPECT_EQ(geometry::bad_edge_count(surface), 0) << label;
    EXPECT_EQ(pieces_of(surface).size(), 1U) << label;
    EXPECT_EQ(genus(surface), 0) << label;
  }
}

TEST(LayTendons, NothingIsLaidWhereNothingIsMissingOrNotThere) {
  PartVolume parts = volume(kNoWall);
  const Labels before = parts.labels;
  EXPECT_TRUE(lay_tendons(parts, recipe("femur")).empty());  // a bone that the volume has not
  std::vector<MuscleData> trunk = recipe();
  trunk[0].origins[0].bones.clear();
  EXPECT_TRUE(lay_tendons(parts, trunk).empty());
  EXPECT_EQ(parts.labels, before);
  EXPECT_EQ(lay_tendons(parts, recipe()).size(), 1U);
  EXPECT_TRUE(lay_tendons(parts, recipe()).empty());  // it is fixed now
}

}  // namespace
}  // namespace myotact::prepare

// Sweeps: their points, what a point leaves, the table.

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/data_folder.h"
#include "core/file.h"
#include "measure/sweep/sweep_point.h"
#include "support/complaint.h"
#include "support/temporary_folder.h"

namespace myotact::measure {
namespace {

using nlohmann::json;
using testing::complaint;
using ::testing::HasSubstr;

class Sweep : public ::testing::Test {
 protected:
  SweepPlan load(const json& sweep) const {
    write_file(folder_.path() / "sweep.json", sweep.dump());
    return load_sweep(folder_.path() / "sweep.json", "1");
  }
  testing::TemporaryFolder folder_;
};

json shipped_sweep() {
  return json::parse(read_file(data_folder() / "assets" / "cases" / "sweep_elbow.json"));
}

TEST_F(Sweep, GridsTurnTheLastKeyFastest) {
  const SweepPlan plan = load(shipped_sweep());
  const auto points = sweep_points(plan);
  ASSERT_EQ(points.size(), 45U);
  EXPECT_EQ(points[0], (std::vector<double>{0.0, 0.0, 60.0}));
  EXPECT_EQ(points[1], (std::vector<double>{0.0, 0.0, 80.0}));
  EXPECT_EQ(points[3], (std::vector<double>{0.0, 0.5, 60.0}));
  EXPECT_EQ(points[44], (std::vector<double>{0.4, 1.0, 100.0}));
}

TEST_F(Sweep, SamplesHaveOneInEveryStripeOfEveryKey) {
  json sweep = shipped_sweep();
  sweep["samples"] = {{"count", 50}, {"seed", 3}};
  sweep["parameters"] = {{{"key", "joints.elbow.q_rad"}, {"low", 0.0}, {"high", 0.5}},
                         {{"key", "co_contraction.common"}, {"low", 0.0}, {"high", 1.0}}};
  const SweepPlan plan = load(sweep);
  const auto points = sweep_points(plan);
  ASSERT_EQ(points.size(), 50U);
  for (std::size_t k = 0; k < 2; ++k) {
    std::vector<int> stripes;
    for (const auto& point : points) stripes.push_back(static_cast<int>(point[k] / plan.keys[k].high * 50.0));
    std::sort(stripes.begin(), stripes.end());
    for (int i = 0; i < 50; ++i) EXPECT_EQ(stripes[static_cast<std::size_t>(i)], i);
  }
  EXPECT_EQ(points, sweep_points(plan));
}

TEST_F(Sweep, APointIsReadAsItWasWritten) {
  const SweepPlan plan = load(shipped_sweep());
  const SweepResult result = measure_point(plan, sweep_points(plan)[4], 1);
  EXPECT_EQ(result.error, "");
  EXPECT_TRUE(std::isfinite(result.quantities[0]));
  write_file(folder_.path() / point_file_name(4), point_json(plan, 4, result));
  const auto again = read_point(plan, 4, folder_.path());
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->quantities, result.quantities);
  EXPECT_FALSE(read_point(plan, 5, folder_.path()).has_value());
  SweepPlan other = plan;
  other.hash = "x";
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { read_point(other, 4, folder_.path()); }),
              HasSubstr("is another sweep's"));
}

TEST_F(Sweep, WhatCannotBeIsARowWithItsReason) {
  const SweepPlan plan = load(shipped_sweep());
  const SweepResult result = measure_point(plan, {3.0, 0.5, 60.0}, 1);
  EXPECT_THAT(result.error, HasSubstr("q_rad"));
  EXPECT_TRUE(std::isnan(result.quantities[0]));
}

TEST_F(Sweep, WrongSweepsAreBadData) {
  json sweep = shipped_sweep();
  sweep["quantities"] = {"stiffness.K_shur_Nm_rad"};
  const SweepPlan plan = load(sweep);
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { measure_point(plan, sweep_points(plan)[0], 1); }),
              HasSubstr("the nearest is \"stiffness.K_schur_Nm_rad\""));
  sweep["quantities"] = {"K"};
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { load(sweep); }), HasSubstr("must begin with"));
  sweep = shipped_sweep();
  sweep["parameters"][1]["key"] = "joints.elbow.q_rad";
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { load(sweep); }), HasSubstr("there twice"));
}

}  // namespace
}  // namespace myotact::measure

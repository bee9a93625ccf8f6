#include "measure/stiffness_sweep.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "measure/hinge_scene.h"
#include "measure/stiffness_cell.h"
#include "support/complaint.h"

namespace myotact::measure {
namespace {

using myotact::testing::hinge_scene;
using ::testing::HasSubstr;

std::string bytes_of(const std::vector<StiffnessRow>& rows) {
  return stiffness_csv(rows) + stiffness_json(rows).dump();
}

const SweepGrid kGrid{{-0.05, 0.1}, {0.0, 0.3, 1.0}};

TEST(StiffnessSweep, ARowDependsNeitherOnThreadsNorOnTheOtherCells) {
  const auto rows = sweep_stiffness(hinge_scene(1), kGrid);
  ASSERT_EQ(rows.size(), 6u);
  const std::string whole = bytes_of(rows);
  EXPECT_EQ(bytes_of(sweep_stiffness(hinge_scene(2), kGrid)), whole);
  EXPECT_EQ(bytes_of(sweep_stiffness(hinge_scene(8), kGrid)), whole);
  EXPECT_EQ(bytes_of(sweep_stiffness(hinge_scene(1), {{0.1}, {1.0}})), bytes_of({rows[5]}));
  const SweepGrid backwards{{0.1, -0.05}, {1.0, 0.3, 0.0}};
  auto reversed = sweep_stiffness(hinge_scene(2), backwards);
  std::reverse(reversed.begin(), reversed.end());
  EXPECT_EQ(bytes_of(reversed), whole);
}

TEST(StiffnessSweep, PartsTogetherAreTheWhole) {
  const std::string whole = bytes_of(sweep_stiffness(hinge_scene(), kGrid));
  std::vector<StiffnessRow> joined;
  for (int part = 1; part <= 4; ++part) {
    const auto rows = sweep_stiffness(hinge_scene(), kGrid, share_of_cells(kGrid, part, 4));
    joined.insert(joined.end(), rows.begin(), rows.end());
  }
  EXPECT_EQ(bytes_of(joined), whole);
}

TEST(StiffnessSweep, BalancesTheSettledTissueAndTheWaysAgree) {
  for (const StiffnessRow& row : sweep_stiffness(hinge_scene(), kGrid)) {
    EXPECT_TRUE(row.converged) << row.q_rad << ' ' << row.common;
    EXPECT_TRUE(row.held) << row.q_rad << ' ' << row.common;
    ASSERT_EQ(row.muscles.size(), 2u);
    double net = 0.0, stronger = 0.0, line_muscle = 0.0, line_geometry = 0.0, schur = row.K_passive_Nm_rad;
    for (const MusclePart& part : row.muscles) {
      net += part.torque_Nm;
      stronger = std::max(stronger, std::abs(part.torque_Nm));
      line_muscle += part.K_muscle_Nm_rad;
      line_geometry += part.K_geometry_Nm_rad;
      schur += part.K_schur_Nm_rad;
    }
    EXPECT_LE(std::abs(net), kHeldShare * stronger);
    const double size = std::abs(line_muscle) + std::abs(line_geometry);
    EXPECT_NEAR(row.K_muscle_Nm_rad, line_muscle, 1e-12 * size);
    EXPECT_NEAR(row.K_geometry_Nm_rad, line_geometry, 1e-12 * size);
    EXPECT_NEAR(row.K_schur_Nm_rad, schur, 1e-12 * size);
    EXPECT_NEAR(row.K_perturbed_Nm_rad, row.K_schur_Nm_rad, 0.01 * size);  // the second-order part of half a degree
    EXPECT_LT(row.K_low_Nm_rad, row.K_schur_Nm_rad);
    EXPECT_GT(row.K_high_Nm_rad, row.K_schur_Nm_rad);
    EXPECT_THAT(row.why, HasSubstr("N m/rad"));
  }
}

TEST(StiffnessSweep, MirrorImagesBalanceAtTheSameLevel) {
  const auto rows = sweep_stiffness(hinge_scene(), {{0.0}, {0.6}});
  EXPECT_NEAR(rows[0].flexors, 0.6, 1e-3);
  EXPECT_NEAR(rows[0].extensors, 0.6, 1e-3);
}

TEST(StiffnessSweep, ADifferenceIsLeftInTheTorque) {
  scene::Scene scene = hinge_scene();
  const SweepGrid one{{0.0}, {0.4}};
  const double even_Nm = sweep_stiffness(scene, one)[0].net_torque_Nm;
  scene.co_contraction->difference = 0.2;
  const StiffnessRow row = sweep_stiffness(scene, one)[0];
  EXPECT_NEAR(row.flexors - row.extensors, 0.2, 1e-3);
  EXPECT_GT(row.net_torque_Nm, even_Nm + 0.1);  // 0.2 of some 100 N at 30 mm
  EXPECT_TRUE(row.held);
}

TEST(StiffnessSweep, ABalanceOutOfReachIsARowOfItsOwn) {
  scene::Scene scene = hinge_scene();
  scene.specimen.muscles.push_back(scene.specimen.muscles[0]);  // a second flexor that nothing drives
  scene.specimen.muscles.back().key = "flexor_of_its_own_mind";
  scene.specimen.muscles.back().peak_force_N *= 5.0;
  scene.specimen.lines.push_back(scene.specimen.lines[0]);
  scene.specimen.lines.back().muscle = 2;
  scene.activations = {0.0, 0.0, 1.0};
  const auto rows = sweep_stiffness(scene, {{0.0}, {0.0, 1.0}});
  ASSERT_EQ(rows.size(), 2u);
  for (const StiffnessRow& row : rows) {
    EXPECT_FALSE(row.held);
    EXPECT_THAT(row.why, HasSubstr("do not hold the joint"));
  }
}

TEST(StiffnessSweep, StopsBetweenCellsAndTellsHowFarItIs) {
  std::atomic<bool> stop{false};
  std::vector<int> heard;
  SweepWatch watch;
  watch.progress = [&](int done, int all) {
    EXPECT_EQ(all, 8);  // two tables and six cells
    heard.push_back(done);
    stop = done == 4;
  };
  watch.stopped = [&] { return stop.load(); };
  const auto rows = sweep_stiffness(hinge_scene(), kGrid, watch);
  EXPECT_EQ(rows.size(), 2u);
  EXPECT_EQ(heard, (std::vector<int>{1, 2, 3, 4}));
}

TEST(StiffnessSweep, NeedsACoContraction) {
  scene::Scene scene = hinge_scene();
  scene.co_contraction.reset();
  EXPECT_THAT(testing::complaint(ExitStatus::BadData, [&] { sweep_stiffness(scene, kGrid); }),
              HasSubstr("/co_contraction"));
}

}  // namespace
}  // namespace myotact::measure

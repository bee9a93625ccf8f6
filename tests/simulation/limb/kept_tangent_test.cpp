#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "anatomy/specimen.h"
#include "simulation/limb/find_touches.h"
#include "simulation/limb/settle.h"
#include "simulation/limb/step.h"
#include "support/source_folder.h"

// Muscles that have hardly changed begin a step with the tangent of an earlier one. Against the same limb with new
// tangents in every step: what is seen and what is felt is the same.

namespace myotact::simulation {
namespace {

constexpr double kDt_s = 0.01;
constexpr int kPressed = 2, kActive = 0;                         // muscles
constexpr int kRest = 40, kPress = 90, kHold = 130, kEnd = 180;  // steps at which each part ends

/// Rest, a press of 3 mm by 30 ms with a contraction beside it, a hold, and rest again.
double press_m(int step) {
  if (step < kRest) return 0.0;
  if (step < kPress) return 3e-3 * (step - kRest) / (kPress - kRest);
  return step < kHold ? 3e-3 : 0.0;
}

struct ElbowRun {
  anatomy::Specimen specimen = anatomy::load_specimen(source_folder() + "/meshes/canine_elbow");
  Limb limb{specimen, {}, Tendon::Elastic, Contact::None};
  WorkerPool workers{2};
  ToolSpring spring;
  int kept = 0;  // muscles that began a step with an old tangent, all steps

  ElbowRun() {
    for (int j = 0; j < limb.skeleton.joint_count(); ++j) limb.skeleton.set_locked(j, true);
    const std::vector<double> angles(specimen.joints.size(), 0.0);
    settle_limb(limb, angles, workers);
    spring.muscle = kPressed;
    spring.stiffness_N_m = 600.0;
    spring.point.count = 1;
    spring.point.weights[0] = 1.0;
    const MuscleTissue& tissue = limb.muscles[kPressed].tissue;
    const Eigen::VectorXd& positions_m = limb.muscles[kPressed].state.now.position_m;
    const Vec3 middle = positions_m.reshaped(3, positions_m.size() / 3).rowwise().mean();
    double highest_m = -1e300;  // the free node that is farthest out along y near the middle
    for (int node = 0; node < static_cast<int>(tissue.body.size()); ++node) {
      const Vec3 way = node_vector(positions_m, node) - middle;
      const double height_m = way.y() - 2.0 * std::hypot(way.x(), way.z());
      if (tissue.body[static_cast<std::size_t>(node)] >= 0 || height_m < highest_m) continue;
      highest_m = height_m;
      spring.point.nodes[0] = node;
    }
    spring.target_W_m = spring_point(limb, spring);
  }

  void step(int index, bool keep) {
    ToolSpring pressing = spring;
    pressing.target_W_m.y() -= press_m(index);
    limb.springs.clear();
    if (press_m(index) > 0.0) limb.springs.push_back(pressing);
    if (index >= kRest) limb.muscles[kActive].state.activation = std::min(0.3, 0.01 * (index - kRest));
    for (LimbMuscle& muscle : limb.muscles) {
      if (!keep) muscle.kept_rule.reset();
      kept += muscle.kept_rule.has_value();
    }
    push_history(limb);
    ASSERT_TRUE(advance(limb, {kDt_s, index > 0}, workers).sound) << "step " << index;
  }
};

/// TouchSlopes of all touches, both sides, by muscle, touching node, tie, neighbour and the place there.
using TouchSlopes = std::map<std::tuple<int, int, bool, int, std::array<int, 4>>, std::pair<double, double>>;
TouchSlopes slopes_of(const Limb& limb) {
  TouchSlopes slopes;
  for (std::size_t m = 0; m < limb.muscles.size(); ++m) {
    for (const NeighbourTouch& touch : limb.muscles[m].state.touches) {
      if (touch.touched) continue;
      const auto& theirs = limb.muscles[static_cast<std::size_t>(touch.neighbour)].state.touches;
      const NeighbourTouch& side = theirs[static_cast<std::size_t>(touch.counterpart)];
      slopes[{static_cast<int>(m), touch.nodes[0], touch.tie, touch.neighbour, side.nodes}] = {touch.slope_N_m,
                                                                                               side.slope_N_m};
    }
  }
  return slopes;
}

}  // namespace

/// Several nodes may touch one face with slopes of their own; each finds its own again when faces are looked for anew.
TEST(KeptTangent, TouchesThatStayKeepTheirSlopesOnBothSides) {
  const anatomy::Specimen specimen = anatomy::load_specimen(source_folder() + "/meshes/canine_elbow");
  Limb limb(specimen);
  WorkerPool workers(2);
  const auto shift = [&](double way_m) {
    LimbMuscle& muscle = limb.muscles[kPressed];
    for (int node = 0; node < static_cast<int>(muscle.tissue.body.size()); ++node) {
      if (muscle.tissue.body[static_cast<std::size_t>(node)] < 0)
        muscle.state.now.position_m.segment<3>(3 * node) += Vec3(way_m, way_m, way_m);
    }
  };
  shift(0.3e-3);
  find_touches(limb, workers);
  for (LimbMuscle& muscle : limb.muscles) compute_system(limb.skeleton, {}, muscle);
  const TouchSlopes before = slopes_of(limb);
  shift(0.1e-3);
  follow_touches(limb, workers);
  int stayed = 0, pressing = 0;
  for (const auto& [touch, slopes] : slopes_of(limb)) {
    const auto found = before.find(touch);
    if (found == before.end()) continue;
    ++stayed;
    pressing += found->second.first > 0.0;
    EXPECT_EQ(slopes, found->second);
  }
  EXPECT_GT(stayed, 100);
  EXPECT_GT(pressing, 20);
}

TEST(KeptTangent, IsNeitherSeenNorFelt) {
  ElbowRun kept, fresh;
  double farthest_m = 0.0, force_error_N = 0.0, largest_force_N = 0.0;
  for (int i = 0; i < kEnd; ++i) {
    kept.step(i, true);
    fresh.step(i, false);
    for (std::size_t m = 0; m < kept.limb.muscles.size(); ++m) {
      const Eigen::VectorXd way_m =
          kept.limb.muscles[m].state.now.position_m - fresh.limb.muscles[m].state.now.position_m;
      farthest_m = std::max(farthest_m, way_m.cwiseAbs().maxCoeff());
    }
    if (kept.limb.springs.empty()) continue;
    force_error_N = std::max(force_error_N, (kept.limb.spring_force_N[0] - fresh.limb.spring_force_N[0]).norm());
    largest_force_N = std::max(largest_force_N, fresh.limb.spring_force_N[0].norm());
  }
  const double share = static_cast<double>(kept.kept) / (kEnd * static_cast<double>(kept.limb.muscles.size()));
  std::printf("kept %.0f %% of the tangents: nodes within %.4f mm, force of %.3f N within %.2f %%\n", 100.0 * share,
              1e3 * farthest_m, largest_force_N, 100.0 * force_error_N / largest_force_N);
  EXPECT_EQ(fresh.kept, 0);
  EXPECT_GT(share, 0.5);
  EXPECT_GT(largest_force_N, 0.1);
  EXPECT_LT(farthest_m, 0.1e-3);
  EXPECT_LT(force_error_N, 0.01 * largest_force_N);
}

}  // namespace myotact::simulation

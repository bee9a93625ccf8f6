// A hand that holds still while the tool rests on more than one surface: what it feels is still, too.

#include <cmath>
#include <cstddef>
#include <cstdio>

#include <gtest/gtest.h>

#include "anatomy/specimen.h"
#include "device/profile_file.h"
#include "measure/fidelity/device_run.h"

namespace myotact::measure {
namespace {

constexpr double kEnd_s = 2.2;
constexpr std::size_t kHeldFrom_ticks = 1400;
constexpr int kWindow_ticks = 50;  // what is slower than 20 Hz is no buzz

/// The force beside its mean over a window, root mean square [N].
double swing_N(const DeviceRun& run) {
  double sum_N2 = 0.0;
  int count = 0;
  const auto force_N = [&](std::size_t i) { return to_vec3(run.ticks[i].tool.force_world_N); };
  for (std::size_t i = kHeldFrom_ticks; i + kWindow_ticks / 2 < run.ticks.size(); ++i) {
    Vec3 mean_N = Vec3::Zero();
    for (std::size_t k = i - kWindow_ticks / 2; k < i + kWindow_ticks / 2; ++k) mean_N += force_N(k) / kWindow_ticks;
    sum_N2 += (force_N(i) - mean_N).squaredNorm();
    ++count;
  }
  return std::sqrt(sum_N2 / count);
}

/// Vastus lateralis beside a muscle that only follows its bones: soft and rigid under one sphere. Loaded by turns, the
/// hand felt 0 to 1.65 N at 30 Hz.
TEST(HeldStill, OnSoftAndRigidAtOnce) {
  scene::Scene scene = without_effects(scene::load_scene("stifle"));
  scene::TouchMuscle touch;
  touch.muscle = anatomy::find_muscle(scene.specimen, "vastus_lateralis");
  ASSERT_GE(touch.muscle, 0);
  touch.at = 0.54;
  touch.from = Vec3(-0.3, 1.0, 0.0);
  touch.depth_m = 4e-3;
  scene.script = {{0.0, 1.0, touch}, {kEnd_s, 0.1, scene::ReleaseHand{}}};
  const DeviceRun run = run_scripted(scene, device::load_profile("simulated").profile, kEnd_s, {});
  ASSERT_GT(run.ticks.size(), kHeldFrom_ticks + 2 * kWindow_ticks);
  std::size_t beside = 0;
  for (std::size_t i = kHeldFrom_ticks; i < run.ticks.size(); ++i)
    beside += run.ticks[i].tool.beside[0].stiffness_N_m > 0.0;
  const double swing = swing_N(run);
  std::printf("force %.3f N, swings by %.1f mN over 20 Hz\n", to_vec3(run.ticks.back().tool.force_world_N).norm(),
              1e3 * swing);
  EXPECT_GT(beside, (run.ticks.size() - kHeldFrom_ticks) * 7 / 8)
      << "the sphere rests on one surface alone: the test shows nothing";
  EXPECT_GT(to_vec3(run.ticks.back().tool.force_world_N).norm(), 0.2);
  EXPECT_LT(swing, 0.02);
}

}  // namespace
}  // namespace myotact::measure

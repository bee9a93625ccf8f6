#include "app/joint_watch.h"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "measure/stiffness_band.h"

namespace myotact::app {
namespace {

/// The script has the muscles at 0.8 while the window's sliders stand where the scene began: the band is that of 0.8.
TEST(JointWatch, TheBandIsThatOfTheLevelInForce) {
  scene::Scene scene = scene::load_scene("elbow", {{"tissue", R"({"default": "line"})"}});
  scene::ScriptAction rise;
  rise.what = scene::CoContract{0.8, 0.0};
  scene.script = {rise};
  simulation::Simulation simulation(scene.specimen, scene.settings);
  scene::FreeSession session(scene, simulation, {}, nullptr);
  session.start();
  std::this_thread::sleep_for(std::chrono::milliseconds(1000));
  messages::SceneFrame frame;
  ASSERT_TRUE(session.fetch_frame(frame));
  JointWatch watch(scene);
  const view::JointReadings& readings = watch.read(frame, session);
  session.stop();
  std::vector<double> angles_rad;
  for (const messages::JointFrame& joint : frame.joints) angles_rad.push_back(joint.angle_rad);
  const measure::BandPart band =
      measure::whole_band(measure::stiffness_band(measure::line_limb(scene), angles_rad, 0.8));
  const double K_Nm_rad = frame.joints[static_cast<std::size_t>(scene.co_contraction->joint)].stiffness_Nm_rad;
  ASSERT_GT(band.up_Nm_rad, 0.0);
  EXPECT_NEAR(readings.K_high_Nm_rad, K_Nm_rad + band.up_Nm_rad, 1e-9);
  EXPECT_NEAR(readings.K_low_Nm_rad, K_Nm_rad - band.down_Nm_rad, 1e-9);
}

}  // namespace
}  // namespace myotact::app

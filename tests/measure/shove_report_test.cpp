#include "measure/shove_report.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "measure/hinge_scene.h"
#include "scene/rotated_torques.h"

namespace myotact::measure {
namespace {

/// Antagonist lines with elastic tendons across a hinge; steps of 1 ms, so that the time rule adds no damping to see.
scene::Scene line_scene() {
  scene::Scene scene = myotact::testing::hinge_scene();
  scene.settings.dt_s = 1e-3;
  scene.settings.tissue.assign(scene.specimen.muscles.size(), simulation::TissueModel::Line);
  scene.settings.tendon = simulation::Tendon::Elastic;
  for (anatomy::Muscle& muscle : scene.specimen.muscles) muscle.optimal_fibre_m = 0.05;
  return scene;
}

ShoveReport shoved(double activation) {
  const scene::Scene scene = line_scene();
  simulation::Simulation simulation(scene.specimen, scene.settings);
  EXPECT_TRUE(simulation.settle(std::array{0.0}, std::array{activation, activation}));
  for (const int m : {0, 1}) simulation.set_excitation(m, activation);
  scene::ShoveTest test(scene.settings.dt_s);
  test.start(0, simulation);
  for (int i = 0; i < 10000 && test.under_way(); ++i) {
    simulation.set_joint_torque(0, test.next_torque_Nm(simulation));
    simulation.step({});
  }
  EXPECT_EQ(test.record().joint, 0);
  return report_shove(test.record());
}

TEST(ShoveReport, ASlowPushMeasuresTheStiffnessThatIsReadOut) {
  for (const double activation : {0.02, 0.3, 0.8}) {
    const ShoveReport report = shoved(activation);
    EXPECT_NEAR(report.pushed_stiffness_Nm_rad / report.read_stiffness_Nm_rad, 1.0, 0.02) << activation;
  }
}

TEST(ShoveReport, AStrokeSwingsAsStiffnessDampingInertiaAndTendonsForetell) {
  for (const double activation : {0.02, 0.3, 0.8}) EXPECT_LT(shoved(activation).swing_error, 0.05) << activation;
}

TEST(ShoveReport, SaysWhetherItRings) {
  const ShoveReport limp = shoved(0.0);
  EXPECT_GT(limp.measured_frequency_hz, 0.0);
  EXPECT_NEAR(limp.measured_frequency_hz, limp.mode.frequency_hz, 0.03 * limp.mode.frequency_hz);
  EXPECT_NE(limp.why.find("It rings at"), std::string::npos) << limp.why;
}

TEST(RotatedTorques, AreThoseMeasuredInTheOtherPosture) {
  const scene::Scene scene = line_scene();
  simulation::Simulation simulation(scene.specimen, scene.settings);
  const std::array at{0.0}, there{0.3};
  const scene::TorqueTable table = scene::measure_torques(scene, simulation, at);
  const scene::TorqueTable turned = scene::rotated_torques(table, scene, at, there);
  const scene::TorqueTable measured = scene::measure_torques(scene, simulation, there);
  for (std::size_t m = 0; m < 2; ++m) {
    for (std::size_t i = 0; i < table.levels.size(); ++i) {
      EXPECT_NEAR(turned.torque_Nm[m][i], measured.torque_Nm[m][i], 1e-9) << m << " " << table.levels[i];
    }
  }
}

}  // namespace
}  // namespace myotact::measure

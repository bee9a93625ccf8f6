#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "simulation/line/line_model.h"
#include "simulation/muscle/tissue_material.h"
#include "simulation/simulation.h"
#include "support/wrapped_specimen.h"

// Muscles of finite elements that lie on a cylinder of bone about the hinge: their moment arm is not given,
// contact makes it. Closed forms: torque r F, stiffness sum r^2 k, with r the cylinder's radius and half the muscle's
// thickness.

namespace myotact::simulation {
namespace {

constexpr double kDegree_rad = 3.14159265358979323846 / 180.0;

double torque(Simulation& simulation, double q_rad, double activation) {
  const std::array<double, 2> activations{activation, activation};
  EXPECT_TRUE(simulation.settle({&q_rad, 1}, activations)) << "at " << q_rad << " rad";
  return simulation.joint(0).net_torque_Nm;
}

}  // namespace

TEST(WrappedMuscle, MomentArmEmergesAndStaysThroughTheRange) {
  const testing::WrappedBar bar;
  const anatomy::Specimen specimen = testing::wrapped_hinge(bar, false);
  Simulation simulation(specimen, {});
  // Flexed farther, the thickened bar is clamped too short of the cylinder and bows off it.
  for (const double degrees : {-30.0, -20.0, -10.0, 0.0, 10.0, 20.0}) {
    const double torque_Nm = torque(simulation, degrees * kDegree_rad, 0.3);
    const double moment_arm_m = torque_Nm / simulation.muscle_force_N(0);
    const LineForce line = line_force(specimen.muscles[0], -bar.moment_arm_m() * degrees * kDegree_rad, 0.0, 0.3);
    fmt::print("q {:5.1f} deg: force {:.3f} N of {:.3f}, moment arm {:.3f} mm of {:.3f}, deepest {:.3f} mm\n", degrees,
               simulation.muscle_force_N(0), line.force_N, 1e3 * moment_arm_m, 1e3 * bar.moment_arm_m(),
               1e3 * simulation.contact_depth_m(0));
    EXPECT_NEAR(moment_arm_m, bar.moment_arm_m(), 0.03 * bar.moment_arm_m());
    EXPECT_NEAR(simulation.muscle_force_N(0), line.force_N, 0.03 * line.force_N);
    EXPECT_LT(simulation.contact_depth_m(0), 0.2e-3);
  }
}

// Fibres alone would give sum r^2 k of the lines. Beside them lies the matrix, a bar of E = 3 mu that the lines do not
// have; half activation is where calibration compensates it, so the fibres' share is what it leaves there. What
// remains of the 10 % is the moment arm: the pressure of the wrapped belly thins it.
TEST(WrappedMuscle, StiffnessOfAnEqualPairIsTheClosedForm) {
  const testing::WrappedBar bar;
  const anatomy::Specimen specimen = testing::wrapped_hinge(bar, true);
  Simulation simulation(specimen, {});
  const auto line = [&](double activation) { return line_force(specimen.muscles[0], 0.0, 0.0, activation); };
  const double matrix_N_m = 3.0 * kMuscleMatrix.matrix.shear_Pa * bar.width_m * bar.thickness_m / bar.length_m();
  const double fibres = 1.0 - matrix_N_m / line(0.5).stiffness_N_m;
  for (const double activation : {0.01, 0.1, 0.25, 0.5, 1.0}) {
    const double turn = 0.5 * kDegree_rad;
    const double flexed = torque(simulation, turn, activation), extended = torque(simulation, -turn, activation);
    const double net = torque(simulation, 0.0, activation);
    const double perturbed = (extended - flexed) / (2.0 * turn);
    const JointReadout readout = simulation.joint(0);
    const double r2 = bar.moment_arm_m() * bar.moment_arm_m(), lines = 2.0 * r2 * line(activation).stiffness_N_m;
    const double closed = fibres * lines + 2.0 * r2 * matrix_N_m;
    fmt::print(
        "a {:4.2f}: K closed {:.4f} (lines alone {:.4f}), Schur {:.4f}, perturbed {:.4f}, contact's {:.4f} N m/rad;"
        " net torque {:.5f} N m, force {:.3f} of {:.3f} N\n",
        activation, closed, lines, readout.stiffness_Nm_rad, perturbed, readout.contact_Nm_rad, net,
        simulation.muscle_force_N(0), line(activation).force_N);
    EXPECT_NEAR(readout.stiffness_Nm_rad, closed, 0.1 * closed);
    EXPECT_NEAR(readout.stiffness_Nm_rad, perturbed, 0.03 * perturbed);
    EXPECT_GT(readout.contact_Nm_rad, 0.0);
  }
}

// A hand that presses the muscle on the bone with 10 N while the joint is thrown at more than 360 deg/s from full
// relaxation to full co-contraction and back.
TEST(WrappedMuscle, StandsAPressOnTheBoneAFastTurnAndCoContraction) {
  const testing::WrappedBar bar;
  const anatomy::Specimen specimen = testing::wrapped_hinge(bar, true);
  Simulation simulation(specimen, {});
  const double q = 0.0;
  ASSERT_TRUE(simulation.settle({&q, 1}, {}));
  messages::ToolState tool;
  tool.contact = {0, 0, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, {}, {}, 1000.0};
  const std::vector<Vec3>& skin = specimen.muscles[0].skin.positions_m;
  for (std::size_t t = 0; t < specimen.muscles[0].skin.triangles.size(); ++t) {
    if ((skin[static_cast<std::size_t>(specimen.muscles[0].skin.triangles[t][0])] - Vec3(0.0, 0.0, 0.034)).norm() <
        1e-3)
      tool.contact.triangle = static_cast<int>(t);
  }
  double fastest = 0.0, deepest_m = 0.0;
  for (int i = 0; i < 200; ++i) {
    for (int m = 0; m < 2; ++m) simulation.set_excitation(m, i / 40 % 2 == 1 ? 1.0 : 0.0);
    simulation.set_joint_torque(0, i / 20 % 2 == 0 ? 0.6 : -0.6);
    tool.contact.target_world_m = {0.0, 0.0, 0.034 - 0.01};
    simulation.step(i % 50 < 25 ? std::span<const messages::ToolState>(&tool, 1)
                                : std::span<const messages::ToolState>());
    fastest = std::max(fastest, std::abs(simulation.joint(0).velocity_rad_s));
    deepest_m = std::max(deepest_m, simulation.contact_depth_m(0));
    ASSERT_TRUE(std::isfinite(simulation.joint(0).angle_rad)) << "step " << i;
    for (const Vec3& p : simulation.skin_world_m(0)) ASSERT_LT(p.norm(), 0.2) << "step " << i;
  }
  fmt::print("fastest {:.0f} deg/s, deepest {:.2f} mm, {} of 200 steps in parts\n", fastest / kDegree_rad,
             1e3 * deepest_m, simulation.failed_steps());
  EXPECT_GT(fastest, 360.0 * kDegree_rad);
  EXPECT_LE(simulation.failed_steps(), 10);
}

}  // namespace myotact::simulation

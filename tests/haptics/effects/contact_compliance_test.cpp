#include "haptics/effects/contact_compliance.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace myotact::haptics {
namespace {

constexpr std::uint64_t kTick_ns = 1'000'000;
constexpr double kDt_s = 1e-3;
constexpr double kDevice_N_m = 800.0;

/// Steps of 10 ms of a simulation that touches surface 0 from above.
struct Play {
  ContactCompliance compliance;
  messages::LocalModel model;
  ProxyContact touching;
  std::uint64_t now_ns = kTick_ns;

  Play() {
    compliance.limit_stiffness(kDevice_N_m);
    model.dt_ns = 10 * kTick_ns;
    touching.active = true;
    touching.surface = 0;
  }
  void step(double force_N, double compliance_m_N, int surface = 0) {
    model.published_at_ns = now_ns;
    model.contact.surface = surface;
    model.contact.force_world_N = {0.0, 0.0, -force_N};
    for (const std::size_t k : {0u, 4u}) model.contact.compliance_m_N[k] = 0.0;
    model.contact.compliance_m_N[8] = compliance_m_N;
  }
  void tick(int ticks = 1) {
    for (int i = 0; i < ticks; ++i) compliance.tick(model, touching, now_ns += kTick_ns, kDt_s);
  }
};

TEST(ContactCompliance, WithoutAModelOfTheContactTheSpringIsTheDevices) {
  ContactCompliance compliance;
  compliance.limit_stiffness(kDevice_N_m);
  EXPECT_DOUBLE_EQ(compliance.felt_stiffness_N_m(), kDevice_N_m);
  EXPECT_DOUBLE_EQ(compliance.coupling_stiffness_N_m(), kDevice_N_m);
  EXPECT_EQ(compliance.shift_m().norm(), 0.0);
}

// 1/A = 1/K + c; A never above the device's bound, K as stiff as that allows.
TEST(ContactCompliance, CouplingAndTissueInARowAreNoStifferThanTheDeviceMayRender) {
  for (const double tissue_N_m : {350.0, 500.0, 1500.0, 9000.0}) {
    Play play;
    play.step(1.0, 1.0 / tissue_N_m);
    play.tick(10);
    const double felt_N_m = play.compliance.felt_stiffness_N_m(),
                 coupling_N_m = play.compliance.coupling_stiffness_N_m();
    EXPECT_NEAR(1.0 / felt_N_m, 1.0 / coupling_N_m + 1.0 / tissue_N_m, 1e-12);
    EXPECT_LE(felt_N_m, kDevice_N_m * (1.0 + 1e-12));
    EXPECT_NEAR(felt_N_m, std::min(tissue_N_m, kDevice_N_m), 0.03 * felt_N_m);
  }
}

// What the spring of the shifted device gives is what coupling and tissue, each by its own law, give.
TEST(ContactCompliance, TheClosedFormSolvesBothSpringsAtOnce) {
  Play play;
  play.step(1.3, 1.0 / 1700.0);
  play.tick(10);
  const Vec3 device_m(0.0, 0.0, -2e-3), surface_m = Vec3::Zero();
  const Vec3 on_hand_N = play.compliance.felt_stiffness_N_m() * (surface_m - device_m - play.compliance.shift_m());
  const Vec3 tissue_m = surface_m + play.compliance.tissue_shift_m(on_hand_N);
  EXPECT_LT((on_hand_N - play.compliance.coupling_stiffness_N_m() * (tissue_m - device_m)).norm(), 1e-12);
  EXPECT_LT((tissue_m - Vec3(0.0, 0.0, (1.3 - on_hand_N.z()) / 1700.0)).norm(), 1e-12);
}

// At rest the tissue is where the simulation has it.
TEST(ContactCompliance, TheForceThatTheSimulationUsedMovesNothing) {
  Play play;
  play.step(1.3, 2e-3);
  play.tick(10);
  EXPECT_LT(play.compliance.tissue_shift_m(Vec3(0.0, 0.0, 1.3)).norm(), 1e-15);
  EXPECT_NEAR(play.compliance.tissue_shift_m(Vec3(0.0, 0.0, 1.8)).z(), -0.5 * 2e-3, 1e-15);
}

TEST(ContactCompliance, AModelIsReachedInEqualStepsOverItsTime) {
  Play play;
  play.step(1.0, 2e-3);
  play.tick(10);
  play.step(2.0, 1e-3);
  for (int tick = 1; tick <= 10; ++tick) {
    play.tick();
    const double s = 0.1 * tick;
    EXPECT_NEAR(play.compliance.shift_m().z(), -(1.0 + s) * (2e-3 - s * 1e-3), 1e-12);
  }
  play.tick(5);
  EXPECT_NEAR(play.compliance.shift_m().z(), -2e-3, 1e-12);
}

TEST(ContactCompliance, AnotherSurfaceIsRigidUntilItsOwnModelComes) {
  Play play;
  play.step(1.0, 2e-3);
  play.tick(10);
  play.touching.surface = 1;
  play.step(1.0, 2e-3);
  play.tick(10);
  EXPECT_EQ(play.compliance.shift_m().norm(), 0.0);
  EXPECT_NEAR(play.compliance.felt_stiffness_N_m(), kDevice_N_m, 1e-9);
  play.step(2.0, 1e-3, 1);
  play.tick(10);
  EXPECT_NEAR(play.compliance.shift_m().z(), -2e-3, 1e-12);
}

TEST(ContactCompliance, SurfacesThatTheToolRestsOnTogetherGiveWayTogether) {
  Play play;
  play.step(1.0, 2e-3);
  play.tick(10);
  play.touching.surface = 1;
  play.touching.beside[0].surface = 0;
  play.step(1.0, 2e-3);
  play.tick(10);
  EXPECT_NEAR(play.compliance.shift_m().z(), -2e-3, 1e-12);
  play.touching.beside[0].surface = -1;  // and no longer
  play.tick(10);
  EXPECT_EQ(play.compliance.shift_m().norm(), 0.0);
}

// A strand gives way to the side and hardly along itself, whatever it does across the surface.
TEST(ContactCompliance, AlongTheSurfaceTheTissueHasItsOwn) {
  Play play;
  play.step(1.0, 1.2e-3);
  play.model.contact.compliance_m_N[0] = 0.1e-3;
  play.model.contact.compliance_m_N[4] = 0.9e-3;
  play.tick(10);
  const Vec3 moved_m = play.compliance.tissue_shift_m(Vec3(0.2, 0.3, 1.0));
  EXPECT_LT((moved_m - Vec3(-0.2 * 0.1e-3, -0.3 * 0.9e-3, 0.0)).norm(), 1e-12);
}

// With the tissue's linear law and the spring that the simulation is told of, its step gives the force that the hand
// feels: for any compliance along the surface that the coupling leaves room for.
TEST(ContactCompliance, TheSimulationAnswersAChangeOfForceWithThatChange) {
  Play play;
  play.step(0.8, 1.1e-3);
  play.model.contact.compliance_m_N = {0.2e-3, 0.1e-3, 0.05e-3, 0.1e-3, 0.6e-3, -0.1e-3, 0.05e-3, -0.1e-3, 1.1e-3};
  play.tick(10);
  const Mat3 compliance_m_N =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(play.model.contact.compliance_m_N.data());
  const Vec3 used_N(0.0, 0.0, -0.8), wanted_N(0.2, -0.1, -0.9);  // on the tissue
  const double coupling_N_m = play.compliance.coupling_stiffness_N_m();
  const Vec3 target_m = play.compliance.tissue_shift_m(-wanted_N) + wanted_N / coupling_N_m;
  // coupling (target - C (F - used)) = F
  const Mat3 both_m_N = Mat3::Identity() / coupling_N_m + compliance_m_N;
  const Vec3 answer_N = both_m_N.inverse() * (target_m + compliance_m_N * used_N);
  EXPECT_LT((answer_N - wanted_N).norm(), 0.01 * wanted_N.norm());
}

TEST(ContactCompliance, TissueAboutToFoldIsTakenAsSoftAndItsOtherDirectionsAsTheyAre) {
  Play play;
  play.step(1.0, 1e-3);
  play.model.contact.compliance_m_N[0] = 1.7;
  play.model.contact.compliance_m_N[4] = 1e-3;
  play.tick(10);
  EXPECT_NEAR(1.0 / play.compliance.felt_stiffness_N_m(), 1.0 / kDevice_N_m, 1e-9);
  const Vec3 moved_m = play.compliance.tissue_shift_m(Vec3(0.1, 0.1, 1.0));
  EXPECT_LT(std::abs(moved_m.x()), 0.1 / kDevice_N_m);
  EXPECT_NEAR(moved_m.y(), -0.1 * 1e-3, 1e-12);
}

// On the last millimetre before another surface the coupling becomes the device's own, whatever the tissue hides.
TEST(ContactCompliance, LittleRoomBesideTheSphereSoftensTheCoupling) {
  double before_N_m = 1e9;
  for (const double gap_m : {1e-3, 0.75e-3, 0.5e-3, 0.25e-3, 0.0}) {
    Play play;
    play.touching.beside[0].surface = 5;
    play.touching.beside[0].gap_m = gap_m;
    play.step(1.0, 2e-3);
    for (int step = 0; step < 20; ++step) {
      play.model.published_at_ns = play.now_ns;
      play.tick(10);
    }
    const double coupling_N_m = play.compliance.coupling_stiffness_N_m();
    EXPECT_LT(coupling_N_m, before_N_m);
    EXPECT_GE(coupling_N_m, kDevice_N_m * (1.0 - 1e-6));
    before_N_m = coupling_N_m;
    const double hidden_m_N = 1.0 / 3e4;  // the stiffest coupling, which tissue of 500 N/m leaves to a device of 800
    EXPECT_NEAR(1.0 / coupling_N_m, hidden_m_N + (1.0 - gap_m / 1e-3) * (1.0 / kDevice_N_m - hidden_m_N), 1e-9);
  }
}

// The other side of a dent is of the same tissue, whose compliance is known.
TEST(ContactCompliance, TheOtherSideOfADentTakesNoRoom) {
  Play play;
  play.step(1.0, 1e-3);
  play.tick(10);
  const double alone_N_m = play.compliance.coupling_stiffness_N_m();
  play.touching.beside[0].surface = play.touching.surface;
  play.touching.beside[0].gap_m = 0.2e-3;
  play.step(1.0, 1e-3);
  play.tick(10);
  EXPECT_NEAR(play.compliance.coupling_stiffness_N_m(), alone_N_m, 1e-9 * alone_N_m);
}

// The answer of tissue of 1 mm/N to a hand that holds still, told as 0.8 and 1 mm/N by turns, with a muscle beside it
// that comes and goes by 0.2 mm: the force of a step is the hand's depth over 1/K + c.
TEST(ContactCompliance, ACouplingThatWouldVaryFromStepToStepStaysSoft) {
  constexpr double kTissue_m_N = 1e-3, kDepth_m = 2e-3;
  Play play;
  play.touching.beside[0].surface = 5;
  double least_N = 1e9, most_N = 0.0;
  for (int step = 0; step < 50; ++step) {
    const bool even = step % 2 == 0;
    play.touching.beside[0].gap_m = even ? 0.5e-3 : 0.7e-3;
    play.step(1.0, even ? 0.8e-3 : 1e-3);
    play.tick(10);
    const double force_N = kDepth_m / (1.0 / play.compliance.coupling_stiffness_N_m() + kTissue_m_N);
    if (step < 25) continue;  // it has come to rest
    least_N = std::min(least_N, force_N);
    most_N = std::max(most_N, force_N);
  }
  EXPECT_LT(most_N - least_N, 0.01 * most_N);
}

// The simulation tells of the surface next to the tool, too.
TEST(ContactCompliance, ATouchThatWasForeseenIsAsSoftAsTheTissueFromItsFirstTick) {
  constexpr double kTissue_m_N = 5e-3;
  Play play;
  play.touching = {};
  play.step(0.0, kTissue_m_N);
  play.tick(10);
  EXPECT_EQ(play.compliance.shift_m().norm(), 0.0);
  play.touching.active = true;
  play.touching.surface = 0;
  play.tick();
  EXPECT_NEAR(1.0 / play.compliance.felt_stiffness_N_m(), 1.0 / 3e4 + kTissue_m_N, 1e-9);
  play.touching.surface = 1;  // of which nothing was told
  play.step(0.0, kTissue_m_N);
  play.tick(10);
  EXPECT_NEAR(play.compliance.felt_stiffness_N_m(), kDevice_N_m, 1e-9);
}

// Under the force that the simulation used, the touched tissue stays where it is whatever its compliance becomes.
TEST(ContactCompliance, AChangeOfForceMovesTheUnloadedTissueAndOneOfComplianceDoesNot) {
  Play play;
  play.step(1.0, 2e-3);
  play.tick(10);
  play.step(1.0, 1e-3);
  play.tick(10);
  EXPECT_EQ(play.compliance.unloaded_moved_m().norm(), 0.0);
  play.step(1.5, 1e-3);
  play.tick();
  EXPECT_NEAR(play.compliance.unloaded_moved_m().z(), 0.1 * 0.5 * 1e-3, 1e-12);
}

// A tool that bounces meets the tissue as soft as it left it, without the force of the last touch.
TEST(ContactCompliance, OutlivesTheContact) {
  Play play;
  play.step(1.0, 2e-3);
  play.tick(10);
  const double felt_N_m = play.compliance.felt_stiffness_N_m();
  play.touching = {};
  play.step(0.0, 0.0, -1);
  play.tick(10);
  EXPECT_EQ(play.compliance.shift_m().norm(), 0.0);
  EXPECT_NEAR(play.compliance.felt_stiffness_N_m(), felt_N_m, 1e-9);
  play.compliance.forget();
  EXPECT_EQ(play.compliance.felt_stiffness_N_m(), kDevice_N_m);
}

TEST(ContactCompliance, ACompliantModelBeyondReasonIsBounded) {
  for (const double broken_m_N : {-1.0, 1e300}) {
    Play play;
    play.step(1.0, broken_m_N);
    play.tick(10);
    EXPECT_GT(play.compliance.felt_stiffness_N_m(), 5.0);
    EXPECT_LE(play.compliance.felt_stiffness_N_m(), kDevice_N_m * (1.0 + 1e-12));
  }
}

}  // namespace
}  // namespace myotact::haptics

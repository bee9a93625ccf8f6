#include "haptics/effects/contact_compliance.h"

#include <algorithm>

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
    for (const std::size_t k : {0u, 4u}) model.contact.compliance_m_N[k] = 7.0;  // along the surface: not used
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
  for (const double tissue_N_m : {200.0, 500.0, 1500.0, 9000.0}) {
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
  play.step(0.5, 4e-3, 1);
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

#include "haptics/effects/tether.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "device/device.h"
#include "haptics/faults.h"
#include "haptics/haptic_loop.h"
#include "support/allocation_guard.h"

namespace myotact::haptics {
namespace {

constexpr std::uint64_t kTick_ns = 1'000'000;
constexpr std::uint64_t kStep_ns = 10 * kTick_ns;
constexpr double kStiffness_N_m = 40.0;
constexpr double kLimit_N = 0.5 * device::DeviceProfile{}.peak_force_N;

messages::LocalModel model_at(const Vec3& anchor_m, const Vec3& velocity_m_s, std::uint64_t published_at_ns) {
  messages::LocalModel model;
  model.published_at_ns = published_at_ns;
  model.dt_ns = kStep_ns;
  model.tether = {kStiffness_N_m, to_array(anchor_m), to_array(velocity_m_s)};
  return model;
}

/// It is where it is put.
class PlacedDevice : public device::Device {
 public:
  const std::string& name() const override { return name_; }
  const device::DeviceProfile& profile() const override { return profile_; }
  void open() override {}
  void close() noexcept override {}
  bool connected() const noexcept override { return true; }
  messages::DeviceState read(std::uint64_t now_ns) noexcept override {
    messages::DeviceState state;
    state.stylus_position_world_m = place_m;
    state.sampled_at_ns = now_ns;
    return state;
  }
  void write(const messages::DeviceCommand&) noexcept override {}

  std::array<double, 3> place_m{};

 private:
  std::string name_ = "placed";
  device::DeviceProfile profile_;
};

/// A hand that is where the test puts it, in a loop on a virtual clock.
class Rig {
 public:
  Rig() : loop_(device_, HapticSettings{}) {
    loop_.prepare(now_ns_);
    rest(Vec3::Zero(), 1200);  // the gate's ramp
  }
  void rest(const Vec3& hand_m, int ticks) {
    for (int i = 0; i < ticks; ++i) tick(hand_m);
  }
  Vec3 tick(const Vec3& hand_m) {
    now_ns_ += kTick_ns;
    if (now_ns_ % kStep_ns == 0) publish();
    device_.place_m = to_array(hand_m);
    loop_.tick(now_ns_);
    return to_vec3(loop_.tool_state().force_world_N);
  }
  void publish() {
    messages::LocalModel& model = loop_.models().back();
    model = model_at(anchor_m, anchor_velocity_m_s, now_ns_);
    model.sequence = ++sequence_;
    anchor_m += 1e-9 * static_cast<double>(kStep_ns) * anchor_velocity_m_s;
    loop_.models().publish();
  }
  HapticLoop& loop() { return loop_; }
  std::uint64_t now_ns() const { return now_ns_; }

  Vec3 anchor_m = Vec3::Zero(), anchor_velocity_m_s = Vec3::Zero();

 private:
  PlacedDevice device_;
  HapticLoop loop_;
  std::uint64_t now_ns_ = kTick_ns;
  std::uint64_t sequence_ = 0;
};

TEST(Tether, GoesOnWithItsVelocityForTwoStepsAtMost) {
  const messages::LocalModel model = model_at({0.01, 0, 0}, {0, 0.5, 0}, 100 * kTick_ns);
  const auto y_after = [&](std::uint64_t ticks) { return tether_anchor_m(model, ticks * kTick_ns).y(); };
  EXPECT_EQ(y_after(100), 0.0);
  EXPECT_NEAR(y_after(107), 0.0035, 1e-15);
  EXPECT_NEAR(y_after(120), 0.01, 1e-15);
  EXPECT_EQ(y_after(500), y_after(120));
  EXPECT_EQ(y_after(90), 0.0);  // a clock that runs backwards
}

/// Hooke's law to the force limit, energy its integral.
TEST(Tether, EnergyIsTheIntegralOfTheForce) {
  const TetherSpring spring{{0.01, 0.02, 0.0}, 50.0, 1.5};
  double work_J = 0.0;
  const Vec3 step_m(1e-5, -0.5e-5, 0.7e-5);
  Vec3 hand_m = spring.anchor_m;
  for (int i = 0; i < 5000; ++i) {
    work_J -= 0.5 * (spring.force_N(hand_m) + spring.force_N(hand_m + step_m)).dot(step_m);
    hand_m += step_m;
    EXPECT_NEAR(spring.energy_J(hand_m), work_J, 1e-9);
  }
  EXPECT_NEAR(spring.force_N(hand_m).norm(), 1.5, 1e-12);
}

TEST(Tether, AStandingAnchorPullsAsASpringToTheBit) {
  Rig rig;
  for (int i = 0; i < 3000; ++i) {
    const double t_s = 1e-3 * i;
    const Vec3 hand_m = 0.035 * std::sin(4.0 * t_s) * Vec3(std::cos(t_s), std::sin(t_s), 0.3);
    const Vec3 force_N = rig.tick(hand_m);
    ASSERT_NEAR((force_N + kStiffness_N_m * hand_m).norm(), 0.0, 1e-9) << t_s;
  }
  EXPECT_EQ(rig.loop().tool_state().faults & bit(Fault::EnergyInjected), 0u);
}

/// A hand that stands still, round which the anchor is led: as a hand is by slow tissue, without damping.
TEST(Tether, AMovingAnchorIsFollowedBetweenTheModels) {
  Rig rig;
  rig.anchor_velocity_m_s = {0.02, 0.01, 0.0};
  Vec3 anchor_m = rig.anchor_m;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 force_N = rig.tick(Vec3::Zero());
    if (rig.now_ns() % kStep_ns == 0 && i > 10) anchor_m = rig.anchor_m - 0.01 * rig.anchor_velocity_m_s;
    if (i <= 20) continue;
    const double since_s = 1e-9 * static_cast<double>(rig.now_ns() % kStep_ns);
    ASSERT_NEAR((force_N - kStiffness_N_m * (anchor_m + since_s * rig.anchor_velocity_m_s)).norm(), 0.0, 1e-9) << i;
  }
}

TEST(Tether, TheForceStaysWithinTheLimitAndIsNamedInItsParts) {
  Rig rig;
  Vec3 force_N;
  for (int i = 0; i < 300; ++i) force_N = rig.tick({3e-4 * i, 0.0, 0.0});
  EXPECT_NEAR(force_N.x(), -kLimit_N, 1e-9);
  const messages::ForceParts& parts = rig.loop().felt_tool().parts;
  EXPECT_NEAR((to_vec3(parts.tether) - force_N).norm(), 0.0, 1e-9);
  EXPECT_NEAR(to_vec3(parts.limits).norm(), 0.0, 1e-9);
}

TEST(Tether, AnUnsoundOneIsAFaultAndNoForce) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const messages::LocalTether& bad :
       {messages::LocalTether{nan, {}, {}}, messages::LocalTether{1.0, {nan, 0, 0}, {}},
        messages::LocalTether{1.0, {}, {0, nan, 0}}}) {
    Rig rig;
    rig.rest({0.01, 0, 0}, 5);
    rig.loop().models().back() = {};
    rig.loop().models().back().tether = bad;
    rig.loop().models().publish();
    EXPECT_EQ(rig.tick({0.01, 0, 0}).norm(), 0.0);
    EXPECT_NE(rig.loop().tool_state().faults & bit(Fault::BadModel), 0u);
  }
}

TEST(Tether, ATickAllocatesNothing) {
  Rig rig;
  rig.anchor_velocity_m_s = {0.02, 0.0, 0.0};
  const support::AllocationGuard guard;
  for (int i = 0; i < 200; ++i) rig.tick({1e-4 * i, 0.0, 0.0});
  EXPECT_EQ(guard.allocations(), 0u);
}

}  // namespace
}  // namespace myotact::haptics

// What an engine gets wrong, through the whole chain to the device: the force keeps to the gate's rules.

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "device/simulated_device.h"
#include "floor_engine.h"
#include "haptics/faults.h"
#include "layer/lockstep_layer.h"

namespace myotact::layer {
namespace {

using haptics::ForceMethod;
using haptics::GateState;

/// Of the force from tick to tick, by the gate: 300 N/s.
constexpr double kMostRise_N = haptics::GateSettings{}.slew_N_s * 1e-3 + 1e-9;

struct Spoilt {
  std::string name;
  ForceMethod method = ForceMethod::Plane;
  ReportDefect defect = ReportDefect::NotFinite;
  void (*spoil)(FloorEngine&) = nullptr;
};

void spoil_contact(FloorEngine& engine, void (*spoil)(messages::ReportedContact&)) {
  engine.spoil_report = [spoil](messages::ReportedContacts& reported) { spoil(reported.contacts[0]); };
}

const std::vector<Spoilt>& spoilt_reports() {
  using messages::ReportedContact;
  static const std::vector<Spoilt> kinds = {
      {"NaNDepth", ForceMethod::Penetration, ReportDefect::NotFinite,
       [](FloorEngine& e) { spoil_contact(e, [](ReportedContact& c) { c.penetration_m = kNaN; }); }},
      {"NaNPoint", ForceMethod::Plane, ReportDefect::NotFinite,
       [](FloorEngine& e) { spoil_contact(e, [](ReportedContact& c) {
                              c.point_world_m = {kNaN, 0, 0};
                            }); }},
      {"NoNormal", ForceMethod::Plane, ReportDefect::NoNormal,
       [](FloorEngine& e) { spoil_contact(e, [](ReportedContact& c) { c.normal_world = {}; }); }},
      {"LongNormal", ForceMethod::Penetration, ReportDefect::NoNormal,
       [](FloorEngine& e) { spoil_contact(e, [](ReportedContact& c) {
                              c.normal_world = {0, 0, 100};
                            }); }},
      {"Apart", ForceMethod::Penetration, ReportDefect::NegativeDepth,
       [](FloorEngine& e) { spoil_contact(e, [](ReportedContact& c) { c.penetration_m = -1e-3; }); }},
      {"NoSuchBody", ForceMethod::Plane, ReportDefect::NoSuchBody,
       [](FloorEngine& e) { spoil_contact(e, [](ReportedContact& c) { c.surface = 77; }); }},
      {"LostBody", ForceMethod::Plane, ReportDefect::LostBody, [](FloorEngine& e) { e.lost = true; }},
      {"NaNTool", ForceMethod::Penetration, ReportDefect::NotFinite,
       [](FloorEngine& e) {
         e.spoil_report = [](messages::ReportedContacts& reported) { reported.tool_world_m[1] = kNaN; };
       }},
      {"NaNSurface", ForceMethod::Proxy, ReportDefect::UnsoundSurface,
       [](FloorEngine& e) { e.spoil_model = [](messages::LocalModel& model) { model.current_world_m[7][2] = kNaN; }; }},
      {"NaNSurfaceUnderReports", ForceMethod::Plane, ReportDefect::UnsoundSurface,
       [](FloorEngine& e) {
         e.spoil_model = [](messages::LocalModel& model) { model.previous_world_m[7][2] = kNaN; };
       }},
      {"NaNPoseOfABone", ForceMethod::Proxy, ReportDefect::UnsoundSurface,
       [](FloorEngine& e) {
         e.spoil_model = [](messages::LocalModel& model) { model.grip.position_world_m[0] = kNaN; };
       }},
      {"FarTriangles", ForceMethod::Proxy, ReportDefect::UnsoundSurface,
       [](FloorEngine& e) {
         e.spoil_model = [](messages::LocalModel& model) { model.triangles[3].vertices[1] = 5000; };
       }},
  };
  return kinds;
}

/// A tool that presses on the floor with some 1 N.
class Pressing {
 public:
  explicit Pressing(ForceMethod method) : lockstep_(engine_, std::array{LayerTool{&device_, settings(method)}}) {
    run(700);
  }

  void run(int ticks) {
    for (int i = 0; i < ticks; ++i, ++tick_) {
      device_.set_hand_target({{0, 0, tick_ < 200 ? 0.01 : -2e-3}, {}, 0});
      lockstep_.tick();
      const double last_N = force_N;
      force_N = to_vec3(lockstep_.loop(0).tool_state().force_world_N).norm();
      const double limit_N = 0.5 * device_.profile().peak_force_N;
      ASSERT_TRUE(std::isfinite(force_N));
      ASSERT_LE(force_N, limit_N + 1e-12);
      ASSERT_LE(force_N - last_N, kMostRise_N);
      faults |= lockstep_.loop(0).tool_state().faults;
    }
  }
  GateState gate() { return lockstep_.loop(0).gate_state(); }
  FloorEngine& engine() { return engine_; }
  LockstepLayer& lockstep() { return lockstep_; }
  std::uint64_t count(ReportDefect defect) { return lockstep_.layer().check().count(defect); }

  double force_N = 0.0;
  std::uint32_t faults = 0;

 private:
  static haptics::HapticSettings settings(ForceMethod method) {
    haptics::HapticSettings settings;
    settings.method = method;
    settings.contact.radius_m = kRadius_m;
    settings.gate.ramp_s = 0.2;
    return settings;
  }
  device::SimulatedDevice device_{"simulated", Vec3(0, 0, 0.01)};
  FloorEngine engine_;
  LockstepLayer lockstep_;
  int tick_ = 0;
};

class SpoiltReport : public ::testing::TestWithParam<Spoilt> {};

TEST_P(SpoiltReport, GivesNoForceAndComesBackByTheGatesRules) {
  const Spoilt& spoilt = GetParam();
  const bool whole_model = spoilt.defect == ReportDefect::UnsoundSurface;
  Pressing hand(spoilt.method);
  ASSERT_GT(hand.force_N, 0.8);
  ASSERT_EQ(hand.gate(), GateState::On);
  hand.faults = 0;
  spoilt.spoil(hand.engine());
  hand.run(17);  // one report: the contact, or the whole model, is gone
  EXPECT_EQ(hand.force_N, 0.0);
  hand.run(283);
  EXPECT_EQ(hand.force_N, 0.0);
  EXPECT_GE(hand.count(spoilt.defect), 17u);
  EXPECT_EQ((hand.faults & haptics::bit(haptics::Fault::BadModel)) != 0, whole_model);
  hand.engine().spoil_report = nullptr;
  hand.engine().spoil_model = nullptr;
  hand.engine().lost = false;
  const auto count = hand.count(spoilt.defect);
  hand.run(18);
  EXPECT_EQ(hand.gate(), whole_model ? GateState::Ramp : GateState::On);
  if (whole_model) {
    EXPECT_LT(hand.force_N, 0.2);  // a tenth of the ramp
  }
  hand.run(600);
  EXPECT_GT(hand.force_N, 0.8);
  EXPECT_EQ(hand.gate(), GateState::On);
  EXPECT_EQ(hand.count(spoilt.defect), count);
}

INSTANTIATE_TEST_SUITE_P(Kinds, SpoiltReport, ::testing::ValuesIn(spoilt_reports()),
                         [](const auto& which) { return which.param.name; });

/// More contacts than there is room for: the first ones are felt as they are.
TEST(SpoiltReports, TooManyContactsAreStillFelt) {
  Pressing hand(ForceMethod::Penetration);
  const double before_N = hand.force_N;
  hand.engine().spoil_report = [](messages::ReportedContacts& reported) {
    reported.contacts.fill(reported.contacts[0]);
    reported.count = 1000;
  };
  hand.run(300);
  EXPECT_NEAR(hand.force_N, before_N, 0.05);
  EXPECT_GE(hand.count(ReportDefect::TooMany), 17u);
}

/// The force gate: fade after max(30 ms, 2 steps), zero at 100 ms, back through RAMP; and the layer names who hangs.
TEST(SpoiltReports, AnEngineThatHangsFadesTheForceAndIsNamed) {
  for (const ForceMethod method : {ForceMethod::Proxy, ForceMethod::Penetration, ForceMethod::Plane}) {
    Pressing hand(method);
    const double pressed_N = hand.force_N;
    LockstepLayer& lockstep = hand.lockstep();
    const auto now_ns = [&] { return static_cast<std::uint64_t>(1e9 * lockstep.time_s()); };
    const int steps = hand.engine().steps;
    while (hand.engine().steps == steps) hand.run(1);
    const std::uint64_t since_ns = now_ns();
    lockstep.let_engine_run(false);
    hand.run(30);
    EXPECT_NEAR(hand.force_N, pressed_N, 0.05);  // two steps are 33 ms
    hand.run(30);
    EXPECT_LT(hand.force_N, 0.8 * pressed_N);
    EXPECT_EQ(hand.gate(), GateState::Fade);
    hand.run(45);
    EXPECT_EQ(hand.force_N, 0.0);
    EXPECT_FALSE(lockstep.layer().silent_since_ns(now_ns()));
    hand.run(105);
    EXPECT_EQ(hand.force_N, 0.0);
    ASSERT_TRUE(lockstep.layer().silent_since_ns(now_ns()));
    EXPECT_NEAR(static_cast<double>(*lockstep.layer().silent_since_ns(now_ns())), static_cast<double>(since_ns), 2e6);
    EXPECT_EQ(hand.count(ReportDefect::Silent), 0u);
    lockstep.let_engine_run(true);
    hand.run(18);
    EXPECT_EQ(hand.count(ReportDefect::Silent), 1u);
    EXPECT_FALSE(lockstep.layer().silent_since_ns(now_ns()));
    EXPECT_EQ(hand.gate(), GateState::Ramp);
    EXPECT_LT(hand.force_N, 0.3 * pressed_N);
    hand.run(600);
    EXPECT_GT(hand.force_N, 0.8);
  }
}

}  // namespace
}  // namespace myotact::layer

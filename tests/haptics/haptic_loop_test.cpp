#include "haptics/haptic_loop.h"

#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "device/replay_device.h"
#include "device/simulated_device.h"
#include "haptics/effort.h"
#include "haptics/faults.h"
#include "haptics/haptic_thread.h"
#include "haptics/surfaces.h"
#include "realtime/periodic_loop.h"
#include "support/allocation_guard.h"

namespace myotact::haptics {
namespace {

constexpr std::uint64_t kTick_ns = 1'000'000;
constexpr std::uint64_t kStep_ns = 10 * kTick_ns;

HapticSettings quick_to_ramp() {
  HapticSettings settings;
  settings.gate.ramp_s = 0.1;
  settings.gate.force_limit = 1.0;
  return settings;
}

/// A flat block whose top swings by 2 mm, a muscle line above it, and a simulated hand: all in lockstep.
class Scene {
 public:
  explicit Scene(double swing_m, const HapticSettings& settings = quick_to_ramp())
      : loop(device, settings), swing_m_(swing_m) {
    device.set_hand_target({{0, 0, 0.01}, {}, 0});
    loop.prepare(now_ns_ = kTick_ns);
    publish();
  }

  void publish() {
    for (std::size_t i = 0; i < plane_.positions_m.size(); ++i) previous_m_[i] = current_m_[i];
    const double height_m = swing_m_ * std::sin(3e-9 * static_cast<double>(now_ns_));
    for (std::size_t i = 0; i < plane_.positions_m.size(); ++i)
      current_m_[i] = plane_.positions_m[i] + Vec3(0, 0, height_m);
    messages::LocalModel& model = loop.models().back();
    write_patch(plane_, previous_m_, current_m_, to_vec3(loop.tool_state().proxy_position_world_m), model);
    model.sequence = ++sequence_;
    model.published_at_ns = now_ns_ - older_ns;
    model.dt_ns = kStep_ns;
    model.line.muscle = 0;
    model.line.proximal_point_world_m = {-0.1, 0, 0.01};
    model.line.distal_point_world_m = {0.1, 0, 0.01};
    model.line.length_m = 0.2;
    model.line.tension_N = 5.0;
    model.tool_sequence = loop.tool_state().sequence;
    model.grip.body = 0;
    model.grip.point_rest_m = {0, 0, 0.01};
    model.grip.position_world_m = {0, 0, 0.01};
    model.grip.mobility_1_kg = {5, 0, 0, 0, 5, 0, 0, 0, 5};
    loop.models().publish();
  }

  void tick() {
    now_ns_ += kTick_ns;
    loop.tick(now_ns_);
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      tick();
      if (now_ns_ % kStep_ns == 0) publish();
    }
  }

  device::SimulatedDevice device{"simulated", Vec3(0, 0, 0.01)};
  HapticLoop loop;
  std::uint64_t older_ns = 0;  // by which the models' content is older than the step

 private:
  geometry::TriangleMesh plane_ = geometry::make_plane(0.06, 10);
  std::vector<Vec3> previous_m_ = plane_.positions_m, current_m_ = plane_.positions_m;
  double swing_m_;
  std::uint64_t now_ns_ = 0;
  std::uint64_t sequence_ = 0;
};

/// Vibration of 60 mN, stirred out of a slide at some 0.1 m/s: the ports let it through, and take it for no
/// instability.
TEST(HapticLoop, TextureReachesTheHand) {
  HapticSettings smooth = quick_to_ramp(), textured = quick_to_ramp();
  TextureSet& set = textured.texture.by_tissue[0];
  set.vibration.force_N = {0.1};
  set.vibration.speed_m_s = {0.02};
  set.vibration.nodes = {{{}, 0.06}};
  set.relief = {{2e-3, 0.3, 1e-5, 0.0}};
  Scene without(0.0, smooth), with(0.0, textured);
  double squares = 0.0, damping_Ns_m = 0.0;
  int count = 0;
  std::uint32_t faults = 0;
  for (int tick = 0; tick < 3000; ++tick) {
    const double turn_rad = 0.01 * tick;
    for (Scene* scene : {&without, &with}) {
      scene->device.set_hand_target({{10e-3 * std::cos(turn_rad), 10e-3 * std::sin(turn_rad), -0.003}, {}, 0});
      scene->run(1);
    }
    if (tick < 1000) continue;
    squares += (to_vec3(with.loop.tool_state().force_world_N) - to_vec3(without.loop.tool_state().force_world_N))
                   .squaredNorm();
    damping_Ns_m += with.loop.ports().port(place_of<TextureEffect>()).damping_Ns_m();
    faults |= with.loop.tool_state().faults;
    ++count;
  }
  const double felt_N = std::sqrt(squares / count);
  std::printf("texture of 60 mN and a relief: %.1f mN reach the hand, %.4f N s/m of damping\n", 1e3 * felt_N,
              damping_Ns_m / count);
  EXPECT_GT(felt_N, 0.05);
  EXPECT_LT(felt_N, 0.15);
  EXPECT_LT(damping_Ns_m / count, 0.05);
  EXPECT_EQ(faults & (bit(Fault::EnergyInjected) | bit(Fault::Buzz)), 0u);
}

TEST(HapticLoop, ATickNeverAllocates) {
  Scene scene(2e-3);
  std::uint64_t allocations = 0;
  int contacts = 0;
  int grabs = 0, bone_grabs = 0;
  for (int tick = 0; tick < 1000 * kEffort; ++tick) {
    const bool grab = tick % 1000 > 700;
    const bool grab_bone = tick % 1000 > 450 && !grab;
    scene.device.set_hand_target({{5e-3 * std::sin(0.003 * tick), 0, grab ? 0.02 : -0.005},
                                  {},
                                  grab        ? messages::kGrabButton
                                  : grab_bone ? messages::kGrabBoneButton
                                              : 0});
    const support::AllocationGuard guard;
    scene.tick();
    allocations += guard.allocations();
    contacts += scene.loop.tool_state().contact.surface >= 0;
    grabs += scene.loop.tool_state().grabbed_line >= 0;
    bone_grabs += scene.loop.tool_state().grabbed_body >= 0;
    if (tick % 10 == 9) scene.publish();
    for (HapticTick record; scene.loop.ticks().pop(record);) {
    }
  }
  EXPECT_EQ(allocations, 0u);
  EXPECT_GT(contacts, 100 * kEffort);  // the ticks did their whole work
  EXPECT_GT(grabs, 100 * kEffort);
  EXPECT_GT(bone_grabs, 100 * kEffort);
}

TEST(HapticLoop, PressingABlockIsAHandSpringAgainstTheCoupling) {
  Scene scene(0.0);
  scene.run(200);
  const double pressed_to_m = -2e-3;
  for (int i = 0; i < 400; ++i) {
    scene.device.set_hand_target({{0, 0, pressed_to_m}, {}, 0});
    scene.run(1);
  }
  const ContactSettings contact;
  const device::HandProfile hand;
  const double depth_m = contact.radius_m - scene.device.position_world_m().z();
  const double force_N = scene.loop.tool_state().force_world_N[2];
  EXPECT_NEAR(force_N, contact.stiffness_N_m * depth_m, 0.02 * force_N + contact.stiffness_N_m * 20e-6);
  // Hand: k_h (x - target) = F up to the device's own friction.
  EXPECT_NEAR(hand.stiffness_N_m * (scene.device.position_world_m().z() - pressed_to_m), force_N, 0.11);
}

TEST(HapticLoop, HandsTheOppositeForceBackAsASpring) {
  Scene scene(0.0);
  scene.run(200);
  scene.device.set_hand_target({{0, 0, -2e-3}, {}, 0});
  scene.run(400);
  const messages::ToolState& tool = scene.loop.tool_state();
  ASSERT_EQ(tool.contact.surface, 0);
  const messages::ToolContact& contact = tool.contact;
  // The plane rests at z = 0, so the touched point is below the proxy.
  const Vec3 touched_m(tool.proxy_position_world_m[0], tool.proxy_position_world_m[1], 0.0);
  const Vec3 on_tissue_N = contact.stiffness_N_m * (to_vec3(contact.target_world_m) - touched_m);
  EXPECT_NEAR((on_tissue_N + to_vec3(tool.force_world_N)).norm(), 0.0, 1e-3);
  EXPECT_NEAR(contact.barycentric[0] + contact.barycentric[1] + contact.barycentric[2], 1.0, 1e-12);
  EXPECT_EQ(contact.normal_world[2], 1.0);
}

TEST(HapticLoop, GrabsTheLineAndTellsTheSimulation) {
  Scene scene(0.0);
  scene.run(200);
  scene.device.set_hand_target({{0, 0, 0.02}, {}, messages::kGrabButton});
  scene.run(400);
  const HapticTick& last = scene.loop.last_tick();
  EXPECT_EQ(last.tool.grabbed_line, 0);
  EXPECT_GT(last.tool.line_stiffness_N_m, 0.0);
  EXPECT_EQ(last.line_tension_N, 5.0);
  const double d_m = last.tool.tool_position_world_m[2] - 0.01;
  EXPECT_NEAR(last.tool.force_world_N[2], -2.0 * 5.0 * d_m / std::hypot(0.1, d_m), 1e-6);
}

TEST(HapticLoop, ABrokenModelIsIgnoredAndReported) {
  Scene scene(0.0);
  scene.run(20);
  messages::LocalModel& model = scene.loop.models().back();
  model = {};
  model.triangle_count = 7;
  model.triangles[0].vertices = {0, 1, 1'000'000};
  scene.loop.models().publish();
  scene.tick();
  EXPECT_NE(scene.loop.tool_state().faults & bit(Fault::BadModel), 0u);
  EXPECT_EQ(scene.loop.tool_state().force_world_N[2], 0.0);
  scene.publish();
  scene.run(10);
  EXPECT_EQ(scene.loop.tool_state().faults, 0u);
  scene.loop.models().back() = {};
  scene.loop.models().back().grip.mobility_1_kg[4] = std::numeric_limits<double>::quiet_NaN();
  scene.loop.models().publish();
  scene.tick();
  EXPECT_NE(scene.loop.tool_state().faults & bit(Fault::BadModel), 0u);
}

TEST(HapticLoop, ADeviceThatSendsNoNumbersGetsNoForce) {
  std::vector<messages::DeviceState> states(3);
  states[1].stylus_position_world_m[0] = std::numeric_limits<double>::quiet_NaN();
  device::ReplayDevice device(states, {});
  HapticLoop loop(device, {});
  loop.prepare(0);
  for (std::uint64_t tick = 1; tick <= 3; ++tick) {
    loop.tick(tick * kTick_ns);
    EXPECT_EQ((loop.tool_state().faults & bit(Fault::NonFiniteDevice)) != 0, tick == 2);
    EXPECT_TRUE(to_vec3(loop.tool_state().tool_position_world_m).allFinite());
    EXPECT_EQ(to_vec3(loop.tool_state().force_world_N).norm(), 0.0);
  }
}

TEST(HapticLoop, StopGivesZeroAndEnablingRampsUpAgain) {
  Scene scene(0.0);
  scene.run(200);
  scene.device.set_hand_target({{0, 0, 0.0}, {}, 0});
  scene.run(300);
  EXPECT_GT(scene.loop.tool_state().force_world_N[2], 0.1);
  scene.loop.stop_forces(true);
  scene.run(1);
  EXPECT_EQ(scene.loop.tool_state().force_world_N[2], 0.0);
  EXPECT_EQ(scene.loop.gate_state(), GateState::Off);
  scene.device.set_hand_target({{0, 0, 0.01}, {}, 0});
  scene.loop.stop_forces(false);
  scene.run(200);
  EXPECT_EQ(scene.loop.gate_state(), GateState::On);
}

TEST(HapticLoop, TheDevicesStopButtonStopsUntilForcesAreEnabledAgain) {
  Scene scene(0.0);
  scene.run(200);
  scene.device.set_hand_target({{0, 0, 0.0}, {}, 0});
  scene.run(300);
  ASSERT_GT(scene.loop.tool_state().force_world_N[2], 0.1);
  scene.device.set_hand_target({{0, 0, 0.0}, {}, messages::kStopButton});
  scene.run(1);
  EXPECT_EQ(scene.loop.tool_state().force_world_N[2], 0.0);
  scene.loop.stop_forces(false);  // while the button is down nothing comes back
  scene.run(10);
  EXPECT_EQ(scene.loop.gate_state(), GateState::Off);
  scene.device.set_hand_target({{0, 0, 0.01}, {}, 0});
  scene.run(500);
  EXPECT_EQ(scene.loop.gate_state(), GateState::Off);  // nor by letting go of it
  EXPECT_NE(scene.loop.tool_state().faults & bit(Fault::Stopped), 0u);
  scene.loop.stop_forces(false);
  scene.run(200);
  EXPECT_EQ(scene.loop.gate_state(), GateState::On);
}

TEST(HapticLoop, AStiffnessBeyondTheBoundIsLoweredWithOneNotice) {
  HapticSettings settings = quick_to_ramp();
  settings.contact.stiffness_N_m = 5000.0;
  Scene scene(0.0, settings);
  EXPECT_NE(scene.loop.notice().find("5000"), std::string::npos);
  scene.run(200);
  scene.device.set_hand_target({{0, 0, -2e-3}, {}, 0});
  scene.run(400);
  EXPECT_EQ(scene.loop.tool_state().contact.stiffness_N_m, device::DeviceProfile{}.max_stiffness_N_m);
  settings.limit_stiffness = false;
  Scene unlimited(0.0, settings);
  EXPECT_EQ(unlimited.loop.notice(), "");
}

TEST(HapticLoop, AnOldAnswerOfTheSimulationSoftensTheContact) {
  Scene scene(0.0);
  scene.older_ns = 190'000'000;  // 0.2 s with the step: 80 N s/m / 0.2 s = 400 N/m
  scene.run(200);
  scene.device.set_hand_target({{0, 0, 0.0}, {}, 0});
  scene.run(400);
  EXPECT_NEAR(scene.loop.tool_state().contact.stiffness_N_m, 400.0, 20.0);
  EXPECT_NE(scene.loop.tool_state().faults & bit(Fault::StiffnessLowered), 0u);
  scene.older_ns = 0;
  scene.run(4000);
  EXPECT_NEAR(scene.loop.tool_state().contact.stiffness_N_m, ContactSettings{}.stiffness_N_m, 1.0);
}

TEST(HapticLoop, AWatchdogsCutComesBackThroughTheRamp) {
  Scene scene(0.0);
  scene.run(200);
  scene.device.set_hand_target({{0, 0, 0.0}, {}, 0});
  scene.run(300);
  ASSERT_GT(scene.loop.tool_state().force_world_N[2], 0.1);
  scene.loop.note_cut();
  scene.run(1);
  EXPECT_EQ(scene.loop.tool_state().force_world_N[2], 0.0);
  EXPECT_NE(scene.loop.tool_state().faults & bit(Fault::WatchdogCut), 0u);
  EXPECT_EQ(scene.loop.gate_state(), GateState::Armed);
}

/// The parts of the force on the hand as vectors.
struct Parts {
  explicit Parts(const HapticLoop& loop)
      : Parts(loop.felt_tool().parts, to_vec3(loop.felt_tool().tool.force_world_N)) {}
  Parts(const messages::ForceParts& parts, const Vec3& force_N)
      : contact(to_vec3(parts.contact)),
        friction(to_vec3(parts.friction)),
        texture(to_vec3(parts.texture)),
        line(to_vec3(parts.line)),
        bone(to_vec3(parts.bone)),
        damping(to_vec3(parts.damping)),
        limits(to_vec3(parts.limits)),
        error_N((contact + friction + texture + line + bone + damping + limits - force_N).norm()) {}

  Vec3 contact, friction, texture, line, bone, damping, limits;
  double error_N;
};

TEST(ForceParts, AddUpThroughTouchSlideLineBoneSaturationAndStop) {
  HapticSettings settings = quick_to_ramp();
  settings.texture.by_tissue[0].relief = {{2e-3, 0.3, 1e-5, 0.0}};
  Scene scene(1e-3, settings);
  double worst_N = 0.0;
  Vec3 largest[7] = {};
  for (int tick = 0; tick < 4000; ++tick) {
    const int phase = tick / 500;  // 0 above, 1 touch, 2 slide, 3 line, 4 away, 5 bone, 6 far too deep, 7 stopped
    const std::uint32_t buttons = phase == 3 ? messages::kGrabButton : phase == 5 ? messages::kGrabBoneButton : 0;
    const double height_m = phase == 0 || phase == 4   ? 0.012
                            : phase == 3 || phase == 5 ? 0.02
                            : phase == 6               ? -0.05
                                                       : -3e-3;
    const double along_m = phase == 2 ? 0.012 * std::sin(0.02 * tick) : 0.0;
    scene.device.set_hand_target({{along_m, 0, height_m}, {}, buttons});
    if (tick == 3500) scene.loop.stop_forces(true);
    scene.run(1);
    const Parts now(scene.loop);
    worst_N = std::max(worst_N, now.error_N);
    const Vec3* parts[] = {&now.contact, &now.friction, &now.texture, &now.line, &now.bone, &now.damping, &now.limits};
    for (int k = 0; k < 7; ++k)
      if (parts[k]->norm() > largest[k].norm()) largest[k] = *parts[k];
  }
  EXPECT_LT(worst_N, 1e-9);
  for (const Vec3& one_N : largest) EXPECT_GT(one_N.norm(), 1e-4);  // every part had its turn
}

TEST(ForceParts, ContactIsAcrossTheSurfaceAndFrictionAlongIt) {
  Scene scene(0.0);
  scene.run(200);
  double share = 0.0;
  for (int tick = 0; tick < 1000; ++tick) {
    scene.device.set_hand_target({{1e-5 * tick, 0, -2e-3}, {}, 0});
    scene.run(1);
    const Parts now(scene.loop);
    EXPECT_LT(now.contact.head<2>().norm(), 1e-12);  // the plane's normal is z
    EXPECT_LT(std::abs(now.friction.z()), 1e-12);
    EXPECT_EQ(now.line.norm() + now.bone.norm(), 0.0);
    if (tick < 300) continue;
    EXPECT_GT(now.contact.z(), 0.1);
    EXPECT_LT(now.friction.x(), 0.0);  // against the slide
    EXPECT_LT(now.limits.norm(), 1e-9);
    share = now.friction.norm() / now.contact.z();
  }
  EXPECT_NEAR(share, ContactSettings().dynamic_friction, 0.05 * ContactSettings().dynamic_friction);
}

TEST(ForceParts, TheLineInHandPullsAsAStringDoes) {
  Scene scene(0.0);
  scene.run(200);
  scene.device.set_hand_target({{0, 0, 0.02}, {}, messages::kGrabButton});
  scene.run(400);
  const double d_m = scene.loop.tool_state().tool_position_world_m[2] - 0.01;
  const Parts now(scene.loop);
  EXPECT_NEAR(now.line.z(), -2.0 * 5.0 * d_m / std::hypot(0.1, d_m), 1e-6);
  EXPECT_EQ(now.contact.norm() + now.friction.norm() + now.texture.norm() + now.bone.norm(), 0.0);
  EXPECT_EQ(scene.loop.felt_tool().line_tension_N, 5.0);
}

TEST(ForceParts, LimitsTakeWhatAStopAndTheLargestForceTake) {
  HapticSettings weak = quick_to_ramp();
  weak.gate.force_limit = 0.1;
  weak.limit_stiffness = false;
  Scene scene(0.0, weak);
  scene.run(200);
  scene.device.set_hand_target({{0, 0, -2e-3}, {}, 0});
  scene.run(500);
  const double most_N = 0.1 * device::DeviceProfile{}.peak_force_N;
  EXPECT_LE(to_vec3(scene.loop.tool_state().force_world_N).norm(), most_N + 1e-12);
  scene.loop.stop_forces(true);
  scene.run(1);
  const Parts stopped(scene.loop);
  EXPECT_GT(stopped.contact.z(), 0.05);
  EXPECT_LT((stopped.limits + stopped.contact + stopped.friction + stopped.damping).norm(), 1e-9);
}

TEST(ForceParts, TheAgeOfTheModelGrowsFromTickToTick) {
  Scene scene(0.0);
  scene.run(203);  // three ticks after a model; models show the end of a step of 10 ms
  EXPECT_NEAR(scene.loop.felt_tool().model_age_s, 0.010 + 1e-3 * (203 % 10), 2e-3);
  const double before_s = scene.loop.felt_tool().model_age_s;
  scene.run(1);
  EXPECT_NEAR(scene.loop.felt_tool().model_age_s - before_s, 1e-3, 1e-12);
}

TEST(HapticLoop, JumpingPlacesAndClocksNeverBreakTheLoop) {
  std::vector<messages::DeviceState> states;
  for (int i = 0; i < 400; ++i) {
    messages::DeviceState state;
    const double far_m = i % 7 == 0 ? 1e300 : i % 5 == 0 ? -40.0 : 1e-3 * i;
    state.stylus_position_world_m = {far_m, 0.0, i % 11 == 0 ? 1e8 : 0.0};
    state.stylus_velocity_world_m_s = {i % 13 == 0 ? std::numeric_limits<double>::infinity() : 1e6, 0.0, 0.0};
    states.push_back(state);
  }
  device::ReplayDevice device(states, {});
  HapticLoop loop(device, quick_to_ramp());
  loop.prepare(1'000 * kTick_ns);
  for (std::uint64_t tick = 0; tick < 400; ++tick) {
    loop.tick(tick % 3 == 0 ? 0 : tick % 17 == 0 ? ~std::uint64_t{0} : tick * kTick_ns);
    EXPECT_TRUE(to_vec3(loop.tool_state().force_world_N).allFinite());
    EXPECT_LE(to_vec3(loop.tool_state().force_world_N).norm(), device.profile().peak_force_N);
  }
}

TEST(HapticLoop, TheSameInputsGiveTheSameBits) {
  const auto play = [] {
    Scene scene(2e-3);
    std::vector<double> forces_N;
    for (int i = 0; i < 500; ++i) {
      scene.device.set_hand_target({{5e-5 * i, 0, i > 200 ? -3e-3 : 0.01}, {}, 0});
      scene.run(1);
      for (const double f : scene.loop.tool_state().force_world_N) forces_N.push_back(f);
    }
    return forces_N;
  };
  EXPECT_EQ(play(), play());
}

TEST(HapticThread, TicksAtOneKilohertzAndStopsWithoutForce) {
  device::SimulatedDevice device("simulated", Vec3(0, 0, 0.01));
  HapticLoop loop(device, {});
  loop.prepare(realtime::steady_now_ns());
  HapticThread thread(loop);
  thread.start();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  thread.stop();
  const std::uint64_t all = thread.tick_count() + thread.missed_count();
  EXPECT_GE(all, 80u);
  EXPECT_LE(all, 200u);  // a busy machine may sleep longer than asked
  EXPECT_EQ(thread.ticks().summary().count, thread.tick_count());
  EXPECT_EQ(loop.gate_state(), GateState::Off);
  EXPECT_EQ(to_vec3(loop.tool_state().force_world_N).norm(), 0.0);
}

}  // namespace
}  // namespace myotact::haptics

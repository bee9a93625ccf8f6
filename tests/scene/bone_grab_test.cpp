// A bone in hand: loop and simulated limb, coupled as a session couples them. The limb is a rod of 0.2 m on a hinge at
// the origin, held 0.2 m from it; what it must do has closed forms.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "device/mouse_device.h"
#include "device/simulated_device.h"
#include "haptics/faults.h"
#include "haptics/haptic_loop.h"
#include "simulation/simulation.h"
#include "support/synthetic_specimen.h"

namespace myotact::scene {
namespace {

constexpr std::uint64_t kTick_ns = 1'000'000, kStep_ns = 10 * kTick_ns;
constexpr double kTick_s = 1e-3;
const Vec3 kPaw_m(0.212, 0.0, 0.0);  // 12 mm before the end of the rod, level with the axis

/// A stylus that is where the test puts it.
class HeldDevice : public device::Device {
 public:
  explicit HeldDevice(const Vec3& position_m) : position_m(position_m) {
    profile_.peak_force_N = profile_.continuous_force_N = 20.0;
  }
  const std::string& name() const override { return name_; }
  const device::DeviceProfile& profile() const override { return profile_; }
  void open() override {}
  void close() noexcept override {}
  bool connected() const noexcept override { return true; }
  messages::DeviceState read(std::uint64_t now_ns) noexcept override {
    const Vec3 velocity_m_s =
        now_ns > last_ns_ ? Vec3((position_m - last_m_) * 1e9 / static_cast<double>(now_ns - last_ns_)) : Vec3::Zero();
    last_m_ = position_m;
    last_ns_ = now_ns;
    return {to_array(position_m), to_array(velocity_m_s), now_ns, holds ? messages::kGrabBoneButton : 0};
  }
  void write(const messages::DeviceCommand&) noexcept override {}

  Vec3 position_m;
  bool holds = false;

 private:
  std::string name_ = "held";
  device::DeviceProfile profile_;
  Vec3 last_m_ = position_m;
  std::uint64_t last_ns_ = 0;
};

/// The rod alone: no muscles, `times` as heavy.
anatomy::Specimen rod(double times = 1.0, double stiffness_Nm_rad = 6.0) {
  anatomy::Specimen specimen = testing::hinged_bones();
  specimen.bodies[1].mass_kg *= times;
  for (double& inertia : specimen.bodies[1].inertia_kg_m2) inertia *= times;
  specimen.joints[0].stiffness_Nm_rad = stiffness_Nm_rad;
  return specimen;
}
constexpr double kRodDamping_Nms_rad = 0.02;

haptics::HapticSettings quick_to_ramp(double force_scale = 1.0) {
  haptics::HapticSettings settings;
  settings.gate.ramp_s = 0.1;
  settings.gate.force_limit = 1.0;
  settings.force_scale = force_scale;
  return settings;
}

/// Ticks and steps on one clock. A model is in use from the step's end on, or `late` steps after it.
class Limb {
 public:
  Limb(const anatomy::Specimen& specimen, device::Device& device, const haptics::HapticSettings& settings, int late = 0)
      : simulation(specimen, {}), loop(device, settings), late_(late) {
    const std::vector<double> angles(specimen.joints.size(), 0.0);
    simulation.settle(angles, {});
    loop.prepare(now_ns_ = kTick_ns);
    publish();
  }

  void tick() {
    now_ns_ += kTick_ns;
    loop.tick(now_ns_);
    if (now_ns_ % kStep_ns != 0) return;
    simulation.step({&loop.tool_state(), 1});
    publish();
  }

  Vec3 force_N() const { return to_vec3(loop.tool_state().force_world_N); }
  Vec3 grip_m() const {
    const messages::ToolState& tool = loop.tool_state();
    return simulation.body_pose(tool.grabbed_body) * to_vec3(tool.body_point_rest_m);
  }

  simulation::Simulation simulation;
  haptics::HapticLoop loop;

 private:
  void publish() {
    auto model = std::make_unique<messages::LocalModel>();
    simulation.write_local_model(loop.tool_state(), *model);
    waiting_.push_back(std::move(model));
    if (static_cast<int>(waiting_.size()) <= late_) return;
    messages::LocalModel& out = loop.models().back();
    out = *waiting_.front();
    out.sequence = ++sequence_;
    out.published_at_ns = now_ns_;
    out.dt_ns = kStep_ns;
    loop.models().publish();
    waiting_.erase(waiting_.begin());
  }

  int late_;
  std::vector<std::unique_ptr<messages::LocalModel>> waiting_;
  std::uint64_t now_ns_ = 0;
  std::uint64_t sequence_ = 0;
};

void hold(HeldDevice& device, Limb& limb, double seconds) {
  device.holds = true;
  for (int i = 0; i < seconds / kTick_s; ++i) limb.tick();
}

void open_gate(Limb& limb) {
  for (int i = 0; i < 300; ++i) limb.tick();
}

/// Moves the held device by amplitude * sin(2 pi f t) along `along` and calls after(t) behind every tick.
template <class After>
void swing(HeldDevice& device, Limb& limb, const Vec3& amplitude_m, double frequency_hz, double seconds,
           After&& after) {
  const Vec3 middle_m = device.position_m;
  for (int i = 1; i <= std::lround(seconds / kTick_s); ++i) {
    const double t_s = i * kTick_s;
    device.position_m = middle_m + amplitude_m * std::sin(2.0 * std::numbers::pi * frequency_hz * t_s);
    limb.tick();
    after(t_s);
  }
}

//   axis o-------------o paw      F moment arm = torque, F across the moment arm
//                      hand
TEST(BoneGrab, AHandThatHoldsThePawFeelsTheJointsTorqueOverTheMomentArm) {
  anatomy::Specimen specimen = testing::antagonist_hinge();
  testing::BarShape coarse;
  coarse.cells = {4, 1, 1};
  specimen.muscles[0] = testing::bar_muscle("flexor", coarse);
  coarse.origin_m.z() *= -1.0;
  specimen.muscles[1] = testing::bar_muscle("extensor", coarse);
  for (const double scale : {1.0, 0.1}) {
    HeldDevice device(kPaw_m);
    Limb limb(specimen, device, quick_to_ramp(scale));
    open_gate(limb);
    hold(device, limb, 0.3);
    limb.simulation.set_excitation(0, 0.4);
    hold(device, limb, 2.0);
    const simulation::JointReadout joint = limb.simulation.joint(0);
    const Vec3 arm_m(limb.grip_m().x(), 0.0, limb.grip_m().z());  // the axis is y through the origin
    const double wanted_N = scale * (joint.net_torque_Nm - joint.passive_Nm_rad * joint.angle_rad) / arm_m.norm();
    const Vec3 across = Vec3(-arm_m.z(), 0.0, arm_m.x()).normalized();
    ASSERT_GT(wanted_N, 0.2 * scale);
    EXPECT_NEAR(limb.force_N().dot(across), wanted_N, 0.02 * wanted_N) << scale;
    EXPECT_LT((limb.force_N() - limb.force_N().dot(across) * across).norm(), 0.02 * wanted_N) << scale;
    std::printf("scale %g: hand %.4f N, torque over moment arm %.4f N\n", scale, limb.force_N().dot(across), wanted_N);
  }
}

TEST(BoneGrab, TheFeltStiffnessIsThatOfJointAndGripInSeries) {
  HeldDevice device(kPaw_m);
  Limb limb(rod(), device, quick_to_ramp());
  open_gate(limb);
  hold(device, limb, 0.3);
  const double way_m = 5e-3;
  for (int i = 0; i < 200; ++i) {
    device.position_m.z() += way_m / 200;
    limb.tick();
  }
  hold(device, limb, 1.0);
  const haptics::BoneDragSettings grip;
  const double joint_N_m = 6.0 / (limb.grip_m().x() * limb.grip_m().x() + limb.grip_m().z() * limb.grip_m().z());
  const double series_N_m = grip.stiffness_N_m * joint_N_m / (grip.stiffness_N_m + joint_N_m);
  EXPECT_NEAR(-limb.force_N().z(), series_N_m * way_m, 0.02 * series_N_m * way_m);
}

// The hand turns the limb and brings it back: what it spends is what joint and grip take up.
TEST(BoneGrab, AClosedCycleGivesTheHandNothing) {
  for (const int late : {0, 1}) {
    HeldDevice device(kPaw_m);
    Limb limb(rod(), device, quick_to_ramp(), late);
    open_gate(limb);
    hold(device, limb, 0.3);
    double work_J = 0.0, lost_J = 0.0, most_J = 0.0, turned_rad = 0.0;
    Vec3 last_m = device.position_m, last_N = limb.force_N();
    std::uint32_t faults = 0;
    swing(device, limb, Vec3(0.0, 0.0, 0.01), 1.0, 4.0, [&](double t_s) {
      if (t_s > 1.0) {  // from the second cycle on
        const double rate = limb.simulation.joint(0).velocity_rad_s;
        // The mean of both forces: what a held one gives away, k T / 2 v^2, is the device's to take up (Colgate and
        // Schenkel 1997).
        work_J -= 0.5 * (last_N + limb.force_N()).dot(device.position_m - last_m);
        lost_J += kTick_s * kRodDamping_Nms_rad * rate * rate;
        most_J = std::max(most_J, work_J);
        turned_rad = std::max(turned_rad, limb.simulation.joint(0).angle_rad);
      }
      faults |= limb.loop.tool_state().faults;
      last_m = device.position_m;
      last_N = limb.force_N();
    });
    std::printf("late %d: hand spends %.3f mJ in 3 cycles, joint takes up %.3f mJ, on loan up to %.3f mJ\n", late,
                1e3 * work_J, 1e3 * lost_J, 1e3 * most_J);
    EXPECT_GT(turned_rad, 0.03);
    EXPECT_EQ(faults & haptics::bit(haptics::Fault::EnergyInjected), 0u);  // without the gate's help
    EXPECT_GE(work_J, lost_J);                                             // nothing is given away
    // The energy on loan is 8 mJ a cycle: what the grip's damper takes up is below 5 % of it.
    EXPECT_NEAR(work_J, lost_J, 0.05 * 3 * 8e-3);
  }
}

TEST(BoneGrab, AFreeLimbDoesNotFeelAsIfInOil) {
  for (const int late : {0, 1}) {
    HeldDevice device(kPaw_m);
    Limb limb(rod(1.0, 0.0), device, quick_to_ramp(), late);
    open_gate(limb);
    hold(device, limb, 0.3);
    const double frequency_hz = 2.0, w = 2.0 * std::numbers::pi * frequency_hz;
    const double amplitude_m = 0.005;     // small, or the arc that the paw runs would add its own stiffness
    double along_v = 0.0, along_x = 0.0;  // force's part in phase with speed and place
    swing(device, limb, Vec3(0.0, 0.0, amplitude_m), frequency_hz, 4.0, [&](double t_s) {
      if (t_s <= 2.0) return;
      along_v -= limb.force_N().z() * std::cos(w * t_s) * kTick_s;
      along_x -= limb.force_N().z() * std::sin(w * t_s) * kTick_s;
    });
    const double damping_Ns_m = along_v / (amplitude_m * w), inertia_kg = -along_x / (amplitude_m * w * w);
    const double arm_m2 = 0.2 * 0.2;
    std::printf("late %d: felt damping %.2f N s/m (joint %.2f), inertia %.4f kg (rod %.4f)\n", late, damping_Ns_m,
                kRodDamping_Nms_rad / arm_m2, inertia_kg, 0.2 / 3.0);
    EXPECT_NEAR(damping_Ns_m, kRodDamping_Nms_rad / arm_m2, 1.0);  // a point played 10 ms late would add 8
    EXPECT_NEAR(inertia_kg, 0.2 / 3.0, 0.05 * 0.2 / 3.0);          // m L^2 / 3 at the end of a thin rod
  }
}

TEST(BoneGrab, GrabAndReleaseNeverJump) {
  HeldDevice device(kPaw_m);
  Limb limb(rod(), device, quick_to_ramp());
  open_gate(limb);
  const double steepest_N = haptics::GateSettings{}.slew_N_s * kTick_s;
  double worst_N = 0.0, most_N = 0.0;
  Vec3 last_N = limb.force_N();
  swing(device, limb, Vec3(0.0, 0.0, 0.015), 0.7, 10.0, [&](double t_s) {
    device.holds = std::fmod(t_s, 1.1) < 0.6;  // at ever other places and speeds
    worst_N = std::max(worst_N, (limb.force_N() - last_N).norm());
    most_N = std::max(most_N, limb.force_N().norm());
    last_N = limb.force_N();
  });
  std::printf("largest change in a tick %.3f N of %.2f N\n", worst_N, most_N);
  EXPECT_GT(most_N, 1.0);
  EXPECT_LT(worst_N, steepest_N);
}

TEST(BoneGrab, LetGoTheLimbIsFree) {
  HeldDevice device(kPaw_m);
  Limb limb(rod(), device, quick_to_ramp());
  open_gate(limb);
  hold(device, limb, 0.3);
  device.position_m.z() += 0.01;
  hold(device, limb, 0.3);
  device.holds = false;
  for (int i = 0; i < 1000; ++i) limb.tick();
  EXPECT_EQ(limb.loop.tool_state().grabbed_body, -1);
  EXPECT_EQ(limb.force_N().norm(), 0.0);
  EXPECT_NEAR(limb.simulation.joint(0).angle_rad, 0.0, 2e-3);
}

// The hand also goes 3 mm into the bone: the grip alone is felt, not the contact on top of it.
TEST(BoneGrab, ABoneThatNothingTurnsIsAWall) {
  HeldDevice device(Vec3(-0.1, 0.0, 0.012));
  Limb limb(rod(), device, quick_to_ramp());
  open_gate(limb);
  hold(device, limb, 0.3);
  ASSERT_EQ(limb.loop.tool_state().grabbed_body, 0);
  const Vec3 way_m(1e-3, -2e-3, -4e-3);
  device.position_m += way_m;
  hold(device, limb, 0.5);
  EXPECT_LT((limb.force_N() + haptics::BoneDragSettings{}.stiffness_N_m * way_m).norm(), 1e-6);
  EXPECT_EQ(limb.loop.tool_state().contact.surface, -1);
}

TEST(BoneGrab, TheMouseTakesABoneAndDragsIt) {
  device::MouseDevice mouse(kPaw_m);
  Limb limb(rod(), mouse, quick_to_ramp());
  open_gate(limb);
  mouse.set_pointer(kPaw_m, messages::kGrabBoneButton);
  for (int i = 0; i < 200; ++i) limb.tick();
  ASSERT_EQ(limb.loop.tool_state().grabbed_body, 1);
  mouse.set_pointer(kPaw_m + Vec3(0.0, 0.0, 0.01), messages::kGrabBoneButton);  // a jump, as a window makes it
  for (int i = 0; i < 1000; ++i) limb.tick();
  // Nothing moves the pointer back: joint and grip in series take up the whole way.
  const double joint_N_m = 6.0 / (0.2 * 0.2), grip_N_m = haptics::BoneDragSettings{}.stiffness_N_m;
  EXPECT_NEAR(limb.grip_m().z(), 0.01 * grip_N_m / (grip_N_m + joint_N_m), 1e-4);
  const Vec3 shown_N = to_vec3(mouse.shown_force_world_N());
  EXPECT_NEAR(shown_N.z(), -joint_N_m * limb.grip_m().z(), 0.02);
}

/// Force above 20 Hz, root of the mean square over the second half of 10 s in which a hand shakes the paw.
double jitter_N(double times, bool has_hand, int late) {
  device::DeviceProfile profile;
  device::HandProfile hand;
  if (!has_hand) hand = {0.0, 0.0, 0.0};
  device::SimulatedDevice device("simulated", kPaw_m, profile, hand);
  haptics::HapticSettings settings = quick_to_ramp();
  settings.bone.stiffness_N_m = profile.max_stiffness_N_m;
  Limb limb(rod(times), device, settings, late);
  open_gate(limb);
  double slow_N = 0.0, sum_N2 = 0.0;
  for (int i = 0; i < 10'000; ++i) {
    const double t_s = i * kTick_s;
    const Vec3 target_m = kPaw_m + Vec3(0.0, 0.0, 0.015 * std::sin(2.0 * std::numbers::pi * t_s));
    device.set_hand_target({to_array(target_m), {}, messages::kGrabBoneButton});
    if (!has_hand && i == 300) limb.simulation.set_joint_torque(0, 0.3);  // something that moves it
    limb.tick();
    const double force_N = limb.force_N().z();
    slow_N += (1.0 - std::exp(-2.0 * std::numbers::pi * 20.0 * kTick_s)) * (force_N - slow_N);
    if (i >= 5000) sum_N2 += (force_N - slow_N) * (force_N - slow_N) / 5000.0;
  }
  return std::sqrt(sum_N2);
}

// A limit cycle of this loop swings between the force limits and reads 1 N and more. Calm, the jitter is the device's
// own Coulomb friction, 0.1 N, changing its sign.
TEST(BoneGrab, AStiffGripOnLightAndHeavyLimbsIsStable) {
  for (const bool has_hand : {true, false}) {
    for (const int late : {0, 1}) {
      for (const double times : {0.1, 1.0, 10.0}) {
        const double jitter = jitter_N(times, has_hand, late);
        std::printf("hand %d, late %d, inertia x %g: %.1f mN\n", has_hand, late, times, 1e3 * jitter);
        EXPECT_LT(jitter, 0.2) << has_hand << late << times;
      }
    }
  }
}

}  // namespace
}  // namespace myotact::scene

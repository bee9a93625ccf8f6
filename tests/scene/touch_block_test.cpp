// A flat block of simulated muscle under the tool: loop and finite-element step, coupled as a session couples them.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "anatomy/specimen.h"
#include "core/at.h"
#include "haptics/haptic_loop.h"
#include "simulation/simulation.h"
#include "support/synthetic_specimen.h"

namespace myotact::scene {
namespace {

constexpr std::uint64_t kTick_ns = 1'000'000, kStep_ns = 10 * kTick_ns;

/// A stylus that is where the test puts it, and remembers the force.
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
    messages::DeviceState state;
    state.sampled_at_ns = now_ns;
    state.stylus_position_world_m = to_array(position_m);
    return state;
  }
  void write(const messages::DeviceCommand&) noexcept override {}

  Vec3 position_m;

 private:
  std::string name_ = "held";
  device::DeviceProfile profile_;
};

/// A flat block of muscle held at both ends, and a tool on its top.
class Block {
 public:
  explicit Block(const haptics::HapticSettings& settings)
      : simulation(specimen, {}), device(top_m() + Vec3(0.0, 0.0, 0.01)), loop(device, settings) {
    simulation.set_joint_locked(0, true);
    const double q = 0.0;
    simulation.settle({&q, 1}, {});
    loop.prepare(now_ns_ = kTick_ns);
    publish();
  }

  static testing::BarShape shape() {
    testing::BarShape shape;
    shape.width_m = 0.06;
    shape.cells = {6, 3, 3};
    return shape;
  }
  Vec3 top_m() const { return shape().origin_m + Vec3(0.5 * shape().length_m, 0.0, 0.5 * shape().width_m); }

  /// Moves the tool's centre there at 1 kHz over the given time, straight.
  void move(const Vec3& to_m, double duration_s) {
    const Vec3 from_m = device.position_m;
    const int ticks = std::max(1, static_cast<int>(std::lround(duration_s * 1e3)));
    for (int i = 1; i <= ticks; ++i) {
      device.position_m = from_m + (to_m - from_m) * i / ticks;
      tick();
    }
  }

  void tick() {
    now_ns_ += kTick_ns;
    loop.tick(now_ns_);
    if (now_ns_ % kStep_ns != 0) return;
    simulation.step({&loop.tool_state(), 1});
    publish();
  }

  Vec3 force_N() const { return to_vec3(loop.tool_state().force_world_N); }
  Vec3 normal() const { return to_vec3(loop.tool_state().contact.normal_world); }

  /// Height of the deformed top over a place.
  double surface_height_m(double x, double y) const {
    const auto skin_m = simulation.skin_world_m(0);
    double height = -1.0;
    for (const auto& t : specimen.muscles[0].skin.triangles) {
      const Vec3 a = skin_m[at(t[0])], b = skin_m[at(t[1])], c = skin_m[at(t[2])];
      const double area = cross2(b - a, c - a);
      if (area <= 0.0) continue;  // faces down or sideways
      const Vec3 p(x, y, 0.0);
      const double wb = cross2(p - a, c - a) / area, wc = cross2(b - a, p - a) / area;
      if (wb < 0.0 || wc < 0.0 || wb + wc > 1.0) continue;
      height = std::max(height, a.z() + wb * (b.z() - a.z()) + wc * (c.z() - a.z()));
    }
    return height;
  }

  /// Height at which the centre of a sphere rests on the deformed top over a place: a dent's slopes hold it above the
  /// dent's bottom.
  double resting_height_m(double x, double y, double radius_m) const {
    constexpr int kSteps = 24;  // half way across: 0.1 mm, then twice 1/8 of it, at which the height is 0.1 um too low
    double height = -1.0, step_m = radius_m / kSteps, middle_dx = 0.0, middle_dy = 0.0;
    for (int level = 0; level < 3; ++level, step_m /= 8.0) {
      const double from_dx = middle_dx, from_dy = middle_dy;
      for (int i = -kSteps; i <= kSteps; ++i) {
        for (int k = -kSteps; k <= kSteps; ++k) {
          const double dx = from_dx + step_m * i, dy = from_dy + step_m * k;
          const double above = radius_m * radius_m - dx * dx - dy * dy;
          const double here = above < 0.0 ? -1.0 : surface_height_m(x + dx, y + dy) + std::sqrt(above);
          if (here <= height) continue;
          height = here;
          middle_dx = dx;
          middle_dy = dy;
        }
      }
    }
    return height;
  }

  anatomy::Specimen specimen = testing::single_muscle(shape());
  simulation::Simulation simulation;
  HeldDevice device;
  haptics::HapticLoop loop;
  messages::LocalContact told;  // by the simulation, of its last step

 private:
  static double cross2(const Vec3& a, const Vec3& b) { return a.x() * b.y() - a.y() * b.x(); }

  void publish() {
    messages::LocalModel& model = loop.models().back();
    simulation.write_local_model(loop.tool_state(), model);
    model.sequence = ++sequence_;
    model.published_at_ns = now_ns_;
    model.dt_ns = kStep_ns;
    told = model.contact;
    loop.models().publish();
  }

  std::uint64_t now_ns_ = 0;
  std::uint64_t sequence_ = 0;
};

haptics::HapticSettings block_settings(double friction) {
  haptics::HapticSettings settings;
  settings.contact.radius_m = 3e-3;
  settings.contact.stiffness_N_m = 800.0;
  settings.contact.static_friction = settings.contact.dynamic_friction = friction;
  settings.gate.ramp_s = 0.1;
  settings.gate.force_limit = 1.0;
  return settings;
}

// The coupling is as stiff as it was told to the simulation, and what the simulation itself presses with is what the
// hand feels: the stiffness felt is the tissue's own, dent by force, though the device supports no more than 800 N/m.
TEST(TouchTissue, PressingABlockGivesStiffnessTimesDepthBelowItsDentedTop) {
  Block block(block_settings(0.3));
  const double r = 3e-3;
  block.move(block.top_m() + Vec3(0, 0, r + 1e-3), 0.2);
  for (const double depth_m : {1e-3, 2e-3, 4e-3}) {
    block.move(block.top_m() + Vec3(0, 0, r - depth_m), 0.2);
    block.move(block.device.position_m, 1.0);  // until the tissue rests
    const Vec3 tool_m = block.device.position_m;
    const double under_m = block.resting_height_m(tool_m.x(), tool_m.y(), r) - tool_m.z();
    const double dent_m = block.top_m().z() - block.surface_height_m(tool_m.x(), tool_m.y());
    std::printf("depth %.1f mm: dent %.2f mm, below the top %.2f mm, force %.3f N\n", 1e3 * depth_m, 1e3 * dent_m,
                1e3 * under_m, block.force_N().z());
    const double coupling_N_m = block.loop.tool_state().contact.stiffness_N_m;
    EXPECT_GE(coupling_N_m, 800.0);
    EXPECT_NEAR(block.force_N().z(), coupling_N_m * under_m, 0.03 * coupling_N_m * under_m) << depth_m;
    const Vec3 tissue_N = to_vec3(block.told.force_world_N);
    EXPECT_LT((block.force_N() + tissue_N).norm(), 0.01 * tissue_N.norm()) << depth_m;
    const double felt_N_m = block.force_N().z() / depth_m, own_N_m = -tissue_N.z() / dent_m;
    EXPECT_NEAR(felt_N_m, own_N_m, 0.05 * own_N_m) << depth_m;
    EXPECT_GT(dent_m, 0.2 * depth_m) << "the block must give way";
  }
}

TEST(TouchTissue, SlidingOverABlockRecoversTheFriction) {
  for (const double friction : {0.15, 0.3, 0.6}) {
    Block block(block_settings(friction));
    const Vec3 start = block.top_m() + Vec3(-0.02, 0.0, 0.0);
    block.move(start + Vec3(0, 0, 4e-3), 0.2);
    block.move(start, 0.2);                      // pressed in by a radius of 3 mm
    block.move(start + Vec3(0.01, 0, 0), 0.25);  // slides by now
    double tangential_N = 0.0, normal_N = 0.0;
    const Vec3 from = block.device.position_m;
    for (int i = 1; i <= 500; ++i) {
      block.device.position_m = from + Vec3(0.04e-3 * i, 0, 0);  // 40 mm/s
      block.tick();
      const double along = block.force_N().dot(block.normal());
      normal_N += along;
      tangential_N += (block.force_N() - along * block.normal()).norm();
    }
    std::printf("friction %.2f: measured %.4f at %.2f N\n", friction, tangential_N / normal_N, normal_N / 500.0);
    EXPECT_NEAR(tangential_N / normal_N, friction, 0.05 * friction);
  }
}

}  // namespace
}  // namespace myotact::scene

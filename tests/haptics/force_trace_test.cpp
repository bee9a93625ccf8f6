// The same touch gives the same forces, whichever compiler built the program: within 1 uN of
// tests/replay/touch_trace.csv. A change that means to change forces writes the file anew: MYOTACT_WRITE_TRACE=1
// haptics_test --gtest_filter=ForceTrace*

#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/file.h"
#include "core/number_list.h"
#include "core/text.h"
#include "device/replay_device.h"
#include "haptics/haptic_loop.h"
#include "haptics/surfaces.h"
#include "support/source_folder.h"

namespace myotact::haptics {
namespace {

const std::string kTrace = source_folder() + "/tests/replay/touch_trace.csv";
constexpr std::uint64_t kStep_ns = 10'000'000;
constexpr int kTicks = 2500;
constexpr int kEvery = 25;  // ticks of a row

/// A hand that comes down on the ball, strokes it in a figure of eight and leaves. Polynomials alone: no library's
/// sine.
std::vector<messages::DeviceState> stroke() {
  std::vector<messages::DeviceState> states(kTicks);
  Vec3 last_m(0.0, 0.0, 0.04);
  for (int tick = 0; tick < kTicks; ++tick) {
    const double t = 1e-3 * tick;
    const auto wave = [](double phase) {  // from -1 to 1 and back in a period of 1, smooth
      const double s = 2.0 * std::abs(phase - std::floor(phase + 0.5));
      return 2.0 * s * s * (3.0 - 2.0 * s) - 1.0;
    };
    const double press_m = t < 0.3 ? 0.04 - 0.06 * t : (t < 2.2 ? 0.022 : 0.022 + 0.06 * (t - 2.2));
    const Vec3 position_m(8e-3 * (1.0 + wave(0.7 * t)), 6e-3 * (1.0 + wave(1.4 * t)), press_m);
    messages::DeviceState& state = states[static_cast<std::size_t>(tick)];
    state.stylus_position_world_m = to_array(position_m);
    state.stylus_velocity_world_m_s = to_array((position_m - last_m) * 1e3);
    state.sampled_at_ns = static_cast<std::uint64_t>(tick + 1) * kTickPeriod_ns;
    last_m = position_m;
  }
  return states;
}

/// The ball swells by 0.1 mm a step and shrinks again.
std::vector<Vec3> swollen(const geometry::TriangleMesh& ball, int step) {
  std::vector<Vec3> vertices_m = ball.positions_m;
  const int phase = step % 20;
  const double swelling_m = 1e-4 * (phase < 10 ? phase : 20 - phase);
  for (Vec3& v : vertices_m) v *= 1.0 + swelling_m / 0.025;
  return vertices_m;
}

std::vector<Vec3> felt_forces_N() {
  const geometry::TriangleMesh ball = geometry::make_ball(0.025, 3);
  device::ReplayDevice device(stroke(), {});
  HapticSettings settings;
  settings.contact.static_friction = 0.4;
  auto loop = std::make_unique<HapticLoop>(device, settings);
  loop->prepare(kTickPeriod_ns);
  std::vector<Vec3> forces_N;
  for (int tick = 0; tick < kTicks; ++tick) {
    const std::uint64_t now_ns = static_cast<std::uint64_t>(tick + 1) * kTickPeriod_ns;
    if (tick % 10 == 0) {
      messages::LocalModel& model = loop->models().back();
      model = {};
      const int step = tick / 10;
      write_patch(ball, swollen(ball, step), swollen(ball, step + 1),
                  to_vec3(loop->tool_state().proxy_position_world_m), model);
      model.sequence = static_cast<std::uint64_t>(step + 1);
      model.published_at_ns = now_ns;
      model.dt_ns = kStep_ns;
      loop->models().publish();
    }
    loop->tick(now_ns);
    if (tick % kEvery == 0) forces_N.push_back(to_vec3(loop->tool_state().force_world_N));
  }
  return forces_N;
}

std::string trace_text(const std::vector<Vec3>& forces_N) {
  std::string text = "force_x_N,force_y_N,force_z_N\n";
  for (const Vec3& force : forces_N) {
    text += to_text(force.x()) + "," + to_text(force.y()) + "," + to_text(force.z()) + "\n";
  }
  return text;
}

TEST(ForceTrace, IsThatOfEveryOtherBuild) {
  const std::vector<Vec3> forces_N = felt_forces_N();
  if (std::getenv("MYOTACT_WRITE_TRACE") != nullptr) write_file(kTrace, trace_text(forces_N));
  const std::string text = read_file(kTrace);
  std::size_t row = 0;
  double largest_N = 0.0;
  for (std::size_t at = text.find('\n') + 1; at < text.size(); at = text.find('\n', at) + 1, ++row) {
    ASSERT_LT(row, forces_N.size());
    const std::vector<double> expected = parse_number_list(kTrace, text.substr(at, text.find('\n', at) - at));
    ASSERT_EQ(expected.size(), 3u);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(forces_N[row][k], expected[static_cast<std::size_t>(k)], 1e-6) << row;
    largest_N = std::max(largest_N, forces_N[row].norm());
  }
  EXPECT_EQ(row, forces_N.size());
  EXPECT_GT(largest_N, 0.3);  // something was felt
}

}  // namespace
}  // namespace myotact::haptics

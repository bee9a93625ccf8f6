#include "measure/fidelity/two_hand_goals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "device/simulated_device.h"
#include "geometry/plain_surfaces.h"
#include "haptics/haptic_group.h"
#include "haptics/haptic_thread.h"
#include "measure/fidelity/shapes.h"
#include "realtime/period_histogram.h"
#include "realtime/periodic_loop.h"
#include "simulation/touch/local_patch.h"

namespace myotact::measure {

namespace {

constexpr std::uint64_t kTick_ns = haptics::kTickPeriod_ns, kStep_ns = 10 * kTick_ns;
constexpr double kBall_m = 0.025;
constexpr int kBallLevels = 4;    // 5120 triangles
constexpr double kDeep_m = 3e-3;  // of the hands' targets below the skin: some 1 N at 300 N/m
constexpr Swelling kBreathing{2e-3, 0.02, 0.0, 0.5e-3};

haptics::HapticSettings settings() {
  haptics::HapticSettings settings;
  settings.contact.static_friction = settings.contact.dynamic_friction = 0.4;
  settings.gate.ramp_s = 0.1;
  return settings;
}

/// A hand that goes to and fro on one side of the ball.
struct BallHand {
  BallHand(double side, double stroke_hz)
      : side_(side),
        stroke_hz_(stroke_hz),
        device("simulated", Vec3(1.5 * side * kBall_m, 0, 0)),
        loop(device, settings()) {}

  void aim(double time_s) {
    const double turn_rad = 0.5 * std::sin(6.283185307 * stroke_hz_ * time_s);
    const double reach_m = kBall_m - kDeep_m;
    const Vec3 target_m(side_ * reach_m * std::cos(turn_rad), reach_m * std::sin(turn_rad), 0.0);
    device.set_hand_target({to_array(target_m), {}, buttons});
  }

  double side_, stroke_hz_;
  device::SimulatedDevice device;
  haptics::HapticLoop loop;
  std::uint32_t buttons = 0;
  realtime::PeriodHistogram durations;
  std::vector<std::array<double, 3>> forces_N;  // of every tick, on the virtual clock
};

std::unique_ptr<BallHand> first_hand() {
  return std::make_unique<BallHand>(1.0, 1.0);
}
std::unique_ptr<BallHand> second_hand() {
  return std::make_unique<BallHand>(-1.0, 1.3);
}

/// The ball as a simulation of 100 Hz shows it to each hand.
class BreathingBall {
 public:
  BreathingBall() : mesh_(geometry::make_ball(kBall_m, kBallLevels)), patch_(patch_of(mesh_)) {
    previous_m_ = current_m_ = mesh_.positions_m;
    swell(mesh_, kBreathing, 0.0, current_m_);
  }

  /// The step that ends at `now_ns`.
  void step(std::uint64_t now_ns) {
    std::swap(previous_m_, current_m_);
    swell(mesh_, kBreathing, 1e-9 * static_cast<double>(kStep_ns * ++steps_), current_m_);
    patch_.update_surface(0, previous_m_, current_m_);
    now_ns_ = now_ns;
  }
  void show(haptics::HapticLoop& loop, const messages::ToolState& tool) const {
    messages::LocalModel& model = loop.models().back();
    patch_.write(to_vec3(tool.proxy_position_world_m), model);
    model.sequence = steps_;
    model.published_at_ns = now_ns_;
    model.dt_ns = kStep_ns;
    model.tool_sequence = tool.sequence;
    loop.models().publish();
  }

 private:
  static simulation::LocalPatch patch_of(const geometry::TriangleMesh& mesh) {
    const std::array<const geometry::TriangleMesh*, 1> surfaces = {&mesh};
    return simulation::LocalPatch(surfaces);
  }

  geometry::TriangleMesh mesh_;
  simulation::LocalPatch patch_;
  std::vector<Vec3> previous_m_, current_m_;
  std::uint64_t steps_ = 0, now_ns_ = 0;
};

/// All hands on the ball, on a virtual clock.
class VirtualRun {
 public:
  explicit VirtualRun(std::span<BallHand* const> hands) : hands_(hands.begin(), hands.end()) {
    for (BallHand* hand : hands_) {
      loops_.push_back(&hand->loop);
      hand->loop.prepare(now_ns_);
    }
    show();
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) tick();
  }

 private:
  void show() {
    ball_.step(now_ns_);
    for (BallHand* hand : hands_) ball_.show(hand->loop, hand->loop.tool_state());
  }
  void tick() {
    now_ns_ += kTick_ns;
    for (BallHand* hand : hands_) {
      hand->aim(1e-9 * static_cast<double>(now_ns_));
      const std::uint64_t begin_ns = realtime::steady_now_ns();
      hand->loop.tick(now_ns_);
      haptics::share_stop(hand->loop, loops_);
      hand->durations.add(realtime::steady_now_ns() - begin_ns);
      hand->forces_N.push_back(hand->loop.tool_state().force_world_N);
    }
    if (now_ns_ % kStep_ns == 0) show();
  }

  BreathingBall ball_;
  std::vector<BallHand*> hands_;
  std::vector<haptics::HapticLoop*> loops_;
  std::uint64_t now_ns_ = kStep_ns;
};

double different_ticks(const BallHand& a, const BallHand& b) {
  double count = a.forces_N.size() == b.forces_N.size() ? 0.0 : 1.0;
  for (std::size_t i = 0; i < std::min(a.forces_N.size(), b.forces_N.size()); ++i) {
    count += a.forces_N[i] == b.forces_N[i] ? 0.0 : 1.0;
  }
  return count;
}

double mean_force_N(const BallHand& hand) {
  double sum_N = 0.0;
  for (const auto& force_N : hand.forces_N) sum_N += to_vec3(force_N).norm();
  return sum_N / static_cast<double>(hand.forces_N.size());
}

double p99_us(const realtime::PeriodHistogram& durations) {
  return 1e-3 * static_cast<double>(durations.summary().p99_ns);
}

/// Ticks from the stop button of one device to zero force on all of them, the worst of both.
double ticks_to_stop() {
  double worst = 0.0;
  for (const std::size_t pressed : {0u, 1u}) {
    const auto a = first_hand(), b = second_hand();
    const std::array<BallHand*, 2> hands = {a.get(), b.get()};
    VirtualRun run(hands);
    run.run(1000);
    hands[pressed]->buttons = messages::kStopButton;
    constexpr int kLooked = 50;
    run.run(kLooked);
    for (const BallHand* hand : hands) {
      double ticks = 0.0;  // the last one with force
      for (int i = 0; i < kLooked; ++i) {
        const std::size_t at = hand->forces_N.size() - kLooked + static_cast<std::size_t>(i);
        if (to_vec3(hand->forces_N[at]).norm() > 0.0) ticks = i + 1;
      }
      worst = std::max(worst, ticks + 1.0);
    }
  }
  return worst;
}

struct WallRun {
  std::vector<double> tick_p99_us;  // one a hand
  double round_p99_us = 0.0;
};

/// The same on the wall clock in one haptic thread, with the hands at rest on the ball.
WallRun run_thread(std::span<BallHand* const> hands, double seconds) {
  BreathingBall ball;
  std::vector<haptics::HapticLoop*> loops;
  for (BallHand* hand : hands) {
    loops.push_back(&hand->loop);
    hand->aim(0.0);
    hand->loop.prepare(realtime::steady_now_ns());
  }
  haptics::HapticThread thread(loops);
  thread.start();
  realtime::PeriodicLoop beat(kStep_ns);
  beat.start();
  for (int step = 0; step < static_cast<int>(seconds * 1e9 / static_cast<double>(kStep_ns)); ++step) {
    ball.step(beat.wait().now_ns);
    for (haptics::HapticLoop* loop : loops) {
      loop->tool_states().update();
      ball.show(*loop, loop->tool_states().front());
    }
  }
  thread.stop();
  WallRun result;
  for (std::size_t i = 0; i < loops.size(); ++i) result.tick_p99_us.push_back(p99_us(thread.ticks(i)));
  result.round_p99_us = p99_us(thread.ticks());
  return result;
}

}  // namespace

GoalFigures measure_two_hands(Effort effort) {
  const int ticks = effort == Effort::Full ? 60'000 : 3'000;
  const auto a = first_hand(), b = second_hand(), a_alone = first_hand(), b_alone = second_hand();
  VirtualRun(std::array<BallHand*, 1>{a_alone.get()}).run(ticks);
  VirtualRun(std::array<BallHand*, 1>{b_alone.get()}).run(ticks);
  VirtualRun(std::array<BallHand*, 2>{a.get(), b.get()}).run(ticks);
  const double cost =
      std::max(p99_us(a->durations) / p99_us(a_alone->durations), p99_us(b->durations) / p99_us(b_alone->durations));
  const double seconds = effort == Effort::Full ? 30.0 : 1.5;
  const auto c = first_hand(), d = second_hand(), c_alone = first_hand();
  const WallRun one = run_thread(std::array<BallHand*, 1>{c_alone.get()}, seconds);
  const WallRun two = run_thread(std::array<BallHand*, 2>{c.get(), d.get()}, seconds);
  GoalFigures result;
  result.figures = {
      {"ticks whose force differs from that alone", different_ticks(*a, *a_alone) + different_ticks(*b, *b_alone), "",
       0.0},
      {"mean force of the hand that felt less", std::min(mean_force_N(*a), mean_force_N(*b)), "N", 0.3, true},
      {"ticks from a stop button to zero force on both", ticks_to_stop(), "", 2.0},
      {"p99 of a tick beside another over that alone", cost, "", 1.2, false, true},
      {"on the wall clock, p99 of the first hand's tick over that alone", two.tick_p99_us[0] / one.tick_p99_us[0], "",
       1.2, false, true}};
  result.note = fmt::format(
      "one ball of {} triangles that breathes by 2 mm, a hand on each side, 3 mm deep; p99 of a tick {:.1f} us alone, "
      "{:.1f} and {:.1f} us beside each other; in the haptic thread, from its wake, {:.1f} us alone, {:.1f} us and "
      "{:.1f} us more for the second; {:.1f} us a round",
      20 << (2 * kBallLevels), p99_us(a_alone->durations), p99_us(a->durations), p99_us(b->durations),
      one.tick_p99_us[0], two.tick_p99_us[0], two.tick_p99_us[1], two.round_p99_us);
  return result;
}

}  // namespace myotact::measure

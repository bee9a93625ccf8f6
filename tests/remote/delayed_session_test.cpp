#include "remote/delayed_session.h"

#include <vector>

#include <gtest/gtest.h>

#include "scene/lockstep_session.h"
#include "scene/samples.h"

// A link that is not there, against no link, and against what TCP does to a stream.

namespace myotact::remote {
namespace {

constexpr std::uint64_t kMs = 1'000'000;

TEST(DelayedSession, WithoutDelayIsTheLockstepSessionToTheBit) {
  for (const char* name : {"spring", "particle"}) {
    const scene::Scene scene = scene::load_scene(name);
    simulation::Simulation here(scene.specimen, scene.settings), there(scene.specimen, scene.settings);
    scene::SampleTable samples(scene.specimen, scene::hands_of(scene), 1);
    scene::LockstepSession session(scene, here, samples, nullptr);
    DelayedSession delayed(scene, there, {});
    bool felt = false;
    for (int step = 0; step < 300; ++step) {
      session.step();
      for (int i = 0; i < 10; ++i) {
        const auto hand = delayed.conductor().hand(0, delayed.time_s());
        delayed.tick({to_array(hand.position_world_m), {}, hand.buttons, {}});
      }
      EXPECT_EQ(delayed.loop().tool_state().force_world_N, session.tool().force_world_N) << name << " " << step;
      felt = felt || to_vec3(session.tool().force_world_N).norm() > 0.5;
    }
    EXPECT_TRUE(felt) << name;
  }
}

TEST(DelayLine, KeepsTheOrderAndTellsTheNewestThatHasArrived) {
  net::DelayLine<int> line({0.005, 0.0, 0.0, 0.1, 1});
  line.send(0, 1);
  line.send(1 * kMs, 2);
  line.send(2 * kMs, 3);
  EXPECT_EQ(line.receive(4 * kMs), nullptr);
  ASSERT_NE(line.receive(5 * kMs), nullptr);
  const int* both = line.receive(7 * kMs);
  ASSERT_NE(both, nullptr);
  EXPECT_EQ(*both, 3);
  EXPECT_EQ(line.receive(100 * kMs), nullptr);
}

/// Of uniform jitter J on messages every tick in order, each arrives at the latest of all before it.
TEST(DelayLine, JitterBunchesAndNeverReorders) {
  net::DelayLine<int> line({0.010, 0.020, 0.0, 0.1, 7});
  int last = -1, gaps = 0;
  for (int t = 0; t < 5000; ++t) {
    line.send(static_cast<std::uint64_t>(t) * kMs, t);
    if (const int* newest = line.receive(static_cast<std::uint64_t>(t) * kMs)) {
      EXPECT_GT(*newest, last);
      EXPECT_GE(t - *newest, 10);
      EXPECT_LE(t - *newest, 31);
      last = *newest;
    } else {
      ++gaps;
    }
  }
  EXPECT_GT(last, 4900);
  EXPECT_GT(gaps, 1000) << "many arrive together";
}

TEST(DelayLine, AStallHoldsUpAllThatFollows) {
  net::DelayLine<int> line({0.0, 0.0, 1.0, 0.1, 3});
  int longest = 0, silent = 0, stalled = 0;
  constexpr int kTicks = 1'000'000;
  for (int t = 0; t < kTicks; ++t) {
    line.send(static_cast<std::uint64_t>(t) * kMs, t);
    const bool came = line.receive(static_cast<std::uint64_t>(t) * kMs) != nullptr;
    silent = came ? 0 : silent + 1;
    longest = std::max(longest, silent);
    stalled += came ? 0 : 1;
  }
  EXPECT_GE(longest, 99);
  EXPECT_LE(longest, 300) << "one right after the other is rare";
  // A pause of 1 s in the mean between stalls of 0.1 s: 1/11 of the time.
  EXPECT_NEAR(static_cast<double>(stalled) / kTicks, 0.1 / 1.1, 0.01);
}

}  // namespace
}  // namespace myotact::remote

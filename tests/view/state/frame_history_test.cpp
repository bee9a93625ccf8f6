// Frames kept and looked at again: what comes back is what was given, in bounded memory.

#include "view/state/frame_history.h"

#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

namespace myotact::view {
namespace {

/// Two muscles whose vertices move on a known curve: 0.3 m across, so that a 16-bit place is 5 um wide.
messages::SceneFrame frame_at(double time_s, std::size_t vertices = 50) {
  messages::SceneFrame frame;
  frame.time_s = time_s;
  frame.sequence = static_cast<std::uint64_t>(std::llround(time_s * 1000.0));
  frame.body_poses.assign(2, {1, 0, 0, time_s, 0, 1, 0, 0, 0, 0, 1, 0});
  for (std::size_t m = 0; m < 2; ++m) {
    auto& skin = frame.skins_world_m.emplace_back();
    for (std::size_t v = 0; v < vertices + m; ++v) {
      const double phase = 0.1 * static_cast<double>(v) + time_s;
      skin.push_back({static_cast<float>(0.15 * std::sin(phase)), static_cast<float>(0.15 * std::cos(1.7 * phase)),
                      static_cast<float>(0.001 * static_cast<double>(m))});
    }
  }
  frame.activations = {0.25 * time_s, 0.5};
  frame.tensions_N = {10.0 * time_s, 3.0};
  frame.joints.resize(1);
  frame.joints[0].angle_rad = std::sin(time_s);
  frame.joints[0].muscles.resize(2);
  frame.tools.resize(1);
  frame.tools[0].force_world_N = {time_s, 0.0, -1.0};
  frame.control.drive = messages::Drive::Balance;
  frame.control.common = 0.001 * time_s;
  frame.notice = "at " + std::to_string(time_s);
  return frame;
}

void expect_same(const messages::SceneFrame& kept, const messages::SceneFrame& given) {
  EXPECT_EQ(kept.time_s, given.time_s);
  EXPECT_EQ(kept.sequence, given.sequence);
  EXPECT_EQ(kept.body_poses, given.body_poses);
  EXPECT_EQ(kept.activations, given.activations);
  EXPECT_EQ(kept.tensions_N, given.tensions_N);
  EXPECT_EQ(kept.joints[0].angle_rad, given.joints[0].angle_rad);
  EXPECT_EQ(kept.tools[0].force_world_N, given.tools[0].force_world_N);
  EXPECT_EQ(kept.control, given.control);
  EXPECT_EQ(kept.notice, given.notice);
  ASSERT_EQ(kept.skins_world_m.size(), given.skins_world_m.size());
  const float half_step_m = 0.5f * 0.3f / 65535.0f;
  for (std::size_t m = 0; m < given.skins_world_m.size(); ++m) {
    ASSERT_EQ(kept.skins_world_m[m].size(), given.skins_world_m[m].size());
    for (std::size_t v = 0; v < given.skins_world_m[m].size(); ++v) {
      for (std::size_t a = 0; a < 3; ++a) {
        // Half a step, and the rounding of floats of 0.15 m (2^-26 m).
        EXPECT_NEAR(kept.skins_world_m[m][v][a], given.skins_world_m[m][v][a], half_step_m + 3e-8f);
      }
    }
  }
}

TEST(FrameHistory, GivesBackWhatItWasGiven) {
  FrameHistory history;
  EXPECT_FALSE(history.nearest(1.0));
  for (int i = 0; i < 100; ++i) history.add(frame_at(0.02 * i));
  ASSERT_EQ(history.size(), 100u);
  messages::SceneFrame frame;
  for (const int i : {0, 1, 57, 99}) {
    history.fetch(history.nearest(0.02 * i + 0.004).value(), frame);
    expect_same(frame, frame_at(0.02 * i));
  }
  EXPECT_EQ(history.nearest(-5.0), 0u);
  EXPECT_EQ(history.nearest(50.0), 99u);
  EXPECT_EQ(history.nearest(0.02 * 10 + 0.011), 11u);
}

TEST(FrameHistory, AStandingClockKeepsOneFrameAndAnEarlierOneBeginsAnew) {
  FrameHistory history;
  for (int i = 0; i < 5; ++i) history.add(frame_at(2.0));
  EXPECT_EQ(history.size(), 1u);
  history.add(frame_at(2.1));
  EXPECT_EQ(history.size(), 2u);
  history.add(frame_at(0.0));
  EXPECT_EQ(history.size(), 1u);
  EXPECT_EQ(history.time_s(0), 0.0);
  history.add({});  // nothing simulated yet
  EXPECT_EQ(history.size(), 1u);
}

TEST(FrameHistory, MemoryIsBoundedTheLastSecondsStayDenseAndTheFirstFrameStays) {
  FrameHistory one;
  one.add(frame_at(0.0));
  const std::size_t room = 300 * one.bytes();
  FrameHistory history(room);
  constexpr int kFrames = 6000;
  for (int i = 0; i < kFrames; ++i) {
    history.add(frame_at(0.02 * i));
    ASSERT_LE(history.bytes(), room);
  }
  const double end_s = 0.02 * (kFrames - 1);
  EXPECT_GT(history.size(), 280u);
  EXPECT_EQ(history.time_s(0), 0.0);
  EXPECT_EQ(history.time_s(history.size() - 1), end_s);
  // With n frames over an age T at intervals of h, gaps that grow with age a as g = c a fill n = (1 + ln(c T / h)) / c;
  // of n = 300, T = 120 s and h = 0.02 s that makes c = 0.0157: each gap may be twice that, and no less than one frame.
  for (std::size_t i = 0; i + 1 < history.size(); ++i) {
    const double age_s = end_s - history.time_s(i), gap_s = history.time_s(i + 1) - history.time_s(i);
    EXPECT_LE(gap_s, std::max(2.0 * 0.0157 * age_s, 0.0201)) << age_s;
  }
}

TEST(FrameHistory, SkinsWithoutThicknessOrVerticesComeBack) {
  FrameHistory history;
  messages::SceneFrame given = frame_at(1.0), back;
  given.skins_world_m = {{{0.25f, -0.5f, 0.125f}, {0.25f, -0.5f, 0.375f}}, {}};  // one line along z
  history.add(given);
  history.fetch(0, back);
  EXPECT_EQ(back.skins_world_m, given.skins_world_m);
  given.time_s = 2.0;
  given.skins_world_m = {{}, {}};
  history.add(given);
  ASSERT_EQ(history.size(), 2u);
  history.fetch(1, back);
  EXPECT_EQ(back.skins_world_m, given.skins_world_m);
}

TEST(FrameHistory, ASpecimenOfOtherPartsBeginsAnew) {
  FrameHistory history;
  history.add(frame_at(1.0));
  messages::SceneFrame other = frame_at(2.0);
  other.skins_world_m.pop_back();
  history.add(other);
  EXPECT_EQ(history.size(), 1u);
  other.body_poses.pop_back();
  other.time_s = 3.0;
  history.add(other);
  EXPECT_EQ(history.size(), 1u);
  EXPECT_EQ(history.time_s(0), 3.0);
}

TEST(FrameHistory, AFrameLargerThanTheRoomIsKeptAllTheSame) {
  FrameHistory history(1000);
  for (int i = 0; i < 20; ++i) history.add(frame_at(0.1 * i));
  ASSERT_EQ(history.size(), 2u) << "where it began, and the newest";
  messages::SceneFrame frame;
  history.fetch(*history.nearest(1.9), frame);
  expect_same(frame, frame_at(0.1 * 19));
}

TEST(FrameHistory, WhatIsTooOldIsGivenUp) {
  FrameHistory history(FrameHistory::kMost_bytes, 10.0);
  for (int i = 0; i < 1000; ++i) history.add(frame_at(0.05 * i, 3));
  EXPECT_NEAR(history.time_s(0), 0.05 * 999 - 10.0, 0.051);
  EXPECT_LE(history.size(), 201u);
}

TEST(FrameHistory, TheSameFramesKeepTheSameOnes) {
  FrameHistory a(100'000), b(100'000);
  for (int i = 0; i < 500; ++i) {
    a.add(frame_at(0.013 * i));
    b.add(frame_at(0.013 * i));
  }
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a.time_s(i), b.time_s(i));
}

}  // namespace
}  // namespace myotact::view

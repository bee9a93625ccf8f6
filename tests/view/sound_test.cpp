// The tone that stands for a force: its samples, and what ALSA's own library makes of them.

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/file.h"
#include "support/temporary_folder.h"
#include "view/sound/force_tone.h"
#include "view/sound/speaker.h"

namespace myotact::view {
namespace {

constexpr double kLowest_Hz = 220.0;

std::vector<std::int16_t> second_of(ForceTone& tone) {
  std::vector<std::int16_t> samples(kSoundRate_Hz);
  tone.fill(samples);
  return samples;
}

int loudest(const std::vector<std::int16_t>& samples) {
  int most = 0;
  for (const int sample : samples) most = std::max(most, std::abs(sample));
  return most;
}

/// Upward crossings of zero.
double pitch_Hz(const std::vector<std::int16_t>& samples) {
  int crossings = 0;
  for (std::size_t s = 1; s < samples.size(); ++s) crossings += samples[s - 1] < 0 && samples[s] >= 0 ? 1 : 0;
  return crossings * static_cast<double>(kSoundRate_Hz) / static_cast<double>(samples.size());
}

TEST(ForceTone, NoForceIsSilence) {
  ForceTone tone;
  EXPECT_EQ(loudest(second_of(tone)), 0);
  for (const double none : {0.0, -1.0, std::nan("")}) {
    tone.aim(none);
    EXPECT_EQ(loudest(second_of(tone)), 0) << none;
  }
}

TEST(ForceTone, RisesTwoOctavesAndGrowsLouder) {
  int softer = 0;
  for (const double share : {0.01, 0.25, 0.5, 1.0, 7.0}) {
    ForceTone tone;
    tone.aim(share);
    second_of(tone);  // until it is there
    const auto samples = second_of(tone);
    EXPECT_NEAR(pitch_Hz(samples), kLowest_Hz * std::exp2(2.0 * std::min(share, 1.0)), 1.5) << share;
    EXPECT_GE(loudest(samples), softer);
    softer = loudest(samples);
  }
  EXPECT_LT(softer, 0.21 * 32767);
}

TEST(ForceTone, AJumpOfTheForceDoesNotClick) {
  ForceTone tone;
  tone.aim(1.0);
  const int steepest = static_cast<int>(0.2 * 32767 * 2 * 3.1416 * 880 / kSoundRate_Hz) + 20;  // of the loudest tone
  int before = 0;
  for (const double share : {1.0, 0.0, 0.3}) {
    tone.aim(share);
    for (const int sample : second_of(tone)) {
      ASSERT_LE(std::abs(sample - before), steepest);
      before = sample;
    }
  }
}

/// ALSA's configuration for this process: an output that writes what it is given to a file.
class Sound : public ::testing::Test {
 protected:
  void configure(const std::string& output) {
    write_file(folder_.path() / "asound.conf", output);
    setenv("ALSA_CONFIG_PATH", (folder_.path() / "asound.conf").c_str(), 1);
  }
  std::filesystem::path played() const { return folder_.path() / "played.raw"; }

  const testing::TemporaryFolder folder_;
};

TEST_F(Sound, IsHeardUntilNothingNewComes) {
  configure("pcm.nothing { type null }\npcm.!default { type file slave.pcm nothing format raw file \"" +
            played().string() + "\" }\n");
  constexpr double kShare = 0.5;
  {
    Speaker speaker;
    for (int picture = 0; picture < 60; ++picture) {
      speaker.play(kShare);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
  }
  const std::string bytes = read_file(played());
  std::vector<std::int16_t> samples(bytes.size() / sizeof(std::int16_t));
  std::memcpy(samples.data(), bytes.data(), samples.size() * sizeof(std::int16_t));
  ASSERT_GT(samples.size(), kSoundRate_Hz * 0.6);
  const auto middle = samples.begin() + kSoundRate_Hz / 5;
  EXPECT_NEAR(pitch_Hz({middle, middle + kSoundRate_Hz / 5}), kLowest_Hz * 2.0, 10.0);
  EXPECT_EQ(loudest({samples.end() - kSoundRate_Hz / 100, samples.end()}), 0);
}

TEST_F(Sound, WithoutAnOutputIsRefusedWithTheReason) {
  configure("pcm.!default { type hw card 31 }\n");
  try {
    Speaker speaker;
    FAIL() << "there is no such card";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("sound output"));
  }
}

}  // namespace
}  // namespace myotact::view

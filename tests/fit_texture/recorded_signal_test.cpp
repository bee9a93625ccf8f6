#include "fit_texture/recorded_signal.h"

#include <bit>
#include <cstdint>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/file.h"
#include "support/complaint.h"
#include "support/mutator.h"
#include "support/temporary_folder.h"

namespace myotact::fit_texture {
namespace {

using ::testing::HasSubstr;

std::string little(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xff);
  return text;
}

std::string wav(std::uint16_t kind, std::uint16_t bits, const std::string& samples, std::uint16_t channels = 1) {
  const std::uint16_t width = static_cast<std::uint16_t>(channels * bits / 8);
  const std::string format = little(kind, 2) + little(channels, 2) + little(8000, 4) + little(8000u * width, 4) +
                             little(width, 2) + little(bits, 2);
  const std::string body = "WAVEfmt " + little(format.size(), 4) + format + "LIST" + little(3, 4) + "abc" +
                           std::string(1, '\0') + "data" + little(samples.size(), 4) + samples;
  return "RIFF" + little(body.size(), 4) + body;
}

class Recordings : public ::testing::Test {
 protected:
  std::filesystem::path file(const std::string& name, const std::string& bytes) const {
    write_file(folder_ / name, bytes);
    return folder_ / name;
  }
  std::string wav_complaint(const std::string& bytes) const {
    const auto path = file("r.wav", bytes);
    return myotact::testing::complaint(ExitStatus::BadData, [&] { read_wav(path, 1.0); });
  }
  std::string csv_complaint(const std::string& text, ExitStatus status = ExitStatus::BadData) const {
    const auto path = file("r.csv", text);
    return myotact::testing::complaint(status, [&] { read_csv(path, 0.0); });
  }

  myotact::testing::TemporaryFolder folder_;
};

TEST_F(Recordings, ReadsEveryKindOfSample) {
  const double half = 0.5, minus = -0.25;
  const auto check = [&](std::uint16_t kind, std::uint16_t bits, const std::string& samples) {
    const RecordedSignal read = read_wav(file("r.wav", wav(kind, bits, samples)), 4.0);
    EXPECT_EQ(read.rate_Hz, 8000.0);
    ASSERT_EQ(read.signal_N.size(), 2u) << bits;
    EXPECT_DOUBLE_EQ(read.signal_N[0], 4.0 * half);
    EXPECT_DOUBLE_EQ(read.signal_N[1], 4.0 * minus);
  };
  check(1, 16, little(0x4000, 2) + little(0xe000, 2));
  check(1, 24, little(0x400000, 3) + little(0xe00000, 3));
  check(1, 32, little(0x40000000, 4) + little(0xe0000000, 4));
  check(3, 32, little(std::bit_cast<std::uint32_t>(0.5f), 4) + little(std::bit_cast<std::uint32_t>(-0.25f), 4));
  check(3, 64, little(std::bit_cast<std::uint64_t>(half), 8) + little(std::bit_cast<std::uint64_t>(minus), 8));
}

TEST_F(Recordings, RefusesDamagedWavesWithPlaceAndRemedy) {
  const std::string good = wav(1, 16, std::string(2000, 'x'));
  EXPECT_THAT(wav_complaint(good.substr(0, good.size() - 100)), HasSubstr("truncated"));
  EXPECT_THAT(wav_complaint(""), HasSubstr("no RIFF"));
  EXPECT_THAT(wav_complaint("t_s,force_N\n0,1\n"), HasSubstr("no RIFF"));
  EXPECT_THAT(wav_complaint(good.substr(0, 30)), HasSubstr("byte"));
  EXPECT_THAT(wav_complaint(wav(1, 16, "xxxxxxxx", 2)), HasSubstr("2 channels"));
  EXPECT_THAT(wav_complaint(wav(1, 8, "xxxxxxxx")), HasSubstr("8 bits"));
  EXPECT_THAT(wav_complaint(wav(3, 32, little(0x7fc00000, 4))), HasSubstr("not a number"));
  myotact::testing::complaint(ExitStatus::NoInput, [&] { read_wav(folder_ / "none.wav", 1.0); });
}

TEST_F(Recordings, ReadsColumnsInAnyOrder) {
  const RecordedSignal force = read_csv(
      file("r.csv", "speed_m_s, note,t_s,force_N,normal_force_N\n-0.1,a,0,0.5,1\n0.2,b,0.001,-0.5,2\r\n"), 0.0);
  EXPECT_NEAR(force.rate_Hz, 1000.0, 1e-9);
  EXPECT_EQ(force.signal_N, (std::vector<double>{0.5, -0.5}));
  EXPECT_EQ(force.normal_force_N, (std::vector<double>{1, 2}));
  EXPECT_EQ(force.speed_m_s, (std::vector<double>{0.1, 0.2}));
  const RecordedSignal acceleration = read_csv(file("r.csv", "t_s,acceleration_m_s2\n0,2\n0.0005,4\n"), 0.1);
  EXPECT_EQ(acceleration.signal_N, (std::vector<double>{0.2, 0.4}));
}

TEST_F(Recordings, RefusesBadTablesWithPlaceAndRemedy) {
  EXPECT_THAT(csv_complaint(""), HasSubstr("empty"));
  EXPECT_THAT(csv_complaint("time,force\n0,1\n"), HasSubstr("line 1: must name the columns"));
  EXPECT_THAT(csv_complaint("t_s,force_N\n0,1\n0.001,nan\n"), HasSubstr("line 3: force_N"));
  EXPECT_THAT(csv_complaint("t_s,force_N\n0,1\n0.001\n"), HasSubstr("line 3"));
  EXPECT_THAT(csv_complaint("t_s,force_N\n0,1\n"), HasSubstr("holds 1 samples"));
  EXPECT_THAT(csv_complaint("t_s,force_N\n0,1\n0.001,1\n0.005,1\n"), HasSubstr("evenly spaced"));
  EXPECT_THAT(csv_complaint("t_s,force_N\n0,1\n0,1\n0,1\n"), HasSubstr("evenly spaced"));
  EXPECT_THAT(csv_complaint("t_s,acceleration_m_s2\n0,1\n0.001,1\n", ExitStatus::Usage), HasSubstr("--mass"));
}

/// Either an Error or a recording, whatever is broken.
TEST_F(Recordings, NoBytesCrashTheReaders) {
  myotact::testing::Mutator mutator;
  const std::string wave = wav(1, 24, std::string(300, 'x'));
  const std::string table = "t_s,force_N,speed_m_s\n0,1,2\n0.001,2,3\n0.002,3,4\n";
  for (int trial = 0; trial < 1500; ++trial) {
    const auto broken_wave = folder_ / "broken.wav", broken_table = folder_ / "broken.csv";
    std::ofstream(broken_wave, std::ios::binary) << mutator.broken(wave);  // not flushed to disk, as write_file does
    std::ofstream(broken_table, std::ios::binary) << mutator.broken(table);
    try {
      read_wav(broken_wave, 1.0);
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::BadData);
    }
    try {
      read_csv(broken_table, 1.0);
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::BadData);
    }
  }
}

}  // namespace
}  // namespace myotact::fit_texture

#include "fit_texture/fit.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/file.h"
#include "fit_texture/band_limit.h"
#include "fit_texture/burg.h"
#include "haptics/effects/autoregression.h"
#include "scene/texture_file.h"
#include "support/complaint.h"
#include "support/temporary_folder.h"

namespace myotact::fit_texture {
namespace {

using ::testing::HasSubstr;

const std::vector<double> kTrue = {-0.88, 0.9, -0.7, 0.5};

/// The process by its direct recursion with a normal generator of the library: nothing of ours but the coefficients.
std::vector<double> process(const std::vector<double>& reflection, double rms_N, std::size_t count, unsigned seed) {
  const std::vector<double> a = haptics::prediction_coefficients(reflection);
  double white = rms_N * rms_N;
  for (const double k : reflection) white *= 1.0 - k * k;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, std::sqrt(white));
  std::vector<double> y;
  for (std::size_t n = 0; n < count + 1000; ++n) {
    double next = normal(random);
    for (std::size_t i = 0; i < a.size() && i < y.size(); ++i) next -= a[i] * y[y.size() - 1 - i];
    y.push_back(next);
  }
  return {y.begin() + 1000, y.end()};
}

/// RMS over 20-280 Hz of 10 log10 of the ratio of two processes' densities. [dB]
double spectral_distance(std::span<const double> fitted, std::span<const double> expected) {
  double squares = 0.0;
  int count = 0;
  for (double f = 20.0; f <= 280.0; f += 2.0, ++count) {
    squares += std::pow(10.0 * std::log10(haptics::spectral_density_1_Hz(fitted, f, 1000.0) /
                                          haptics::spectral_density_1_Hz(expected, f, 1000.0)),
                        2);
  }
  return std::sqrt(squares / count);
}

TEST(Burg, FindsTheCoefficientsOfAProcess) {
  const std::vector<std::vector<double>> pieces = {process(kTrue, 0.1, 60'000, 1)};
  const std::vector<double> found = burg_reflection(pieces, 6);
  // Standard error about sqrt((1 - k^2) / N) = 0.004 at most: four of them.
  for (std::size_t i = 0; i < kTrue.size(); ++i) EXPECT_NEAR(found[i], kTrue[i], 0.016) << i;
  EXPECT_NEAR(found[4], 0.0, 0.016);
  EXPECT_NEAR(found[5], 0.0, 0.016);
}

TEST(Burg, ManyPiecesAreAsGoodAsOne) {
  std::vector<std::vector<double>> pieces;
  for (unsigned i = 0; i < 300; ++i) pieces.push_back(process(kTrue, 0.1, 200, i));
  const std::vector<double> found = burg_reflection(pieces, 4);
  for (std::size_t i = 0; i < kTrue.size(); ++i) EXPECT_NEAR(found[i], kTrue[i], 0.02) << i;
}

TEST(Burg, StaysStableOnAPureTone) {
  std::vector<std::vector<double>> tone(1);
  for (int n = 0; n < 5000; ++n) tone[0].push_back(std::sin(0.3 * n));
  for (const double k : burg_reflection(tone, 10)) EXPECT_LT(std::abs(k), 1.0);
}

TEST(BandLimit, KeepsWhatIsBelowTheCutAndTakesTheRest) {
  const auto gain = [](double frequency_Hz) {
    std::vector<double> tone;
    for (int n = 0; n < 40'000; ++n) tone.push_back(std::sin(2.0 * std::numbers::pi * frequency_Hz / 10'000.0 * n));
    double squares = 0.0;
    const std::vector<double> slower = resampled(tone, 10'000.0, 1000.0, 300.0);
    for (const double x : slower) squares += x * x;
    return std::sqrt(2.0 * squares / static_cast<double>(slower.size()));
  };
  for (const double below_Hz : {30.0, 150.0, 250.0}) EXPECT_NEAR(gain(below_Hz), 1.0, 0.01) << below_Hz;
  for (const double above_Hz : {350.0, 700.0, 1230.0, 4000.0}) EXPECT_LT(gain(above_Hz), 2e-3) << above_Hz;
}

FitSettings one_node(int order) {
  FitSettings settings;
  settings.force_N = {1.0};
  settings.speed_m_s = {0.1};
  settings.order = order;
  return settings;
}

TEST(Fit, ComesBackThroughTheFile) {
  const RecordedSignal recording{1000.0, process(kTrue, 0.05, 60'000, 5), {}, {}};
  const haptics::VibrationGrid grid = fit_vibration(recording, one_node(4), "r");
  const myotact::testing::TemporaryFolder folder;
  write_file(folder / "t.json", texture_text(grid, "tendon", "of a test"));
  const scene::TextureFile file = scene::read_texture(folder / "t.json");
  EXPECT_EQ(file.tissue, messages::Tissue::Tendon);
  const haptics::VibrationNode& node = file.set.vibration.node(0, 0);
  EXPECT_NEAR(node.rms_N, 0.05, 0.002);
  EXPECT_LT(spectral_distance(std::span(node.reflection.data(), 4), kTrue), 0.5);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(node.reflection[i], grid.node(0, 0).reflection[i]);
}

/// A process at 10 kHz whose continuous resonance lies at 120 Hz: its model at 1 kHz has the same peak.
TEST(Fit, AFasterRecordingGivesTheSameSpectrum) {
  const double radius = std::exp(-std::numbers::pi * 60.0 / 10'000.0);
  const double angle = 2.0 * std::numbers::pi * 120.0 / 10'000.0;
  const double k2 = radius * radius, k1 = -2.0 * radius * std::cos(angle) / (1.0 + k2);
  const RecordedSignal recording{10'000.0, process({k1, k2}, 0.05, 600'000, 6), {}, {}};
  const haptics::VibrationGrid grid = fit_vibration(recording, one_node(10), "r");
  const std::span fitted(grid.node(0, 0).reflection.data(), 10);
  double squares = 0.0;
  int count = 0;
  for (double f = 20.0; f <= 250.0; f += 5.0, ++count) {
    const double expected = haptics::spectral_density_1_Hz(std::array{k1, k2}, f, 10'000.0);
    squares += std::pow(10.0 * std::log10(haptics::spectral_density_1_Hz(fitted, f, 1000.0) / expected), 2);
  }
  EXPECT_LT(std::sqrt(squares / count), 0.7);
  EXPECT_LE(haptics::power_above(fitted, 300.0, 1000.0), 0.05);
}

TEST(Fit, TakesOutWhatLiesAboveTheCap) {
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal(0.0, 0.05);
  RecordedSignal white{8000.0, {}, {}, {}};
  for (int i = 0; i < 200'000; ++i) white.signal_N.push_back(normal(random));
  const haptics::VibrationGrid grid = fit_vibration(white, one_node(16), "r");
  EXPECT_LE(haptics::power_above(std::span(grid.node(0, 0).reflection.data(), 16), 300.0, 1000.0), 0.05);
}

TEST(Fit, SortsAGridByForceAndSpeed) {
  const std::vector<double> other = {-0.5, 0.8, -0.4, 0.3};
  RecordedSignal recording{1000.0, {}, {}, {}};
  const auto add = [&](const std::vector<double>& model, double rms_N, double force_N, double speed_m_s) {
    const std::vector<double> part = process(model, rms_N, 30'000, static_cast<unsigned>(1e3 * rms_N));
    recording.signal_N.insert(recording.signal_N.end(), part.begin(), part.end());
    recording.normal_force_N.insert(recording.normal_force_N.end(), part.size(), force_N);
    recording.speed_m_s.insert(recording.speed_m_s.end(), part.size(), speed_m_s);
  };
  add(kTrue, 0.02, 0.45, 0.021);
  add(other, 0.06, 2.2, 0.09);
  add(other, 0.04, 0.55, 0.11);
  add(kTrue, 0.08, 1.9, 0.018);
  FitSettings settings = one_node(4);
  settings.force_N = {0.5, 2.0};
  settings.speed_m_s = {0.02, 0.1};
  const haptics::VibrationGrid grid = fit_vibration(recording, settings, "r");
  const auto check = [&](std::size_t force, std::size_t speed, double rms_N, const std::vector<double>& model) {
    EXPECT_NEAR(grid.node(force, speed).rms_N, rms_N, 0.04 * rms_N);
    EXPECT_LT(spectral_distance(std::span(grid.node(force, speed).reflection.data(), 4), model), 0.5);
  };
  check(0, 0, 0.02, kTrue);
  check(1, 1, 0.06, other);
  check(0, 1, 0.04, other);
  check(1, 0, 0.08, kTrue);
}

TEST(Fit, RefusesWhatItCannotUse) {
  const auto complaint = [](ExitStatus status, const RecordedSignal& recording, const FitSettings& settings) {
    return myotact::testing::complaint(status, [&] { fit_vibration(recording, settings, "slide.wav"); });
  };
  const FitSettings one = one_node(4);
  EXPECT_THAT(complaint(ExitStatus::BadData, {500.0, std::vector<double>(5000, 0.1), {}, {}}, one),
              HasSubstr("rate of 500"));
  EXPECT_THAT(complaint(ExitStatus::BadData, {8000.0, {0.1}, {}, {}}, one), HasSubstr("record longer"));
  EXPECT_THAT(complaint(ExitStatus::BadData, {1000.0, {}, {}, {}}, one), HasSubstr("record longer"));
  EXPECT_THAT(complaint(ExitStatus::BadData, {1000.0, std::vector<double>(5000, 0.1), {}, {}}, one),
              HasSubstr("silent"));
  EXPECT_THAT(complaint(ExitStatus::BadData, {1000.0, process(kTrue, 2.0, 5000, 1), {}, {}}, one), HasSubstr("--gain"));
  FitSettings grid = one;
  grid.force_N = {1.0, 2.0};
  EXPECT_THAT(complaint(ExitStatus::Usage, {1000.0, process(kTrue, 0.1, 5000, 1), {}, {}}, grid),
              HasSubstr("normal_force_N"));
  const std::vector<double> ones(5000, 1.0);
  EXPECT_THAT(complaint(ExitStatus::BadData, {1000.0, process(kTrue, 0.1, 5000, 1), ones, ones}, grid),
              HasSubstr("2 N, 0.1 m/s"));
}

}  // namespace
}  // namespace myotact::fit_texture

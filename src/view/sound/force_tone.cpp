#include "view/sound/force_tone.h"

#include <algorithm>
#include <cmath>

namespace myotact::view {

namespace {

constexpr double kTurn = 2.0 * 3.14159265358979323846;
constexpr double kLowest_Hz = 220.0, kOctaves = 2.0;
constexpr double kLoudest = 0.2 * 32767.0;  // a fifth of what the samples hold: it is heard for hours
constexpr double kGlide_s = 0.02;           // shorter than we hear as a delay, longer than a click

}  // namespace

void ForceTone::aim(double share) {
  aimed_share_ = share > 0.0 ? std::min(share, 1.0) : 0.0;  // not a number: silence
}

void ForceTone::fill(std::span<std::int16_t> samples) {
  constexpr double kStep = 1.0 / (kGlide_s * kSoundRate_Hz);
  for (std::int16_t& sample : samples) {
    share_ += kStep * (aimed_share_ - share_);
    phase_ += kLowest_Hz * std::exp2(kOctaves * share_) / kSoundRate_Hz;
    phase_ -= std::floor(phase_);
    // Loudness as the root of the share: a light touch is heard as well.
    sample = static_cast<std::int16_t>(std::lround(kLoudest * std::sqrt(share_) * std::sin(kTurn * phase_)));
  }
}

}  // namespace myotact::view

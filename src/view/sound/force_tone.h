#pragma once

#include <cstdint>
#include <span>

namespace myotact::view {

inline constexpr int kSoundRate_Hz = 48000;

/// A tone that stands for a force where a hand cannot feel it: two octaves from A3 up, since we hear steps of pitch of
/// about half a percent, and louder with the force, so that none is silent.
class ForceTone {
 public:
  /// The force as a share of the largest one there can be: 0 .. 1; others are taken as the nearer of these.
  void aim(double share);
  /// The next samples, one channel at kSoundRate_Hz. Pitch and loudness glide to their aim: a jump would click.
  void fill(std::span<std::int16_t> samples);

 private:
  double aimed_share_ = 0.0;
  double share_ = 0.0;
  double phase_ = 0.0;  // turns
};

}  // namespace myotact::view

#pragma once

#include <cstdint>

#include "haptics/effects/autoregression.h"
#include "haptics/effects/texture_set.h"

namespace myotact::haptics {

/// The model at a force and speed between the nodes: reflection coefficients and RMS interpolated bilinearly, which
/// keeps every coefficient within (-1, 1) and the model stable. Beyond the last node it stays as there; below the first
/// one the RMS goes to zero with force and speed. Real-time safe.
VibrationNode vibration_at(const VibrationGrid& grid, double force_N, double speed_m_s) noexcept;

/// Noise that is the same on every machine: near normal, unit variance, within 6. Real-time safe.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : state_(seed) {}
  double next() noexcept;

 private:
  std::uint64_t random() noexcept;
  std::uint64_t state_;
};

/// Vibration of a slide, sample by sample. A change of force, speed or tissue changes the model and keeps what is under
/// way. Real-time safe; one thread.
class Vibration {
 public:
  explicit Vibration(std::uint64_t seed) : noise_(seed) {}
  double next_N(const VibrationGrid& grid, double force_N, double speed_m_s) noexcept;

 private:
  Noise noise_;
  Lattice lattice_;
};

}  // namespace myotact::haptics

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "messages/local_model.h"

namespace myotact::haptics {

/// One plane wave of the relief of a tissue.
struct ReliefWave {
  double wavelength_m = 1e-3;
  double angle_rad = 0.0;  // from the fibres to the way across its crests
  double height_m = 0.0;   // amplitude
  double phase_rad = 0.0;
};

/// The vibration of a slide at one force and speed: an auto-regressive process by its reflection coefficients, each
/// within (-1, 1), which is all that stability asks of them.
struct VibrationNode {
  static constexpr int kMaxOrder = 30;  // own choice; models of recorded slides take some tens (Culbertson et al. 2014)
  std::array<double, kMaxOrder> reflection{};
  double rms_N = 0.0;
};

/// Nodes over force and speed, both rising.
struct VibrationGrid {
  int order = 0;
  std::vector<double> force_N, speed_m_s;
  std::vector<VibrationNode> nodes;  // one a pair, speeds of the first force first; empty: no vibration

  const VibrationNode& node(std::size_t force, std::size_t speed) const {
    return nodes[force * speed_m_s.size() + speed];
  }
};

/// What a touch sets ringing: gain * speed of approach * exp(-t / decay) sin(2 pi f t), along the normal.
struct Knock {
  double frequency_Hz = 0.0;  // 0: none
  double decay_s = 0.01;
  double gain_Ns_m = 0.0;
};

/// How one tissue feels beyond stiffness and friction.
struct TextureSet {
  std::vector<ReliefWave> relief;
  VibrationGrid vibration;
  Knock knock;
};

inline constexpr std::size_t kTissueCount = static_cast<std::size_t>(messages::Tissue::Skin) + 1;

/// Textures of a tool. What is empty is smooth.
struct TextureSettings {
  std::array<TextureSet, kTissueCount> by_tissue;
  std::uint64_t seed = 1;
};

/// Models of vibration hold at this rate, which is the haptic tick's.
inline constexpr double kTextureRate_Hz = 1000.0;
/// Texture stays below this, so that a loop of 1 kHz renders it (own choice; at 1 kHz finer texture buzzes, Choi and
/// Tan 2004).
inline constexpr double kTextureCap_Hz = 300.0;
/// Vibration is at most this strong: a tenth of what the smallest devices give (3.3 N). Own choice.
inline constexpr double kTextureCap_N = 0.3;

}  // namespace myotact::haptics

#include "haptics/effects/vibration.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace myotact::haptics {

namespace {

/// Where a value lies on an axis of nodes.
struct Place {
  std::size_t low = 0, high = 0;
  double share = 0.0;  // of the high one
  double fade = 1.0;   // below the first node: value over node
};

Place place_on(const std::vector<double>& axis, double value) {
  Place place;
  if (!(value > axis.front())) {
    place.fade = std::max(0.0, value) / axis.front();
    return place;
  }
  while (place.high + 1 < axis.size() && axis[place.high] < value) ++place.high;
  place.low = place.high > 0 ? place.high - 1 : 0;
  const double width = axis[place.high] - axis[place.low];
  place.share = width > 0.0 ? std::min(1.0, (value - axis[place.low]) / width) : 0.0;
  return place;
}

}  // namespace

VibrationNode vibration_at(const VibrationGrid& grid, double force_N, double speed_m_s) noexcept {
  VibrationNode mixed;
  if (grid.nodes.empty()) return mixed;
  const Place force = place_on(grid.force_N, force_N), speed = place_on(grid.speed_m_s, speed_m_s);
  const auto add = [&](const VibrationNode& node, double share) {
    mixed.rms_N += share * node.rms_N;
    for (std::size_t i = 0; i < static_cast<std::size_t>(grid.order); ++i) {
      mixed.reflection[i] += share * node.reflection[i];
    }
  };
  add(grid.node(force.low, speed.low), (1.0 - force.share) * (1.0 - speed.share));
  add(grid.node(force.low, speed.high), (1.0 - force.share) * speed.share);
  add(grid.node(force.high, speed.low), force.share * (1.0 - speed.share));
  add(grid.node(force.high, speed.high), force.share * speed.share);
  mixed.rms_N *= force.fade * speed.fade;
  return mixed;
}

std::uint64_t Noise::random() noexcept {  // SplitMix64 (Steele et al. 2014)
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

double Noise::next() noexcept {
  // Twelve even numbers of variance 1/12: their sum is near normal, bounded, and needs no function of a library.
  std::uint64_t sum = 0;
  for (int draw = 0; draw < 3; ++draw) {
    for (std::uint64_t bits = random(), part = 0; part < 4; ++part, bits >>= 16) sum += bits & 0xffffu;
  }
  return (static_cast<double>(sum) + 6.0) / 65536.0 - 6.0;
}

double Vibration::next_N(const VibrationGrid& grid, double force_N, double speed_m_s) noexcept {
  const VibrationNode model = vibration_at(grid, force_N, speed_m_s);
  const auto order = static_cast<std::size_t>(grid.nodes.empty() ? 0 : grid.order);
  return lattice_.next(std::span(model.reflection.data(), order), model.rms_N * noise_.next());
}

}  // namespace myotact::haptics

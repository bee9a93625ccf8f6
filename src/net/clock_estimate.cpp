#include "net/clock_estimate.h"

#include <algorithm>

namespace myotact::net {

namespace {

/// Of numbers without a sign, which wrap as intended: clocks of two machines differ by anything, and what the other
/// side reports may be any number.
std::int64_t difference(std::uint64_t a, std::uint64_t b) noexcept {
  return static_cast<std::int64_t>(a - b);
}

}  // namespace

void ClockEstimate::add(const PingTimes& times) noexcept {
  const std::int64_t round_trip =
      difference(times.arrived_here - times.left_here, times.left_there - times.arrived_there);
  if (round_trip < 0) return;  // no true answer
  const std::uint64_t one_way = static_cast<std::uint64_t>(round_trip) / 2;
  samples_[count_ % kKept] = {difference(times.arrived_there, times.left_here + one_way), round_trip};
  ++count_;
}

const ClockEstimate::Sample& ClockEstimate::best() const noexcept {
  const auto end = samples_.begin() + static_cast<std::ptrdiff_t>(std::min(count_, kKept));
  return *std::min_element(samples_.begin(), end,
                           [](const Sample& a, const Sample& b) { return a.round_trip_ns < b.round_trip_ns; });
}

double ClockEstimate::round_trip_s() const noexcept {
  return count_ == 0 ? 0.0 : 1e-9 * static_cast<double>(samples_[(count_ - 1) % kKept].round_trip_ns);
}

double ClockEstimate::least_round_trip_s() const noexcept {
  return count_ == 0 ? 0.0 : 1e-9 * static_cast<double>(best().round_trip_ns);
}

std::uint64_t ClockEstimate::here_ns(std::uint64_t there_ns) const noexcept {
  return count_ == 0 ? there_ns : there_ns - static_cast<std::uint64_t>(best().offset_ns);
}

}  // namespace myotact::net

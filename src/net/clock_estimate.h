#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace myotact::net {

/// What one ping and its answer report, by the clocks of both sides [ns].
struct PingTimes {
  std::uint64_t left_here = 0, arrived_there = 0, left_there = 0, arrived_here = 0;
};

/// Offset of the other side's steady clock from ours. Of the last few seconds of pings the one with the shortest round
/// trip counts (as in NTP, RFC 5905): what delays a packet only ever makes it look later. The error is at most half of
/// that round trip. One thread.
class ClockEstimate {
 public:
  void add(const PingTimes& times) noexcept;

  bool known() const noexcept { return count_ > 0; }
  double round_trip_s() const noexcept;  // of the newest ping, without the time that the other side took
  double least_round_trip_s() const noexcept;
  /// A time of the other side by our clock; the same number until the first ping came back.
  std::uint64_t here_ns(std::uint64_t there_ns) const noexcept;

 private:
  struct Sample {
    std::int64_t offset_ns = 0;  // theirs minus ours
    std::int64_t round_trip_ns = 0;
  };
  static constexpr std::size_t kKept = 64;  // 6 s of pings at 10 Hz: drifts of 50 ppm stay below 0.3 ms

  const Sample& best() const noexcept;

  std::array<Sample, kKept> samples_{};
  std::size_t count_ = 0;  // so far
};

}  // namespace myotact::net

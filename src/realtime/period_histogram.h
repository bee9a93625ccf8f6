#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace myotact::realtime {

struct DurationSummary {
  std::uint64_t count = 0;
  std::uint64_t p50_ns = 0;
  std::uint64_t p99_ns = 0;
  std::uint64_t p999_ns = 0;
  std::uint64_t max_ns = 0;
};

/// Counts durations in bins of fixed relative width, 3 % of the value. One thread adds, any thread may summarise
/// meanwhile. Allocates nothing.
class PeriodHistogram {
 public:
  void add(std::uint64_t duration_ns) noexcept;
  /// Percentiles are the upper edge of their bin, at most 3.2 % above the truth, and never above the largest value.
  DurationSummary summary() const noexcept;
  /// Only while no thread adds.
  void clear() noexcept;

 private:
  static constexpr int kBinsPerOctave_log2 = 5;
  static constexpr std::size_t kBins = std::size_t{64 - kBinsPerOctave_log2 + 1} << kBinsPerOctave_log2;
  static std::size_t bin_of(std::uint64_t duration_ns) noexcept;
  static std::uint64_t upper_edge_ns(std::size_t bin) noexcept;

  std::array<std::atomic<std::uint64_t>, kBins> counts_{};
  std::atomic<std::uint64_t> max_ns_{0};
};

}  // namespace myotact::realtime

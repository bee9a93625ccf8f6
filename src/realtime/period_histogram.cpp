#include "realtime/period_histogram.h"

#include <algorithm>
#include <bit>

namespace myotact::realtime {

// Below 2^6 ns each value has its own bin; above, an octave is split into 2^5 equal bins.
std::size_t PeriodHistogram::bin_of(std::uint64_t duration_ns) noexcept {
  const int width = static_cast<int>(std::bit_width(duration_ns));
  if (width <= kBinsPerOctave_log2 + 1) return static_cast<std::size_t>(duration_ns);
  const int shift = width - kBinsPerOctave_log2 - 1;
  return (static_cast<std::size_t>(shift) << kBinsPerOctave_log2) + static_cast<std::size_t>(duration_ns >> shift);
}

std::uint64_t PeriodHistogram::upper_edge_ns(std::size_t bin) noexcept {
  constexpr std::size_t kExact = std::size_t{1} << (kBinsPerOctave_log2 + 1);
  if (bin < kExact) return bin;
  const std::size_t shift = (bin >> kBinsPerOctave_log2) - 1;
  const std::uint64_t mantissa = bin - (shift << kBinsPerOctave_log2);
  return ((mantissa + 1) << shift) - 1;
}

void PeriodHistogram::add(std::uint64_t duration_ns) noexcept {
  counts_[bin_of(duration_ns)].fetch_add(1, std::memory_order_relaxed);
  if (duration_ns > max_ns_.load(std::memory_order_relaxed)) max_ns_.store(duration_ns, std::memory_order_relaxed);
}

DurationSummary PeriodHistogram::summary() const noexcept {
  DurationSummary summary;
  std::array<std::uint64_t, kBins> counts;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    counts[bin] = counts_[bin].load(std::memory_order_relaxed);
    summary.count += counts[bin];
  }
  summary.max_ns = max_ns_.load(std::memory_order_relaxed);
  const auto percentile = [&](std::uint64_t per_mille) {
    const std::uint64_t rank = (summary.count * per_mille + 999) / 1000;  // that many values are at or below the answer
    std::uint64_t seen = 0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      seen += counts[bin];
      if (seen >= rank && seen > 0) return std::min(upper_edge_ns(bin), summary.max_ns);
    }
    return summary.max_ns;
  };
  summary.p50_ns = percentile(500);
  summary.p99_ns = percentile(990);
  summary.p999_ns = percentile(999);
  return summary;
}

void PeriodHistogram::clear() noexcept {
  for (auto& count : counts_) count.store(0, std::memory_order_relaxed);
  max_ns_.store(0, std::memory_order_relaxed);
}

}  // namespace myotact::realtime

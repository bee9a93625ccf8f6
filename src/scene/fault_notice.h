#pragma once

#include <cstdint>
#include <string>

namespace myotact::scene {

/// What the window shows of the haptic loop's faults: the gravest one of the last 3 s with its remedy.
/// Single late ticks, a proxy that stopped short and a store of energy that ran empty mend themselves: they are left to
/// the summary of the run. One tool, one thread.
class FaultNotice {
 public:
  /// `faults`: bits of haptics::Fault that were set up to `now_ns`.
  void add(std::uint32_t faults, std::uint64_t now_ns);
  /// One line, or nothing.
  std::string text(std::uint64_t now_ns) const;

 private:
  std::uint32_t faults_ = 0;
  std::uint64_t seen_ns_ = 0;
};

}  // namespace myotact::scene

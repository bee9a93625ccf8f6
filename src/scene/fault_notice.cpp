#include "scene/fault_notice.h"

#include "haptics/faults.h"

namespace myotact::scene {

namespace {

constexpr std::uint64_t kShown_ns = 3'000'000'000;  // long enough to be read
constexpr std::uint32_t kMinor =
    haptics::bit(haptics::Fault::MissedDeadline) | haptics::bit(haptics::Fault::ProxyBudget) |
    haptics::bit(haptics::Fault::ProxyRescued) | haptics::bit(haptics::Fault::EnergyInjected);

}  // namespace

void FaultNotice::add(std::uint32_t faults, std::uint64_t now_ns) {
  const std::uint32_t reported = faults & ~kMinor;
  const std::uint32_t stopped = haptics::bit(haptics::Fault::Stopped);
  if (now_ns > seen_ns_ + kShown_ns) faults_ = 0;
  faults_ = (faults_ & ~stopped) | reported;  // a stop is shown as long as it lasts, and no longer
  if (reported != 0) seen_ns_ = now_ns;
}

std::string FaultNotice::text(std::uint64_t now_ns) const {
  if (faults_ == 0 || now_ns > seen_ns_ + kShown_ns) return {};
  return haptics::describe_faults(faults_).front();
}

}  // namespace myotact::scene

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace myotact::haptics {

/// What went wrong in a tick, as bits of ToolState::faults. fault_texts() says what was done and what to do.
enum class Fault : std::uint32_t {
  NonFiniteForce = 1u << 0,
  NonFiniteDevice = 1u << 1,
  DeviceLost = 1u << 2,
  Stopped = 1u << 3,
  StaleModel = 1u << 4,
  BadModel = 1u << 5,
  EnergyInjected = 1u << 6,
  ProxyRescued = 1u << 7,
  ProxyBudget = 1u << 8,
  MissedDeadline = 1u << 9,
  TooFast = 1u << 10,
  DeviceJumped = 1u << 11,
  ClockBackwards = 1u << 12,
  MotorHot = 1u << 13,
  Buzz = 1u << 14,
  StiffnessLowered = 1u << 15,
  WatchdogCut = 1u << 16,
};

constexpr std::uint32_t bit(Fault fault) {
  return static_cast<std::uint32_t>(fault);
}

struct FaultText {
  Fault fault;
  std::string_view name;    // as in reports
  std::string_view remedy;  // what was done, and what to do
};

/// Every fault, the gravest first.
std::span<const FaultText> fault_texts();

/// "name: remedy" of every bit that is set, the gravest first.
std::vector<std::string> describe_faults(std::uint32_t faults);

}  // namespace myotact::haptics

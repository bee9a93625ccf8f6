#pragma once

#include <cstdint>
#include <type_traits>

namespace myotact::messages {

/// How far a device on the table is from being felt with. Only Ready answers connected() with true.
enum class DevicePhase : std::uint8_t { Closed, Opening, NeedsCalibration, Ready, Lost };

/// What a panel shows of a device on the table.
struct DeviceReport {
  DevicePhase phase = DevicePhase::Closed;
  double rate_Hz = 0.0;   // exchanges with the device in the last second
  double warmth = -1.0;   // of the hottest motor, 0 cold .. 1 as hot as it may get; below 0: not reported
  const char* hint = "";  // what the person is to do now, a sentence of static text; empty: nothing
};

static_assert(std::is_trivially_copyable_v<DeviceReport>);

}  // namespace myotact::messages

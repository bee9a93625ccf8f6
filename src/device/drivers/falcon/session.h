#pragma once

#include <array>
#include <cstdint>

#include "device/drivers/falcon/exchange.h"
#include "device/drivers/falcon/transport.h"

namespace myotact::device::falcon {

/// A Falcon whose firmware runs: one command out, one report in, over and over; the device falls silent without
/// commands. One thread; allocates nothing.
class Session {
 public:
  /// `transport` outlives it. `now`: the clock [ns] by which reports and forces age.
  Session(Transport& transport, const ExchangeSettings& settings, std::uint64_t (*now)(void*), void* of)
      : transport_(transport), exchange_(settings), now_(now), of_(of) {}

  /// Sends what the force makes of the motors and takes what comes back within five milliseconds, the newest last.
  void exchange_once(const WantedForce& wanted) noexcept;
  /// The last command: no torque, lamps off.
  void rest() noexcept;

  const Exchange& exchange() const noexcept { return exchange_; }
  std::uint64_t now_ns() const noexcept { return now_(of_); }
  std::uint64_t reports() const noexcept { return reports_; }

 private:
  bool take_transfer(std::chrono::milliseconds patience) noexcept;

  Transport& transport_;
  Exchange exchange_;
  PacketReader reader_;
  std::array<std::uint8_t, kTransferBytes> transfer_{};
  std::uint64_t (*now_)(void*);
  void* of_;
  std::uint64_t reports_ = 0;
};

}  // namespace myotact::device::falcon

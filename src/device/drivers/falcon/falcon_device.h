#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "device/drivers/falcon/exchange.h"
#include "device/drivers/falcon/transport.h"
#include "device/hardware_device.h"
#include "realtime/latest_value.h"

namespace myotact::device::falcon {

struct FalconSettings {
  ExchangeSettings exchange;
  std::filesystem::path firmware;  // the maker's image; empty: only a Falcon that runs one already is taken
};

/// Opens the USB side. Throws Error Unavailable.
using OpenTransport = std::function<std::unique_ptr<Transport>()>;

/// A Falcon with a thread of its own that exchanges packets; the haptic tick leaves a force and takes a position,
/// through channels that never wait. After it was unplugged the thread looks for it twice a second and begins again:
/// homed anew, from no force.
class FalconDevice : public HardwareDevice {
 public:
  FalconDevice(std::string name, const FalconSettings& settings, OpenTransport open_transport);
  ~FalconDevice() override { close(); }

  const std::string& name() const override { return name_; }
  const DeviceProfile& profile() const override { return profile_; }
  void open() override;  // a second or two with its firmware; half a minute at most where it does not answer
  void close() noexcept override;
  bool connected() const noexcept override { return is_ready_; }
  messages::DeviceState read(std::uint64_t now_ns) noexcept override;
  void write(const messages::DeviceCommand& command) noexcept override;
  DeviceReport report() const noexcept override;

 private:
  /// What the exchange knows of the grip, for the tick.
  struct Pose {
    messages::DeviceState state;
    bool is_ready = false;
  };

  std::unique_ptr<Transport> start_transport() const;
  void run() noexcept;
  void exchange_until_gone(Transport& transport) noexcept;
  bool reopen() noexcept;

  std::string name_;
  FalconSettings settings_;
  OpenTransport open_transport_;
  DeviceProfile profile_;
  std::unique_ptr<Transport> transport_;  // of the thread, while it runs
  realtime::LatestValue<Pose> poses_;
  realtime::LatestValue<WantedForce> forces_;
  std::atomic<DevicePhase> phase_{DevicePhase::Closed};
  std::atomic<double> rate_Hz_{0.0};
  std::atomic<bool> stopping_{false};
  std::uint64_t read_ns_ = 0;  // of the tick's thread, as the next one
  bool is_ready_ = false;
  std::thread thread_;
};

}  // namespace myotact::device::falcon

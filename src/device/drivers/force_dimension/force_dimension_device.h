#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>

#include "device/drivers/force_dimension/exchange.h"
#include "device/drivers/force_dimension/settings.h"
#include "device/hardware_device.h"
#include "realtime/latest_value.h"

namespace myotact::device::force_dimension {

/// The library and which of its devices this program has open, by their numbers.
struct DhdLibrary {
  explicit DhdLibrary(const std::string& path) : api(path) {}
  static constexpr int kMostDevices = 16;
  Dhdapi api;
  std::array<std::atomic<bool>, kMostDevices> is_open{};
};

/// An omega, delta, sigma or lambda with a thread of its own that exchanges with it two thousand times a second; the
/// haptic tick leaves a force and takes a position, through channels that never wait. One that stopped answering is
/// opened anew, twice a second, but no other one in its place, and it does not move by itself then.
class ForceDimensionDevice : public HardwareDevice {
 public:
  /// `number`: its place among those that the library sees.
  ForceDimensionDevice(std::string name, int number, const ForceDimensionSettings& settings,
                       std::shared_ptr<DhdLibrary> library);
  ~ForceDimensionDevice() override { close(); }
  ForceDimensionDevice(const ForceDimensionDevice&) = delete;
  ForceDimensionDevice& operator=(const ForceDimensionDevice&) = delete;

  const std::string& name() const override { return name_; }
  /// After open(): of the model that answered.
  const DeviceProfile& profile() const override { return profile_; }
  void open() override;
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

  const Dhdapi& api() const { return library_->api; }
  /// What tells one device from another.
  struct Identity {
    int type = 0, serial = -1;
    bool operator==(const Identity&) const = default;
  };
  bool open_on_library() noexcept;
  Identity identity() const noexcept;
  void initialise() const noexcept;
  void prepare() const noexcept;
  bool reopen() noexcept;
  void close_on_library() noexcept;
  // ---- the device's own thread
  void run() noexcept;
  void exchange_until_gone() noexcept;
  RawState read_state() const noexcept;
  RawStatus read_status() const noexcept;
  void tell(const Exchange& exchange) noexcept;

  const std::string name_;
  const int number_;
  const ForceDimensionSettings settings_;
  std::shared_ptr<DhdLibrary> library_;
  DeviceProfile profile_;
  char id_ = 0;        // of the open device
  Identity identity_;  // of the one that open() found
  realtime::LatestValue<Pose> poses_;
  realtime::LatestValue<WantedForce> forces_;
  std::atomic<DevicePhase> phase_{DevicePhase::Closed};
  std::atomic<const char*> hint_{""};
  std::atomic<double> rate_Hz_{0.0};
  std::atomic<bool> stopping_{false};
  std::uint64_t read_ns_ = 0;  // of the tick's thread, as the next one
  bool is_ready_ = false;
  std::thread thread_;
};

}  // namespace myotact::device::force_dimension

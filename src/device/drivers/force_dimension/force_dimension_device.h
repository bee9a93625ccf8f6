#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "device/drivers/force_dimension/exchange.h"
#include "device/drivers/force_dimension/settings.h"
#include "device/exchanging_device.h"

namespace myotact::device::force_dimension {

/// The library and which of its devices this program has open, by their numbers.
struct DhdLibrary {
  explicit DhdLibrary(const std::string& path) : api(path) {}
  static constexpr int kMostDevices = 16;
  Dhdapi api;
  std::array<std::atomic<bool>, kMostDevices> is_open{};
};

/// An omega, delta, sigma or lambda, whose thread exchanges with it two thousand times a second. One that stopped
/// answering is opened anew, but no other one in its place, and it does not move by itself then.
class ForceDimensionDevice : public ExchangingDevice {
 public:
  /// `number`: its place among those that the library sees.
  ForceDimensionDevice(std::string name, int number, const ForceDimensionSettings& settings,
                       std::shared_ptr<DhdLibrary> library);
  ~ForceDimensionDevice() override { close(); }

  /// After open(): of the model that answered.
  const DeviceProfile& profile() const override { return profile_; }
  DeviceReport report() const noexcept override { return {phase(), rate_Hz(), -1.0, hint_}; }

 private:
  const Dhdapi& api() const { return library_->api; }
  /// What distinguishes one device from another.
  struct Identity {
    int type = 0, serial = -1;
    bool operator==(const Identity&) const = default;
  };
  bool open_on_library() noexcept;
  Identity identity() const noexcept;
  void initialise() const noexcept;
  void prepare() const noexcept;
  void connect() override;
  void disconnect() noexcept override;
  // ---- the device's own thread
  void exchange_until_gone() noexcept override;
  void leave_gone() noexcept override;
  bool reopen() noexcept override;
  void close_on_library() noexcept;
  RawState read_state() const noexcept;
  RawStatus read_status() const noexcept;

  const int number_;
  const ForceDimensionSettings settings_;
  std::shared_ptr<DhdLibrary> library_;
  DeviceProfile profile_;
  char id_ = 0;           // of the open device
  bool is_held_ = false;  // it is open on the library
  Identity identity_;     // of the one that open() found
  std::atomic<const char*> hint_{""};
};

}  // namespace myotact::device::force_dimension

#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "device/drivers/falcon/exchange.h"
#include "device/drivers/falcon/transport.h"
#include "device/exchanging_device.h"

namespace myotact::device::falcon {

struct FalconSettings {
  ExchangeSettings exchange;
  std::filesystem::path firmware;  // the maker's image; empty: only a Falcon that runs one already is taken
};

/// Opens the USB side. Throws Error Unavailable.
using OpenTransport = std::function<std::unique_ptr<Transport>()>;

/// A Falcon. After it was unplugged its thread looks for it and begins again: homed anew, from no force.
class FalconDevice : public ExchangingDevice {
 public:
  FalconDevice(std::string name, const FalconSettings& settings, OpenTransport open_transport);
  ~FalconDevice() override { close(); }

  const DeviceProfile& profile() const override { return profile_; }
  DeviceReport report() const noexcept override;

 private:
  /// Takes a second or two with its firmware; half a minute at most where it does not answer.
  void connect() override { transport_ = start_transport(); }
  void disconnect() noexcept override { transport_.reset(); }
  void exchange_until_gone() noexcept override;
  bool reopen() noexcept override;
  std::unique_ptr<Transport> start_transport() const;

  FalconSettings settings_;
  OpenTransport open_transport_;
  DeviceProfile profile_;
  std::unique_ptr<Transport> transport_;  // of the thread, while it runs
};

}  // namespace myotact::device::falcon

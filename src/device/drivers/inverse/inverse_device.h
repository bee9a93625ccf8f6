#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "device/drivers/inverse/exchange.h"
#include "device/drivers/inverse/service_link.h"
#include "device/drivers/inverse/settings.h"
#include "device/hardware_device.h"

namespace myotact::device::inverse {

/// An Inverse3 behind the Inverse Service. Its own thread talks with the service all the time, with zero force where
/// nothing else is allowed; a tick reads the newest state and leaves a force for the next command.
///
/// Opening until some states came in a row, then Ready. Any fault (silence, a broken or impossible state, the device
/// gone from the service, the connection gone): Lost and zero force at once; Ready again as after opening, by itself.
/// The service keeps no force for who is silent, so that a program that dies needs no cutout.
class InverseDevice : public HardwareDevice {
 public:
  /// `id` as the service knows it; `place` of its grip among the grips.
  InverseDevice(std::string name, std::string id, std::size_t place, const InverseSettings& settings,
                std::unique_ptr<ServiceLink> link);
  ~InverseDevice() override { close(); }
  InverseDevice(const InverseDevice&) = delete;
  InverseDevice& operator=(const InverseDevice&) = delete;

  const std::string& name() const override { return name_; }
  const DeviceProfile& profile() const override { return settings_.profile; }
  /// Waits up to about two seconds for the service. Throws ServiceError.
  void open() override;
  /// Waits up to about a second while the service stops answering.
  void close() noexcept override;
  bool connected() const noexcept override { return exchange_.connected(); }
  messages::DeviceState read(std::uint64_t now_ns) noexcept override { return exchange_.read(now_ns); }
  void write(const messages::DeviceCommand& command) noexcept override { exchange_.write(command); }
  DeviceReport report() const noexcept override { return exchange_.report(); }

 private:
  void talk();
  bool is_alive(std::string& text) noexcept;
  bool exchange_once(std::string& text);
  void connect_again();
  bool wait_or_closing();
  bool is_closing();
  void say_goodbye() noexcept;

  const std::string name_;
  const std::string id_;
  const InverseSettings settings_;
  std::unique_ptr<ServiceLink> link_;  // the thread's, while there is one
  Exchange exchange_;
  bool is_linked_ = false;

  std::mutex mutex_;
  std::condition_variable wake_;
  bool closing_ = false;  // under mutex_
  std::thread thread_;
};

}  // namespace myotact::device::inverse

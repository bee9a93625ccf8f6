#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

#include "device/hardware_device.h"
#include "realtime/latest_value.h"

namespace myotact::device {

/// What the hand asks of the motors.
struct WantedForce {
  std::array<double, 3> force_N{};  // in the device's frame (hardware_device.h)
  std::uint64_t at_ns = 0;          // when it was asked, by the tick's clock; 0: never
};

/// A device with a thread of its own that exchanges with it; the haptic tick leaves a force and takes a position,
/// through channels that never wait.
///
///   tick:    read() <-- poses --.                    .-- forces <-- write()
///   thread:                publish() <- exchange -> wanted()
///
/// When the exchange ends without close(), the device is lost: the thread tries reopen() twice a second and exchanges
/// again. A driver's destructor calls close().
class ExchangingDevice : public HardwareDevice {
 public:
  ExchangingDevice(std::string name, std::string thread_name);
  ExchangingDevice(const ExchangingDevice&) = delete;
  ExchangingDevice& operator=(const ExchangingDevice&) = delete;

  const std::string& name() const override { return name_; }
  /// A second call does nothing. Throws what connect() throws.
  void open() override;
  void close() noexcept override;
  bool connected() const noexcept override { return is_ready_; }
  messages::DeviceState read(std::uint64_t now_ns) noexcept override;
  void write(const messages::DeviceCommand& command) noexcept override;

 protected:
  /// Opens the device, before its thread starts. Throws Error Unavailable.
  virtual void connect() = 0;
  /// The other way, after its thread ended or could not be started.
  virtual void disconnect() noexcept = 0;

  // ---- called on the device's own thread
  /// Until stopping(), or until the device is gone.
  virtual void exchange_until_gone() noexcept = 0;
  /// After each exchange, before the device is looked for.
  virtual void leave_gone() noexcept {}
  /// One try to find the same device again.
  virtual bool reopen() noexcept = 0;

  const std::atomic<bool>& stopping() const noexcept { return stopping_; }
  void publish(const messages::DeviceState& state, DevicePhase phase) noexcept;
  /// The newest one.
  const WantedForce& wanted() noexcept;
  void set_rate(double rate_Hz) noexcept { rate_Hz_ = rate_Hz; }

  // ---- any thread
  DevicePhase phase() const noexcept { return phase_; }
  double rate_Hz() const noexcept { return rate_Hz_; }

 private:
  /// What the exchange knows of the grip, for the tick.
  struct Pose {
    messages::DeviceState state;
    bool is_ready = false;
  };

  void run() noexcept;

  const std::string name_, thread_name_;
  realtime::LatestValue<Pose> poses_;
  realtime::LatestValue<WantedForce> forces_;
  std::atomic<DevicePhase> phase_{DevicePhase::Closed};
  std::atomic<double> rate_Hz_{0.0};
  std::atomic<bool> stopping_{false};
  std::uint64_t read_ns_ = 0;  // of the tick's thread, as the next one
  bool is_ready_ = false;
  std::thread thread_;
};

/// Exchanges a second, updated each second. Of the device's thread.
class ExchangeRate {
 public:
  explicit ExchangeRate(std::uint64_t now_ns) : since_ns_(now_ns) {}
  /// `exchanges` since the start. True once a second: rate_Hz() is new.
  bool count(std::uint64_t exchanges, std::uint64_t now_ns) noexcept;
  double rate_Hz() const noexcept { return rate_Hz_; }

 private:
  std::uint64_t since_ns_;
  std::uint64_t counted_ = 0;
  double rate_Hz_ = 0.0;
};

}  // namespace myotact::device

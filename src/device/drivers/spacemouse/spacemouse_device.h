#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "device/drivers/spacemouse/hid_port.h"
#include "device/drivers/spacemouse/motion.h"
#include "device/drivers/spacemouse/reports.h"
#include "device/hardware_device.h"
#include "realtime/latest_value.h"

namespace myotact::device::spacemouse {

/// Opens the device wherever it is plugged in now. Throws Error Unavailable. Called by open(), then by the device's own
/// thread after the device was unplugged.
using PortOpener = std::function<std::unique_ptr<HidPort>()>;

/// A SpaceMouse as a hand: it moves a tool and feels nothing. Its own thread reads the reports; a tick moves the tool
/// by the newest deflection, which is held between reports: a cap held still sends none.
///
///   hidraw --reports--> own thread --Cap (newest)--> read(): Motion --> DeviceState
///
/// Unplugged: Lost, the tool stands still, no button is down; plugged in again: Ready, from rest.
class SpaceMouseDevice : public HardwareDevice {
 public:
  SpaceMouseDevice(std::string name, PortOpener opener, const MotionSettings& settings = {});
  ~SpaceMouseDevice() override { close(); }
  SpaceMouseDevice(const SpaceMouseDevice&) = delete;
  SpaceMouseDevice& operator=(const SpaceMouseDevice&) = delete;

  const std::string& name() const override { return name_; }
  const DeviceProfile& profile() const override { return profile_; }
  void open() override;
  void close() noexcept override;
  bool connected() const noexcept override { return phase_ == DevicePhase::Ready; }
  messages::DeviceState read(std::uint64_t now_ns) noexcept override;
  void write(const messages::DeviceCommand&) noexcept override {}  // it has no motors
  DeviceReport report() const noexcept override;

 private:
  void watch();
  void take_reports();
  void lose();
  void find_again();
  void count_rate();

  const std::string name_;
  const PortOpener opener_;
  DeviceProfile profile_;

  std::atomic<DevicePhase> phase_{DevicePhase::Closed};
  std::atomic<double> rate_Hz_{0.0};
  std::atomic<int> battery_percent_{-1};
  realtime::LatestValue<Cap> caps_;

  // ---- the device's own thread
  std::unique_ptr<HidPort> port_;
  Cap cap_;
  int reports_ = 0;  // since counted_from_ns_
  std::uint64_t counted_from_ns_ = 0;

  // ---- the haptic tick
  Motion motion_;
  std::uint64_t last_ns_ = 0;
  bool started_ = false;

  std::mutex mutex_;
  std::condition_variable wake_;
  bool closing_ = false;  // under mutex_
  std::thread thread_;
};

}  // namespace myotact::device::spacemouse

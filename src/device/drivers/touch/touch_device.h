#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "device/drivers/touch/frame_validator.h"
#include "device/drivers/touch/servo.h"
#include "device/drivers/touch/settings.h"
#include "device/hardware_device.h"

namespace myotact::device::touch {

/// The library and its one servo loop.
struct TouchLibrary {
  explicit TouchLibrary(const std::string& path) : api(path), servo(api) {}
  Hdapi api;
  Servo servo;
};

/// Why a device does not open, and what to do about it: one sentence each.
struct Trouble {
  std::string cause, remedy;
};
Trouble trouble_of(const Hdapi& api, Code error);

/// A Touch whose frames are in the servo thread of its maker's library; ticks are made there and nowhere else. A force
/// lasts for the frame in which it was written.
class TouchDevice : public HardwareDevice, private ServoClient {
 public:
  TouchDevice(std::string name, std::string configuration, const TouchSettings& settings,
              std::shared_ptr<TouchLibrary> library);
  ~TouchDevice() override { close(); }
  TouchDevice(const TouchDevice&) = delete;
  TouchDevice& operator=(const TouchDevice&) = delete;

  const std::string& name() const override { return name_; }
  /// After open(): force and reach as the device reports them.
  const DeviceProfile& profile() const override { return profile_; }
  void open() override;
  void close() noexcept override;
  bool connected() const noexcept override { return phase_ == DevicePhase::Ready && library_->servo.is_ticking(); }
  messages::DeviceState read(std::uint64_t) noexcept override { return validator_.state(); }
  void write(const messages::DeviceCommand& command) noexcept override;
  DeviceReport report() const noexcept override;
  ServoClock* servo_clock() noexcept override { return &library_->servo; }

 private:
  void recover(bool hung) override;

  // ---- servo thread
  void begin_frame(std::uint64_t now_ns) noexcept override;
  void end_frame(bool is_last) noexcept override;
  Code look_after_calibration() noexcept;
  Code look_after_motors() noexcept;
  void count_rate(std::uint64_t now_ns) noexcept;

  /// From the library. Throws Error Unavailable.
  void acquire();
  void release() noexcept;
  void learn_profile();
  const Hdapi& api() const { return library_->api; }

  const std::string name_, configuration_;
  std::shared_ptr<TouchLibrary> library_;
  DeviceProfile profile_;
  Handle handle_ = kNoDevice;

  Vec3 middle_mm_ = Vec3::Zero();  // of its workspace
  FrameValidator validator_{Vec3::Zero()};
  RawFrame raw_;
  Code end_error_ = kNone;  // that the end of the last frame left
  std::array<double, 3> wanted_N_{};
  bool tells_warmth_ = true;
  std::uint64_t frames_ = 0;
  std::uint64_t counted_ = 0, counted_from_ns_ = 0;

  std::atomic<DevicePhase> phase_{DevicePhase::Closed};
  std::atomic<const char*> hint_{""};
  std::atomic<double> rate_Hz_{0.0}, warmth_{-1.0};
  std::atomic<std::uint64_t> framed_ns_{0};  // when the last frame began
};

}  // namespace myotact::device::touch

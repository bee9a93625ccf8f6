#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include "messages/device.h"

namespace myotact::device {

/// What a device can support and how it moves by itself. Initial values: a desktop stylus of the 3 N class
/// (assets/devices/ names the source of each quantity).
struct DeviceProfile {
  double peak_force_N = 3.3;
  double continuous_force_N = 0.88;  // root mean square that the motors withstand continuously without overheating
  double max_stiffness_N_m = 1000.0;
  double inertia_kg = 0.07;  // felt at the stylus
  double viscous_Ns_m = 0.05;
  double coulomb_N = 0.1;
  double resolution_m = 20e-6;    // of the encoder, at the stylus
  bool shows_force_only = false;  // nothing moves the hand, as of a mouse: no speed of it is dangerous
  int delay_ticks = 0;            // from reading a position to the force that answers it
  double motion_scale = 1.0;  // metres that the positions report for a metre of the hand: of a device that is placed
  std::array<double, 3> workspace_m{0.16, 0.12, 0.07};  // edges of the box that the stylus reaches: right, up, towards
};

/// One force-feedback device. open() and close() belong to the thread that owns the device; read() and write() to the
/// haptic tick: they never allocate, lock, wait, log or throw.
class Device {
 public:
  virtual ~Device() = default;

  virtual const std::string& name() const = 0;
  virtual const DeviceProfile& profile() const = 0;

  /// Throws Error Unavailable when the device does not answer.
  virtual void open() = 0;
  virtual void close() noexcept = 0;
  /// False: the states read are not to be trusted; forces must go to zero.
  virtual bool connected() const noexcept = 0;

  /// The stylus at `now_ns`, which never runs backwards.
  virtual messages::DeviceState read(std::uint64_t now_ns) noexcept = 0;
  /// The force that acts on the hand until the next write.
  virtual void write(const messages::DeviceCommand& command) noexcept = 0;
};

/// Ticks that a maker's library makes: its servo thread calls us, not we it.
class ServoClock {
 public:
  virtual ~ServoClock() = default;
  /// Calls `tick` with the steady clock [ns] once a servo period, between its read and its write, until stop(). `tick`
  /// neither allocates, locks, waits nor throws. Throws Error Unavailable.
  virtual void start(std::function<void(std::uint64_t now_ns)> tick) = 0;
  /// No tick runs any more when it returns, and the force is zero. Any number of times. Its caller may read and write
  /// once more afterwards, which moves nothing.
  virtual void stop() noexcept = 0;
};

}  // namespace myotact::device

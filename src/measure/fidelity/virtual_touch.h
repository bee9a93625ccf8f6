#pragma once

#include <cstdint>

#include "core/vector.h"
#include "device/simulated_device.h"
#include "haptics/haptic_loop.h"

namespace myotact::measure {

/// A patch of tissue that rests, 0.1 m square about the origin, its normal up: flat, or waves of 2 mm over 33 mm.
/// With a muscle line 40 mm above it and a bone at 60 mm that does not rotate.
struct TouchedPatch {
  bool waves = false;
  bool line = false;
  bool bone = false;
};

/// A simulated hand on a simulated device, a haptic loop, and a model of a resting patch every 10 ms, on one virtual
/// clock of 1 kHz.
class VirtualTouch {
 public:
  VirtualTouch(const TouchedPatch& patch, const Vec3& start_m, const device::DeviceProfile& profile,
               const device::HandProfile& hand, const haptics::HapticSettings& settings);

  /// One tick. `publishes`: a new model comes when its step is over.
  void tick(bool publishes = true);
  Vec3 force_N() const { return to_vec3(loop.tool_state().force_world_N); }
  /// Work that the force on the hand did in the last tick, by the true way of the device [J].
  double work_J() const { return work_J_; }
  double time_s() const { return 1e-9 * static_cast<double>(now_ns_); }

  device::SimulatedDevice device;
  haptics::HapticLoop loop;
  messages::LocalModel model;  // as the next step sends it, but for times and numbers

 private:
  void publish();

  std::uint64_t now_ns_ = 0;
  std::uint64_t sequence_ = 0;
  Vec3 last_m_;
  double work_J_ = 0.0;
};

}  // namespace myotact::measure

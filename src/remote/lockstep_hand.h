#pragma once

#include <cstdint>
#include <functional>

#include "haptics/haptic_loop.h"
#include "net/frame_stream.h"
#include "remote/scripted_device.h"

namespace myotact::remote {

/// A haptic loop on the virtual clock of a LockstepServer: the ticks of a step, then the step over there. Feels the
/// same as in a session in one process.
class LockstepHand {
 public:
  /// Joins. `device` outlives it. Throws Error Unavailable.
  LockstepHand(const net::Endpoint& server, const net::Token& token, const scene::ToolSettings& tool,
               ScriptedDevice& device);

  /// One step; `each_tick` sees every tick before it. Throws Error Unavailable when the server is gone.
  void step(const std::function<void(double time_s, const haptics::HapticTick&)>& each_tick);

  double time_s() const;  // of the next tick

 private:
  /// Sends the state of the hand, and waits for the model that answers it.
  void exchange();

  net::Endpoint server_;
  net::FrameStream stream_;
  ScriptedDevice* device_;
  haptics::HapticLoop loop_;
  std::uint64_t step_ns_ = 0;
  std::uint64_t clock_ns_ = haptics::kTickPeriod_ns;  // time 0 means "never" to a device
};

}  // namespace myotact::remote

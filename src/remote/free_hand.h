#pragma once

#include "device/device.h"
#include "haptics/haptic_loop.h"
#include "haptics/haptic_thread.h"
#include "net/client.h"
#include "realtime/watchdog.h"
#include "scene/scene_file.h"

namespace myotact::remote {

/// A hand on the wall clock: its device and 1 kHz loop here, the simulation at a server. What a break of the connection
/// does to the force is the gate's business: it fades, and comes back through the ramp with new models.
class FreeHand {
 public:
  /// Joins with the first hand that is free. `device`, `watchdog` (null: none) and `servo` (null: our own ticks)
  /// outlive it. Throws Error Unavailable: no server, refused, no hand free.
  FreeHand(const net::ClientSettings& settings, device::Device& device, const scene::ToolSettings& tool,
           realtime::Watchdog* watchdog, device::ServoClock* servo = nullptr);
  ~FreeHand() { stop(); }

  void start() { thread_.start(); }
  /// Force zero, then good-bye. Any number of times.
  void stop() noexcept;

  net::Client& client() { return client_; }
  haptics::HapticLoop& loop() { return loop_; }
  const haptics::HapticThread& thread() const { return thread_; }

 private:
  haptics::HapticLoop loop_;
  net::Client client_;
  haptics::HapticThread thread_;
};

}  // namespace myotact::remote

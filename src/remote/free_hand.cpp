#include "remote/free_hand.h"

#include <fmt/format.h>

#include "core/error.h"
#include "realtime/periodic_loop.h"
#include "scene/lockstep_haptics.h"

namespace myotact::remote {

FreeHand::FreeHand(const net::ClientSettings& settings, device::Device& device, const scene::ToolSettings& tool,
                   realtime::Watchdog* watchdog, device::ServoClock* servo)
    : loop_(device, scene::haptic_settings(tool)),
      client_(settings, {&loop_.tool_states(), &loop_.models()}),
      thread_(loop_, watchdog, servo) {
  loop_.prepare(realtime::steady_now_ns());
  client_.on_stop([this] { loop_.stop_forces(true); });
  client_.start();
  if (client_.status().welcome.hand < 0) {
    throw Error(ExitStatus::Unavailable,
                fmt::format("{}:{}: no hand of the scene is free; wait for one, or start the server with more --hands",
                            settings.server.host, settings.server.port));
  }
}

void FreeHand::stop() noexcept {
  loop_.stop_forces(true);
  thread_.stop();
  client_.stop();
}

}  // namespace myotact::remote

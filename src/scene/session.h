#pragma once

#include <string>

#include "messages/command.h"
#include "messages/scene_frame.h"

namespace myotact::scene {

/// A scene that runs while a window draws it: simulated here, a recording that is played, or a server's. All calls on
/// the drawing thread, but where it says otherwise.
class Session {
 public:
  virtual ~Session() = default;

  /// Before start(): forces stay off until they are enabled, as after a stop in the session before.
  virtual void start_stopped() = 0;
  /// Throws Error where a device does not start: nothing runs then.
  virtual void start() = 0;
  /// Forces to zero and devices free for another session, without waiting for a step that is under way; stop() is still
  /// to come, on any one thread. What cannot hang just stops.
  virtual void let_go() { stop(); }
  /// Forces to zero, threads joined. Rethrows what ended the session, if anything did.
  virtual void stop() = 0;
  virtual bool running() const = 0;

  /// Copies the newest frame; false when there is none newer.
  virtual bool fetch_frame(messages::SceneFrame& frame) = 0;
  /// Passes on what somebody asks for. Returns why it cannot be done, for the person to read; empty: it is on its way.
  [[nodiscard]] virtual std::string push(const messages::Command& command) = 0;
  /// Any thread, at once and beside every queue: a stop stays until forces are enabled.
  virtual void stop_forces(bool stopped) noexcept = 0;
  /// Any thread: whether forces were stopped, by request or on a device.
  virtual bool forces_stopped() const noexcept = 0;
};

}  // namespace myotact::scene

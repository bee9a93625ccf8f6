#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/options.h"
#include "messages/scene_frame.h"
#include "scene/scene_file.h"
#include "scene/session.h"
#include "view/window/window.h"

namespace myotact::app {

class Equipment;
struct GuardedMotors;

/// What a window shows, with all that belongs to it: a scene, its session, and what the person has of it in hand.
/// Another scene is another stage, built while this one runs. On the drawing thread, once it is made.
class Stage {
 public:
  virtual ~Stage() = default;

  virtual const scene::Scene& scene() const = 0;
  virtual scene::Session& session() = 0;
  /// `options`: what it was made with.
  virtual view::WindowSettings window_settings(const Options& options) const = 0;
  /// Once a picture: what the person holds and moves.
  virtual void lead(const view::ViewControls& controls) = 0;

  /// Simulated here and now: it can be recorded, and where no frame comes a step does not end.
  virtual bool simulates() const { return false; }
  virtual view::JointReadings readings(const messages::SceneFrame&) { return {}; }
  virtual std::vector<view::DeviceNews> device_news() const { return {}; }
  virtual std::optional<view::ClassNews> class_news() { return {}; }
  /// How long it has been shown, by its own clock [s].
  virtual double shown_s(const messages::SceneFrame& newest) const { return newest.time_s; }
  /// There is another scene now where this one comes from.
  virtual bool is_outdated() const { return false; }
  /// After the session's stop(): what the system did not permit; empty: nothing.
  virtual std::string refused() const { return {}; }
};

/// A server's scene, a recording or a scene that is simulated here, as the options choose; takes seconds, any thread.
/// Throws Error. `guarded` and `equipment` outlive it.
std::unique_ptr<Stage> make_stage(const Options& options, GuardedMotors& guarded, const Equipment& equipment);

}  // namespace myotact::app

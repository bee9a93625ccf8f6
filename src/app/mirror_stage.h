#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "app/options.h"
#include "device/mouse_device.h"
#include "net/client.h"
#include "net/scene_inquiry.h"
#include "remote/free_hand.h"
#include "remote/mirror.h"
#include "view/window.h"

namespace myotact::app {

/// A window on a scene that a server simulates: a viewer looks on, an instructor leads, and with --device mouse one of
/// the scene's hands is here.
class MirrorStage {
 public:
  /// Joins the server of --connect and opens its scene from this machine's files, which takes seconds; any thread.
  /// Throws Error.
  explicit MirrorStage(const Options& options);
  ~MirrorStage() { stop(); }
  MirrorStage(const MirrorStage&) = delete;
  MirrorStage& operator=(const MirrorStage&) = delete;

  const scene::Scene& scene() const { return scene_; }
  view::WindowSettings window_settings() const;

  void start();  // of the hand
  void stop() noexcept;

  void fetch_frame(messages::SceneFrame& frame);
  /// What the person asks for; `requests` are the same for the simulation. Returns why it is not done, or nothing.
  std::string lead(const view::ViewControls& controls, const scene::Requests& requests);
  /// The server was started again with another scene than this.
  bool is_outdated() const { return mirror_->shows_another_scene(answer_.scene_json); }

 private:
  net::SceneAnswer answer_;
  scene::Scene scene_;
  device::MouseDevice mouse_;
  std::unique_ptr<remote::FreeHand> hand_;  // one of the two
  std::unique_ptr<net::Client> watcher_;
  std::unique_ptr<remote::Mirror> mirror_;
  std::uint32_t arms_ = 0, stops_ = 0;  // asked for so far
  bool told_ = false;                   // that a viewer changes nothing
};

}  // namespace myotact::app

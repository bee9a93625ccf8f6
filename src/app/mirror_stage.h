#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "app/stage.h"
#include "device/mouse_device.h"
#include "net/client.h"
#include "net/scene_inquiry.h"
#include "remote/free_hand.h"
#include "remote/mirror.h"
#include "view/window/window.h"

namespace myotact::app {

/// A window on a scene that a server simulates: a viewer looks on, an instructor leads, and with --device mouse one of
/// the scene's hands is here.
class MirrorStage final : public Stage, public scene::Session {
 public:
  /// Joins the server of --connect and opens its scene from this machine's files, which takes seconds; any thread.
  /// Throws Error.
  explicit MirrorStage(const Options& options);
  ~MirrorStage() override { stop(); }
  MirrorStage(const MirrorStage&) = delete;
  MirrorStage& operator=(const MirrorStage&) = delete;

  const scene::Scene& scene() const override { return scene_; }
  scene::Session& session() override { return *this; }
  view::WindowSettings window_settings(const Options& options) const override;
  void lead(const view::ViewControls& controls) override;
  /// By the wall: a server's time began long ago.
  double shown_s(const messages::SceneFrame& newest) const override;
  std::optional<view::ClassNews> class_news() override;
  bool is_outdated() const override { return mirror_->shows_another_scene(answer_.scene_json); }

  void start_stopped() override { stop_own_hand(true); }
  void start() override;
  void stop() noexcept override;
  bool running() const override { return true; }  // a server that is gone is looked for until it is back
  bool fetch_frame(messages::SceneFrame& frame) override;
  [[nodiscard]] std::string push(const messages::Command& command) override;
  /// A stop is for all who are connected; enabled again is only the hand here.
  void stop_forces(bool stopped) noexcept override;
  bool forces_stopped() const noexcept override { return hand_ ? hand_->loop().is_stopped() : stopped_; }

 private:
  void stop_own_hand(bool stopped) noexcept;
  net::SceneAnswer answer_;
  scene::Scene scene_;
  device::MouseDevice mouse_;
  std::unique_ptr<remote::FreeHand> hand_;  // one of the two
  std::unique_ptr<net::Client> watcher_;
  std::unique_ptr<remote::Mirror> mirror_;
  std::string heard_;  // what was said to the class last, and what of it is shown
  std::optional<view::ClassNews> class_news_;
  bool stopped_ = false;  // without a hand here: remembered for the session after this one
  std::chrono::steady_clock::time_point started_;
};

}  // namespace myotact::app

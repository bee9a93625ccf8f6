#pragma once

#include <string>

#include "messages/command.h"
#include "messages/felt_tool.h"
#include "messages/scene_frame.h"
#include "net/client.h"
#include "scene/scene_file.h"

namespace myotact::remote {

/// What a window shows of a scene that runs elsewhere, and what it may ask of it. One thread.
class Mirror {
 public:
  /// `client` wants frames and readings; it and the scene, the server's, outlive this.
  Mirror(net::Client& client, const scene::Scene& scene) : client_(&client), scene_(&scene) {}

  /// The newest frame that fits the scene. While there is no connection, or the frames do not fit, the last one that
  /// did, whose notice states why. False: nothing new.
  bool fetch_frame(messages::SceneFrame& frame);
  /// Asks the server for it. False: it did not go out, for it is not an instructor's, or not to be asked from
  /// elsewhere.
  [[nodiscard]] bool push(const messages::Command& command);
  /// Anybody's: stops the forces of all.
  void ask_stop() { client_->ask_stop(); }
  /// The server was started again with another scene.
  bool shows_another_scene(const std::string& scene_json) const;

 private:
  std::string trouble() const;

  net::Client* client_;
  const scene::Scene* scene_;
  messages::SceneFrame newest_, fitting_;
  std::string misfit_;
  std::string told_;  // notice of the connection in the last frame
};

/// A hand whose loop runs here is drawn as it is felt here, not as the server heard of it: its tool in the frame is the
/// nearest one.
void show_own_hand(const messages::FeltTool& felt, messages::SceneFrame& frame);

}  // namespace myotact::remote

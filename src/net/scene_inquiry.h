#pragma once

#include <string>

#include "net/small_frames.h"
#include "net/socket.h"

namespace myotact::net {

class FrameStream;

/// What a server sends everybody who joins.
struct SceneAnswer {
  Welcome welcome;
  std::string scene_json;
};

/// Joins for a moment as a viewer, to learn what the server shows. Throws Error Unavailable: no server there, or it
/// refused.
SceneAnswer ask_scene(const Endpoint& server, const Token& token);

/// Reads Welcome and scene, the first frames of a server. Throws Error Unavailable.
SceneAnswer read_scene(FrameStream& stream, const Endpoint& server);

}  // namespace myotact::net

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "messages/scene_frame.h"
#include "net/small_frames.h"
#include "net/wire.h"

namespace myotact::net {

/// Skins lie on a grid of this width on the wire: a hundredth of what the eye sees of a limb on a screen.
inline constexpr double kGrid_m = 1e-5;
inline constexpr std::uint8_t kLastOfScene = 1;  // flag: the scene frame is whole with this one

/// Of a skin whose key fits into a frame.
inline constexpr std::size_t kMostSkinVertices = (kMostPayload - 12) / (3 * sizeof(std::int32_t));

/// A frame that many connections send.
struct EncodedFrame {
  FrameType type = FrameType::SceneDelta;
  Bytes payload;
};

/// Skins to which later frames refer.
struct SceneKey {
  std::uint32_t number = 0;
  std::vector<std::vector<std::array<std::int32_t, 3>>> skins;  // on the grid
  std::vector<EncodedFrame> frames;
};

/// One scene frame, encoded once for all who watch.
struct EncodedScene {
  std::shared_ptr<const SceneKey> key;
  std::vector<EncodedFrame> deltas;  // one a skin
  EncodedFrame poses, readings, in_force;
};

/// What a client that was shown `shown` last (null: nothing yet) is to be sent of `scene`, in this order.
std::vector<const EncodedFrame*> frames_to_send(const EncodedScene& scene, const EncodedScene* shown,
                                                const Wants& wants);

/// Encodes one scene frame after the other. Begins a new key when skins have moved so far that deltas no longer save
/// much. One thread.
class SceneEncoder {
 public:
  std::shared_ptr<const EncodedScene> encode(const messages::SceneFrame& frame);

 private:
  std::shared_ptr<const SceneKey> key_;
  std::uint32_t key_count_ = 0;
};

}  // namespace myotact::net

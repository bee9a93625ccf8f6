#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "messages/scene_frame.h"
#include "net/wire.h"

namespace myotact::net {

/// Puts the frames of a scene together again. Memory is bounded by what a frame may hold, times kMostSkins.
class SceneDecoder {
 public:
  /// False: a frame that does not fit what came before it.
  bool take(const Frame& frame);
  /// After take(): the scene frame is whole.
  bool is_whole() const { return whole_; }
  const messages::SceneFrame& frame() const { return frame_; }

 private:
  struct KeySkin {
    std::uint32_t key = 0;
    std::vector<std::array<std::int32_t, 3>> places;  // on the grid
  };

  bool take_key(std::span<const std::uint8_t> payload);
  bool take_delta(std::span<const std::uint8_t> payload);
  bool take_poses(std::span<const std::uint8_t> payload);

  std::vector<KeySkin> keys_;
  messages::SceneFrame frame_;
  bool whole_ = false;
};

}  // namespace myotact::net

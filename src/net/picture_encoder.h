#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "messages/scene_frame.h"
#include "net/wire.h"

namespace myotact::net {

/// Skins of a Picture lie on a grid of this width: a tenth of what a pixel shows of a limb that fills a screen.
inline constexpr double kPictureGrid_m = 5e-5;

/// What a screen shows of one moment. Each viewer is sent what has changed since the picture that it was sent last,
/// whichever that was, so that a slow one misses pictures and nothing else.
struct ScenePicture {
  std::uint64_t sequence = 0;  // of the scene frame, 1 and up
  double time_s = 0.0;
  std::vector<std::vector<std::array<std::int32_t, 3>>> skins;  // on the grid, world
  std::vector<std::array<float, 12>> poses;                     // 3x4, by rows: from the specimen's files to the world
  std::shared_ptr<const Bytes> readings;  // payload of a Readings frame; the same one in several pictures
  Bytes in_force;                         // payload of an InForce frame
  std::uint64_t before = 0;               // the picture made before this one, 0: none
  Bytes since_before;                     // what is sent to who has seen that one: most viewers
};

/// The payload of a Picture frame for a viewer that was shown `seen` last (null: nothing yet).
Bytes picture_payload(const ScenePicture& picture, const ScenePicture* seen);

/// Makes one picture after the other. One thread.
class PictureEncoder {
 public:
  std::shared_ptr<const ScenePicture> encode(const messages::SceneFrame& frame);

 private:
  std::shared_ptr<const ScenePicture> last_;
  int until_readings_ = 0;  // pictures
};

}  // namespace myotact::net

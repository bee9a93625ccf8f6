#pragma once

#include <cstdint>
#include <span>

#include "messages/scene_frame.h"
#include "net/wire.h"

namespace myotact::net {

/// All numbers of a scene frame but skins and poses, at the end of `out`.
void encode_readings(const messages::SceneFrame& frame, Bytes& out);

/// The same numbers into `frame`. False: the payload does not hold what its counts say.
bool decode_readings(std::span<const std::uint8_t> payload, messages::SceneFrame& frame);

}  // namespace myotact::net

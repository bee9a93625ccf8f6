#pragma once

#include <cstdint>
#include <span>

#include "messages/control_state.h"
#include "net/wire.h"

namespace myotact::net {

/// Payload of an InForce frame, at the end of `out`.
void encode_control_state(const messages::ControlState& state, Bytes& out);

/// False: the payload holds something else, and `state` is left as it was.
bool decode_control_state(std::span<const std::uint8_t> payload, messages::ControlState& state);

}  // namespace myotact::net

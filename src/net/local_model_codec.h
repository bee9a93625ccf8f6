#pragma once

#include <cstdint>
#include <span>

#include "messages/local_model.h"
#include "net/wire.h"

namespace myotact::net {

/// The payload of a LocalModel frame, without loss, in place of what `out` held. `model` is as the simulation wrote it.
void encode(const messages::LocalModel& model, Bytes& out);

/// False: of another length than its counts say, counts or indices out of range, or numbers that are not finite.
/// Allocates nothing. haptics::is_sound() knows the rest of what a haptic loop asks of a model.
bool decode(std::span<const std::uint8_t> payload, messages::LocalModel& model) noexcept;

}  // namespace myotact::net

#pragma once

#include <cstdint>
#include <span>

#include "haptics/haptic_loop.h"

namespace myotact::haptics {

// The loops of the devices that one person holds, ticked one after the other at each deadline in one thread. They share
// nothing but the emergency stop: a stop button on one device, pressed in tick n, has taken the force from that one in
// tick n, from those after it in the same round and from those before it in the next. A fault of one device (lost, not
// a number, too fast) takes the force from that one alone: the other hand holds what it holds.

/// After the tick of a loop: passes its stop button on. Real-time safe; the thread that ticks.
void share_stop(const HapticLoop& ticked, std::span<HapticLoop* const> group) noexcept;

/// One round. Real-time safe; one thread.
void tick_all(std::span<HapticLoop* const> group, std::uint64_t now_ns) noexcept;

/// A person or a caller, any thread: force zero on all from the next tick on, or all armed again.
void stop_forces(std::span<HapticLoop* const> group, bool stopped) noexcept;

}  // namespace myotact::haptics

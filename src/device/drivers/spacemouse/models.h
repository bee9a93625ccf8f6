#pragma once

#include <cstdint>
#include <string_view>

#include "device/drivers/spacemouse/hid_port.h"

namespace myotact::device::spacemouse {

/// The model of a product of the maker's, by USB identity; empty: not a SpaceMouse (a mouse or keyboard of the same
/// maker, or somebody else's). Source: the lists of spacenavd and PySpaceMouse.
std::string_view model_of(std::uint16_t vendor, std::uint16_t product) noexcept;

/// Whether this interface is the cap of a SpaceMouse: receivers have several interfaces, one of which is a multi-axis
/// controller (usage page 1, usage 8).
bool is_cap(const HidEntry& entry) noexcept;

}  // namespace myotact::device::spacemouse

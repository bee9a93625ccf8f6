#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "device/drivers/falcon/transport.h"

namespace myotact::device::falcon {

/// The image that the Falcon's processor wants at each power-up. It is the maker's and never shipped with this program.
/// Throws Error Unavailable: not there, or not of its kind (size, first bytes).
std::vector<std::uint8_t> read_firmware(const std::filesystem::path& path);

enum class Upload { Done, NoAnswer, EchoDiffers, Gone };

/// Sets the chip to the speed and latency of a running firmware and empties its buffers. False: the device is gone.
bool enter_normal_mode(Transport& transport) noexcept;

/// Whether a firmware answers: one good report to at most `packets` commands without force.
bool firmware_runs(Transport& transport, int packets) noexcept;

/// Hands the image over, each block echoed and compared. Takes two to three seconds.
Upload upload(Transport& transport, std::span<const std::uint8_t> image);

/// Until the firmware runs: test, upload, test, at most ten times, as a first try fails often. Throws Error Unavailable
/// (what failed, and the remedy). `image` may be empty: then a device without running firmware is refused.
void start_firmware(Transport& transport, std::span<const std::uint8_t> image);

}  // namespace myotact::device::falcon

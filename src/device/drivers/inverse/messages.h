#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/vector.h"
#include "device/drivers/inverse/settings.h"

namespace myotact::device::inverse {

/// Texts of the Inverse Service: JSON, one inventory when a connection begins, then one state for each command.

/// What more is refused as broken. A state of two devices with grips is about 2 kB.
inline constexpr std::size_t kLongestMessage = 256 * 1024;  // bytes
inline constexpr std::size_t kMostDevices = 16;             // of each kind
inline constexpr std::size_t kLongestId = 32;               // letters, digits, '_', '-', ':' and '.'

/// One Inverse3 in a message. A number that the service leaves out is at its identity or unchanged.
struct DeviceEntry {
  std::string id;                                          // "049D"
  std::array<std::optional<double>, 3> position_service_m; /* nothing where it was left out: the reader keeps its last,
                                                              since a zero in its place would be a jump */
  Vec3 velocity_service_m_s = Vec3::Zero();                // zero where it was left out: no damping from an old one
};

/// One grip in a message, wireless or wired.
struct GripEntry {
  std::string id;
  std::uint32_t buttons = 0;  // bit 0: a or button_0, and so on; up where they are left out
};

struct ServiceMessage {
  std::vector<DeviceEntry> devices;
  std::vector<GripEntry> grips;  // wireless ones first
  std::string version;           // of the service, where the message reports it
};

/// What is wrong with the text, naming the place; empty: `message` holds it. Any bytes, never throws for them.
std::string read_message(std::string_view text, ServiceMessage& message);

struct ServiceVersion {
  int major = 0, minor = 0;
};
/// "3.1.1", "v3.5", "\"3.1.1\"" or {"version": "3.1.1"}; nothing for other texts.
std::optional<ServiceVersion> read_version(std::string_view text);

/// The form that a service wants; an unknown version is taken for a new one.
CommandForm form_for(const std::optional<ServiceVersion>& version);

/// Replaces `text` by the command of one force. `id` as read by read_message, the force finite, `form` not ByVersion.
void write_force_command(const std::string& id, const Vec3& force_service_N, CommandForm form, std::string& text);

}  // namespace myotact::device::inverse

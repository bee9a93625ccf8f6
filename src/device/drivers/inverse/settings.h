#pragma once

#include <cstdint>
#include <string>

#include "core/vector.h"
#include "device/device.h"

namespace myotact::device::inverse {

/// How a force command is written: {"values": {x, y, z}} in the format of service 3.1 (Haply's sample, Isaac Lab),
/// {"vector": {x, y, z}} in that of 3.5 (Haply's pages). Whether 3.5 still takes "values" and which of the two the
/// versions between want is uncertain: by default the service's version decides.
enum class CommandForm : std::uint8_t { ByVersion, Values, Vector };

/// What the Inverse3 supports. 10 N, 1000 N/m: what the CHAI3D port chai3d_haply sets, not the maker's data
/// (uncertain). Continuous force: not published; a third of the peak, until it is measured. Friction and inertia are
/// not known.
inline DeviceProfile inverse3_profile() {
  DeviceProfile profile;
  profile.peak_force_N = 10.0;
  profile.continuous_force_N = 3.3;
  profile.max_stiffness_N_m = 1000.0;
  profile.delay_ticks = 1;                   // the force goes out with the next exchange
  profile.workspace_m = {0.17, 0.17, 0.17};  // the cube in a sphere of 0.15 m, which the same port sets (uncertain)
  return profile;
}

struct InverseSettings {
  /// Where the Inverse Service listens on this machine; a numeric loopback address. Default of its pages.
  std::string address = "127.0.0.1";
  std::uint16_t port = 10001;
  /// Where services 3.0 and 3.1 report their version over HTTP (docs.haply.co, 3.0.2).
  std::uint16_t version_port = 10000;
  CommandForm form = CommandForm::ByVersion;
  /// The middle of the workspace in the service's frame, which starts at the face of the mounting plate: x to the
  /// right, y away from the person, z up [m]. From the offsets of chai3d_haply, whose signs are read, not measured
  /// (uncertain).
  Vec3 workspace_middle_service_m{0.0, -0.15, 0.20};
  DeviceProfile profile = inverse3_profile();
};

/// Between the service's frame and ours (hardware_device.h); both right-handed, derived from chai3d_haply's axes.
inline Vec3 device_from_service(const Vec3& v) {
  return {v.x(), v.z(), -v.y()};
}
inline Vec3 service_from_device(const Vec3& v) {
  return {v.x(), -v.z(), v.y()};
}

}  // namespace myotact::device::inverse

#pragma once

#include <string>

#include <fmt/format.h>

#include "core/vector.h"

namespace myotact::device::inverse {

/// A state message of one Inverse3 with a wireless grip, as the service's pages show it.
inline std::string state_text(const std::string& id, const Vec3& position_m, const Vec3& velocity_m_s = Vec3::Zero(),
                              const std::string& buttons = R"("a":false,"b":false,"c":false)") {
  return fmt::format(
      R"({{"session_id":7,"inverse3":[{{"device_id":"{}","state":{{)"
      R"("cursor_position":{{"x":{},"y":{},"z":{}}},"cursor_velocity":{{"x":{},"y":{},"z":{}}},)"
      R"("angular_position":{{"a0":1.5,"a1":20.25,"a2":-3}},"body_orientation":{{"w":1}},"control_mode":"idle",)"
      R"("transform":{{}}}},"status":{{}}}}],)"
      R"("wireless_verse_grip":[{{"device_id":"61","state":{{"orientation":{{"w":1}},"buttons":{{{}}}}}}}]}})",
      id, position_m.x(), position_m.y(), position_m.z(), velocity_m_s.x(), velocity_m_s.y(), velocity_m_s.z(),
      buttons);
}

}  // namespace myotact::device::inverse

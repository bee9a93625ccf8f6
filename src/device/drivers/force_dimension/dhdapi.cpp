#include "device/drivers/force_dimension/dhdapi.h"

#include <vector>

#include <fmt/format.h>

#include "core/error.h"

namespace myotact::device::force_dimension {

namespace {

constexpr int kKnownVersion = 3;

/// Libraries that initialise devices come first.
std::vector<std::string> names_of(const std::string& library) {
  if (!library.empty()) return {library};
  return {"libdrd.so.3", "libdhd.so.3", "libdrd.so", "libdhd.so"};
}

}  // namespace

Dhdapi::Dhdapi(const std::string& path) : library("libdhd of the Force Dimension SDK", names_of(path)) {
  library.bind("dhdGetDeviceCount", device_count);
  library.bind("dhdOpenID", open_id);
  library.bind("dhdClose", close);
  library.bind("dhdGetSystemType", system_type);
  library.bind("dhdGetSerialNumber", serial_number);
  library.bind("dhdEnableForce", enable_force);
  library.bind("dhdSetGravityCompensation", set_gravity_compensation);
  library.bind("dhdSetBrakes", set_brakes);
  library.bind("dhdGetPosition", get_position);
  library.bind("dhdGetLinearVelocity", get_velocity);
  library.bind("dhdSetForce", set_force);
  library.bind("dhdGetButtonMask", button_mask);
  library.bind("dhdGetMaxForce", max_force);
  library.bind("dhdGetStatus", get_status);
  library.bind("dhdErrorGetLastStr", last_error);
  library.bind("dhdGetSDKVersion", sdk_version);
  library.bind_if_there("dhdEmulateButton", emulate_button);
  library.bind_if_there("drdOpenID", drd_open_id);
  library.bind_if_there("drdClose", drd_close);
  library.bind_if_there("drdStop", drd_stop);
  library.bind_if_there("drdIsInitialized", is_initialised);
  library.bind_if_there("drdAutoInit", initialise);
  std::array<int, 4> version{};
  sdk_version(&version[0], &version[1], &version[2], &version[3]);
  if (version[0] == kKnownVersion) return;
  throw Error(ExitStatus::Unavailable,
              fmt::format("{} is version {}.{} of the Force Dimension SDK; version {} is needed", library.path(),
                          version[0], version[1], kKnownVersion));
}

std::string Dhdapi::error_text() const {
  const char* text = last_error();
  return text == nullptr || *text == '\0' ? "an error without a name" : text;
}

}  // namespace myotact::device::force_dimension

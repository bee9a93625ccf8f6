#pragma once

#include <array>
#include <string>

#include "device/drivers/vendor_library.h"

namespace myotact::device::force_dimension {

// The part of DHD (and of DRD, whose library has both) that is used, as exported on 64-bit Linux (SDK 3.17).
// Devices are opened by their place among those plugged in; every other call takes the ID that opening gave, last.
// Below zero: an error. 1: no newer data. 2: motors at their limit.

/// Places in the status that dhdGetStatus fills.
enum Status : std::size_t {
  kPower = 0,
  kConnected = 1,
  kInitialised = 3,  // its "reset": the device has found out where it is
  kForceIsOn = 5,
  kBrakes = 6,
  kForceOffCause = 14,
};
constexpr std::size_t kStatusLength = 32;  // the library fills 17; later ones may fill more

/// Why forces went off (kForceOffCause).
enum ForceOff : int { kNoCause = 0, kByButton, kByVelocity, kByWatchdog, kBySoftware, kByCable, kByDeadMan };

/// The functions of the library that was loaded; it stays loaded as long as this lives.
struct Dhdapi {
  /// Throws Error Unavailable: no library (each name tried), one without a function that is needed, another version.
  explicit Dhdapi(const std::string& library);

  VendorLibrary library;
  int (*device_count)();
  int (*open_id)(char place);  // the device's ID
  int (*close)(char);
  int (*system_type)(char);
  int (*serial_number)(unsigned short*, char);
  int (*enable_force)(unsigned char on, char);
  int (*set_gravity_compensation)(int on, char);
  int (*set_brakes)(int on, char);
  int (*get_position)(double* x, double* y, double* z, char);
  int (*get_velocity)(double* x, double* y, double* z, char);
  int (*set_force)(double x, double y, double z, char);
  unsigned int (*button_mask)(char);
  double (*max_force)(char);
  int (*get_status)(int*, char);
  const char* (*last_error)();
  void (*sdk_version)(int*, int*, int*, int*);
  int (*emulate_button)(unsigned char on, char);  // of the gripper; null in old libraries
  // Of DRD; null in DHD's own library.
  int (*drd_open_id)(char place);
  int (*drd_close)(char);
  int (*drd_stop)(bool leaves_forces_on, char);
  bool (*is_initialised)(char);
  int (*initialise)(char);

  /// Whether it can initialise a device's position and report whether that is done.
  bool has_drd() const { return drd_open_id && drd_close && drd_stop && is_initialised && initialise; }
  /// For DRD's calls, too, where there are any. The device's ID; below zero: an error.
  int open_device(int place) const {
    return has_drd() ? drd_open_id(static_cast<char>(place)) : open_id(static_cast<char>(place));
  }
  void close_device(char id) const { has_drd() ? drd_close(id) : close(id); }
  /// The library's last error in this thread; never empty.
  std::string error_text() const;
};

}  // namespace myotact::device::force_dimension

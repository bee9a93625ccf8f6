#pragma once

#include <array>
#include <string>

#include "device/drivers/vendor_library.h"

namespace myotact::device::force_dimension {

// The part of DHD (and of DRD, whose library has both) that is used, as exported on 64-bit Linux (reference: SDK 3.17).
// Every call about a device takes its number last. Below zero: an error. 1: no newer data. 2: motors at their limit.

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
  int (*open_id)(char);
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
  bool (*is_initialised)(char);                   // of DRD; null in DHD's own library
  int (*initialise)(char);                        // of DRD; null in DHD's own library

  /// The library's last error in this thread; never empty.
  std::string error_text() const;
};

}  // namespace myotact::device::force_dimension

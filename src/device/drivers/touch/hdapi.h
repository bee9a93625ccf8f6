#pragma once

#include <string>

#include "device/drivers/vendor_library.h"

namespace myotact::device::touch {

// The part of HDAPI that is used, as its library exports it on 64-bit Linux (HDAPI 3.0 and 3.4).

using Handle = unsigned int;
using Code = unsigned int;
constexpr Handle kNoDevice = 0xFFFFFFFF;

struct ErrorInfo {
  Code code = 0;
  int internal_code = 0;
  Handle device = 0;
};

using Callback = unsigned int (*)(void*);
constexpr unsigned int kCallbackDone = 0, kCallbackContinues = 1;
constexpr unsigned short kDefaultPriority = 32767;

enum Parameter : Code {
  kButtons = 0x2000,            // 1 int
  kInkwellSwitch = 0x2002,      // 1 boolean
  kPosition = 0x2050,           // 3 doubles, mm
  kVelocity = 0x2051,           // 3 doubles, mm/s
  kModel = 0x2501,              // string
  kSerial = 0x2504,             // string
  kUsableWorkspace = 0x2551,    // 6 doubles, mm: lowest, highest corner
  kNominalMaxForce = 0x2603,    // 1 double, N
  kNominalContinuous = 0x2604,  // 1 double, N
  kMotorTemperature = 0x2605,   // 3 or 6 doubles, 0 cold .. 1 warm
  kForce = 0x2700,              // 3 doubles, N
  kForceOutput = 0x4000,        // capability
  kCalibrated = 0x5000,
  kCalibrationNeedsUpdate = 0x5001,
  kCalibrationNeedsInput = 0x5002,
};
/// Calibration styles, of which a device has at least one.
constexpr Code kEncoderReset = 1, kAutomatic = 2, kInkwell = 4;

enum Fault : Code {
  kNone = 0x0000,
  kWarmMotors = 0x0200,
  kExceededForce = 0x0201,
  kForceImpulse = 0x0202,
  kExceededVelocity = 0x0203,
  kForceError = 0x0204,
  kDeviceFault = 0x0300,
  kAlreadyOpen = 0x0301,
  kCommunication = 0x0302,
  kCommunicationSettings = 0x0303,
  kTimer = 0x0304,
};
/// Errors of the call, not of the device: this version or model does not know what it was asked for.
constexpr bool is_of_call(Code error) {
  return (error & 0xff00u) == 0x0100u;
}

/// The functions of the library that was loaded; it stays loaded as long as this lives.
struct Hdapi {
  /// Throws Error Unavailable: no library (each name tried), or one without a function that is needed.
  explicit Hdapi(const std::string& library);

  VendorLibrary library;
  Handle (*init_device)(const char* configuration);
  void (*disable_device)(Handle);
  void (*make_current)(Handle);
  void (*begin_frame)(Handle);
  void (*end_frame)(Handle);
  ErrorInfo (*get_error)();
  const char* (*error_string)(Code);
  void (*enable)(Code);
  void (*get_booleanv)(Code, unsigned char*);
  void (*get_integerv)(Code, int*);
  void (*get_doublev)(Code, double*);
  const char* (*get_string)(Code);
  void (*set_doublev)(Code, const double*);
  Code (*check_calibration)();
  Code (*check_calibration_style)();
  void (*update_calibration)(Code style);
  void (*start_scheduler)();
  void (*stop_scheduler)();
  unsigned long (*schedule_asynchronous)(Callback, void*, unsigned short priority);
  void (*unschedule)(unsigned long);

  /// The newest error, and the stack emptied; kNone: there was none. While the servo loop runs, for its thread alone:
  /// another one would take what a frame has to know.
  Code take_error() const noexcept;
  /// In words and as the manual numbers it.
  std::string text_of(Code error) const;
};

}  // namespace myotact::device::touch

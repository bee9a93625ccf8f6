#include "device/drivers/touch/hdapi.h"

#include <vector>

#include <fmt/format.h>

namespace myotact::device::touch {

namespace {

/// The maker's installer leaves the first two; older ones the last.
std::vector<std::string> names_of(const std::string& library) {
  if (!library.empty()) return {library};
  return {"libHD.so.3.4", "libHD.so", "libHD.so.3.0"};
}

}  // namespace

Hdapi::Hdapi(const std::string& path) : library("libHD of OpenHaptics", names_of(path)) {
  library.bind("hdInitDevice", init_device);
  library.bind("hdDisableDevice", disable_device);
  library.bind("hdMakeCurrentDevice", make_current);
  library.bind("hdBeginFrame", begin_frame);
  library.bind("hdEndFrame", end_frame);
  library.bind("hdGetError", get_error);
  library.bind("hdGetErrorString", error_string);
  library.bind("hdEnable", enable);
  library.bind("hdGetBooleanv", get_booleanv);
  library.bind("hdGetIntegerv", get_integerv);
  library.bind("hdGetDoublev", get_doublev);
  library.bind("hdGetString", get_string);
  library.bind("hdSetDoublev", set_doublev);
  library.bind("hdCheckCalibration", check_calibration);
  library.bind("hdCheckCalibrationStyle", check_calibration_style);
  library.bind("hdUpdateCalibration", update_calibration);
  library.bind("hdStartScheduler", start_scheduler);
  library.bind("hdStopScheduler", stop_scheduler);
  library.bind("hdScheduleAsynchronous", schedule_asynchronous);
  library.bind("hdUnschedule", unschedule);
}

Code Hdapi::take_error() const noexcept {
  constexpr int kDeepestStack = 64;  // a library that never returns "none" must not block the tick
  Code newest = kNone;
  for (int i = 0; i < kDeepestStack; ++i) {
    const Code code = get_error().code;
    if (code == kNone) break;
    if (newest == kNone) newest = code;
  }
  return newest;
}

std::string Hdapi::text_of(Code error) const {
  const char* text = error_string(error);
  return fmt::format("{} ({:#06x})", text == nullptr || *text == '\0' ? "error" : text, error);
}

}  // namespace myotact::device::touch

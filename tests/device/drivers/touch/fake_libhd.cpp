// A libHD of the tests': two devices, a servo loop that the test ticks or that runs by itself, errors on cue. Written
// from the documented signatures; behaviour as documented where it matters to a driver. Built twice, once without a
// function.

#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <thread>

#include <unistd.h>

namespace {

struct ErrorInfo {
  unsigned int code;
  int internal_code;
  unsigned int device;
};

using Callback = unsigned int (*)(void*);

struct Device {
  bool is_open = false, in_frame = false;
  unsigned int calibration = 0x5000, style = 4;
  int updates = 0, buttons = 0;
  std::array<double, 3> position_mm{}, velocity_mm_s{}, force_N{}, sent_N{};
  double warmth = 0.0;
  long frames = 0;
};

std::recursive_mutex mutex;
std::array<Device, 2> devices;
unsigned int current = 0;
std::array<unsigned int, 64> errors;
std::size_t error_count = 0;
unsigned int init_error = 0, scheduler_error = 0;
long misuses = 0;
int opened = 0;
double max_force_N = 3.3;
Callback callback = nullptr;
void* user_data = nullptr;
std::atomic<bool> runs{false};
bool is_manual = false;
std::thread thread;

void push(unsigned int code) {
  if (error_count < errors.size()) errors[error_count++] = code;
}

/// While the file of that name is there: for programs that a test cannot call into.
bool is_unplugged() {
  const char* file = std::getenv("FAKE_HD_UNPLUGGED");
  return file != nullptr && access(file, F_OK) == 0;
}

void tick() {
  const std::lock_guard lock(mutex);
  if (callback != nullptr && runs) callback(user_data);
  for (Device& device : devices) misuses += device.in_frame ? 1 : 0;
}

void copy(const std::array<double, 3>& from, double* to) {
  std::memcpy(to, from.data(), sizeof from);
}

}  // namespace

extern "C" {

// ---- HDAPI

unsigned int hdInitDevice(const char* name) {
  const std::lock_guard lock(mutex);
  if (init_error != 0 || is_unplugged()) {
    push(init_error != 0 ? init_error : 0x0302);
    return 0xFFFFFFFF;
  }
  const unsigned int handle = name != nullptr && std::strcmp(name, "Left Device") == 0 ? 1 : 0;
  if (devices[handle].is_open) {
    push(0x0301);
    return 0xFFFFFFFF;
  }
  devices[handle].is_open = true;
  ++opened;
  return current = handle;
}
void hdDisableDevice(unsigned int handle) {
  const std::lock_guard lock(mutex);
  if (handle < 2) devices[handle].is_open = false;
}
void hdMakeCurrentDevice(unsigned int handle) {
  if (handle < 2) current = handle;
}
void hdBeginFrame(unsigned int handle) {
  current = handle;
  Device& device = devices[handle];
  misuses += device.in_frame || !device.is_open ? 1 : 0;
  device.in_frame = true;
  device.force_N = {};
  if (is_unplugged()) push(0x0302);
}
#ifndef WITHOUT_END_FRAME
void hdEndFrame(unsigned int handle) {
  Device& device = devices[handle];
  misuses += device.in_frame ? 0 : 1;
  device.in_frame = false;
  device.sent_N = device.force_N;
  ++device.frames;
}
#endif
ErrorInfo hdGetError() {
  if (error_count == 0) return {0, 0, current};
  return {errors[--error_count], 0, current};
}
const char* hdGetErrorString(unsigned int code) {
  return code == 0x0301 ? "Device already initiated" : code == 0x0302 ? "Communication error" : "Some error";
}
void hdEnable(unsigned int capability) {
  misuses += capability == 0x4000 ? 0 : 1;
}
void hdGetBooleanv(unsigned int, unsigned char* value) {
  *value = 0;
}
void hdGetIntegerv(unsigned int parameter, int* value) {
  if (parameter == 0x2000) *value = devices[current].buttons;
}
void hdGetDoublev(unsigned int parameter, double* value) {
  const Device& device = devices[current];
  const std::array<double, 6> reach_mm = {-200.0, -100.0, -100.0, 200.0, 200.0, 60.0};
  switch (parameter) {
    case 0x2050:
      return copy(device.position_mm, value);
    case 0x2051:
      return copy(device.velocity_mm_s, value);
    case 0x2551:
      std::memcpy(value, reach_mm.data(), sizeof reach_mm);
      return;
    case 0x2603:
      *value = max_force_N;
      return;
    case 0x2604:
      *value = 0.88;
      return;
    case 0x2605:
      if (device.warmth < 0.0) return push(0x0100);  // a model that does not tell
      for (int k = 0; k < 6; ++k) value[k] = k == 1 ? device.warmth : 0.0;
      return;
    default:
      push(0x0100);
  }
}
const char* hdGetString(unsigned int parameter) {
  return parameter == 0x2501 ? "Touch" : "SN123";
}
void hdSetDoublev(unsigned int parameter, const double* value) {
  Device& device = devices[current];
  misuses += parameter == 0x2700 && device.in_frame ? 0 : 1;
  std::memcpy(device.force_N.data(), value, sizeof device.force_N);
}
unsigned int hdCheckCalibration() {
  return devices[current].calibration;
}
unsigned int hdCheckCalibrationStyle() {
  return devices[current].style;
}
void hdUpdateCalibration(unsigned int style) {
  Device& device = devices[current];
  misuses += (style & device.style) != 0 ? 0 : 1;
  ++device.updates;
  device.calibration = 0x5000;
}
void hdStartScheduler() {
  const std::lock_guard lock(mutex);
  if (scheduler_error != 0) return push(scheduler_error);
  runs = true;
  if (is_manual) return;
  thread = std::thread([] {
    while (runs) {
      tick();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
}
void hdStopScheduler() {
  runs = false;
  if (thread.joinable()) thread.join();
}
unsigned long hdScheduleAsynchronous(Callback function, void* data, unsigned short) {
  const std::lock_guard lock(mutex);
  callback = function;
  user_data = data;
  return 7;
}
void hdUnschedule(unsigned long handle) {
  const std::lock_guard lock(mutex);
  misuses += handle == 7 && !runs ? 0 : 1;
  callback = nullptr;
}

// ---- for the test

void fake_hd_reset(bool manual) {
  hdStopScheduler();
  const std::lock_guard lock(mutex);
  devices = {};
  error_count = 0;
  init_error = scheduler_error = 0;
  misuses = 0;
  opened = 0;
  max_force_N = 3.3;
  callback = nullptr;
  is_manual = manual;
}
void fake_hd_tick() {
  tick();
}
void fake_hd_push_error(unsigned int code) {
  const std::lock_guard lock(mutex);
  push(code);
}
void fake_hd_fail(unsigned int at_init, unsigned int at_scheduler) {
  init_error = at_init;
  scheduler_error = at_scheduler;
}
void fake_hd_pose(unsigned int device, double x, double y, double z, int buttons) {
  const std::lock_guard lock(mutex);
  devices[device].position_mm = {x, y, z};
  devices[device].buttons = buttons;
}
void fake_hd_calibration(unsigned int device, unsigned int state, unsigned int style) {
  const std::lock_guard lock(mutex);
  devices[device].calibration = state;
  devices[device].style = style;
}
void fake_hd_warmth(unsigned int device, double warmth) {
  const std::lock_guard lock(mutex);
  devices[device].warmth = warmth;
}
void fake_hd_max_force(double newtons) {
  max_force_N = newtons;
}
/// Of the last whole frame [N].
void fake_hd_sent(unsigned int device, double* force_N) {
  const std::lock_guard lock(mutex);
  copy(devices[device].sent_N, force_N);
}
long fake_hd_frames(unsigned int device) {
  const std::lock_guard lock(mutex);
  return devices[device].frames;
}
int fake_hd_updates(unsigned int device) {
  return devices[device].updates;
}
/// Calls that HDAPI forbids, so far.
long fake_hd_misuses() {
  return misuses;
}
int fake_hd_opened() {
  return opened;
}
}

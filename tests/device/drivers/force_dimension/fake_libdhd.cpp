// A libdrd of the tests': two devices, errors and status on cue. Written from the documented signatures. Built again
// without a function, as an older version, and as a libdhd that cannot initialise.

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>

namespace {

struct Device {
  bool is_open = false, is_plugged = true, is_initialised = true, forces_on = false, brakes = true, emulates = false;
  bool is_powered = true, fails = false, is_drd = false, is_regulated = false;
  int gravity = 0, cause = 0, force_result = 0;
  std::array<double, 3> position_m{}, velocity_m_s{}, force_N{};
  unsigned int buttons = 0;
  double max_force_N = 10.0;
  long forces = 0, enables = 0, initialisations = 0;
  double greatest_N2 = 0.0;
};

std::mutex mutex;
std::array<Device, 2> devices;
int count = 2;
int open_result = 0;
int serial = 1000;

constexpr char kFirstId = 5;  // not a device's place: a driver that takes the one for the other fails

Device* open_device(char id) {
  const auto number = static_cast<std::size_t>(id - kFirstId);
  if (number >= devices.size() || !devices[number].is_open) return nullptr;
  return &devices[number];
}

bool answers(const Device* device) {
  return device != nullptr && device->is_plugged && !device->fails;
}

void put(const std::array<double, 3>& v, double* x, double* y, double* z) {
  *x = v[0];
  *y = v[1];
  *z = v[2];
}

int open(char place) {
  const std::lock_guard lock(mutex);
  if (open_result < 0) return open_result;
  const auto number = static_cast<std::size_t>(place);
  if (number >= devices.size() || !devices[number].is_plugged || devices[number].is_open) return -1;
  devices[number].is_open = true;
  return place + kFirstId;
}

int close(char id) {
  const std::lock_guard lock(mutex);
  Device* device = open_device(id);
  if (device == nullptr) return -1;
  device->is_open = device->forces_on = false;
  return 0;
}

}  // namespace

extern "C" {

// ---- DHD

int dhdGetDeviceCount() {
  return count;
}
int dhdOpenID(char place) {
  return open(place);
}
int dhdClose(char id) {
  return close(id);
}
int dhdGetSystemType(char id) {
  return id == kFirstId ? 33 : 104;
}
int dhdGetSerialNumber(unsigned short* number, char id) {
  const std::lock_guard lock(mutex);
  *number = static_cast<unsigned short>(serial + id - kFirstId);
  return 0;
}
int dhdEnableForce(unsigned char on, char id) {
  const std::lock_guard lock(mutex);
  Device* device = open_device(id);
  if (!answers(device)) return -1;
  device->forces_on = on != 0;
  device->cause = 0;
  device->enables += on != 0 ? 1 : 0;
  return 0;
}
int dhdSetGravityCompensation(int on, char id) {
  const std::lock_guard lock(mutex);
  if (Device* device = open_device(id)) device->gravity = on;
  return 0;
}
int dhdSetBrakes(int on, char id) {
  const std::lock_guard lock(mutex);
  if (Device* device = open_device(id)) device->brakes = on != 0;
  return 0;
}
int dhdGetPosition(double* x, double* y, double* z, char id) {
  const std::lock_guard lock(mutex);
  const Device* device = open_device(id);
  if (!answers(device)) return -1;
  put(device->position_m, x, y, z);
  return 1;  // no newer data since the last call: no error
}
int dhdGetLinearVelocity(double* x, double* y, double* z, char id) {
  const std::lock_guard lock(mutex);
  const Device* device = open_device(id);
  if (!answers(device)) return -1;
  put(device->velocity_m_s, x, y, z);
  return 0;
}
#ifndef WITHOUT_SET_FORCE
int dhdSetForce(double x, double y, double z, char id) {
  const std::lock_guard lock(mutex);
  Device* device = open_device(id);
  if (!answers(device) || device->is_regulated) return -1;
  if (device->force_result < 0) return device->force_result;  // the motors keep what they had
  device->force_N = {x, y, z};
  device->greatest_N2 = std::max(device->greatest_N2, x * x + y * y + z * z);
  ++device->forces;
  return device->force_result;
}
#endif
unsigned int dhdGetButtonMask(char id) {
  const std::lock_guard lock(mutex);
  const Device* device = open_device(id);
  return device == nullptr ? 0 : device->buttons;
}
double dhdGetMaxForce(char id) {
  const std::lock_guard lock(mutex);
  const Device* device = open_device(id);
  return device == nullptr ? -1.0 : device->max_force_N;
}
int dhdGetStatus(int* status, char id) {
  const std::lock_guard lock(mutex);
  const Device* device = open_device(id);
  if (device == nullptr) return -1;
  std::memset(status, 0, 17 * sizeof(int));
  status[0] = device->is_powered ? 1 : 0;
  status[1] = device->is_plugged ? 1 : 0;
  status[3] = device->is_initialised ? 1 : 0;
  status[5] = device->forces_on ? 1 : 0;
  status[6] = device->brakes ? 1 : 0;
  status[14] = device->cause;
  return 0;
}
const char* dhdErrorGetLastStr() {
  return "device already in use";
}
void dhdGetSDKVersion(int* major, int* minor, int* release, int* revision) {
#ifdef OLD_VERSION
  *major = 2;
#else
  *major = 3;
#endif
  *minor = 17;
  *release = *revision = 0;
}
#ifndef WITHOUT_DRD
int dhdEmulateButton(unsigned char on, char id) {
  const std::lock_guard lock(mutex);
  if (Device* device = open_device(id)) device->emulates = on != 0;
  return 0;
}
int drdOpenID(char place) {
  const int id = open(place);
  const std::lock_guard lock(mutex);
  if (Device* device = id < 0 ? nullptr : open_device(static_cast<char>(id))) device->is_drd = true;
  return id;
}
int drdClose(char id) {
  return close(id);
}
bool drdIsInitialized(char id) {
  const std::lock_guard lock(mutex);
  const Device* device = open_device(id);
  return device != nullptr && device->is_drd && device->is_initialised;
}
int drdStop(bool, char id) {
  const std::lock_guard lock(mutex);
  if (Device* device = open_device(id)) device->is_regulated = false;
  return 0;
}
int drdAutoInit(char id) {
  const std::lock_guard lock(mutex);
  Device* device = open_device(id);
  if (device == nullptr || !device->is_drd) return -1;
  device->is_initialised = device->is_regulated = true;
  ++device->initialisations;
  return 0;
}
#endif

// ---- for the test

void fake_dhd_reset() {
  const std::lock_guard lock(mutex);
  devices = {};
  count = 2;
  open_result = 0;
  serial = 1000;
}
void fake_dhd_count(int plugged, int result_of_open) {
  const std::lock_guard lock(mutex);
  count = plugged;
  open_result = result_of_open;
}
void fake_dhd_pose(int device, const double* position_m, const double* velocity_m_s, unsigned int buttons) {
  const std::lock_guard lock(mutex);
  std::memcpy(devices[static_cast<std::size_t>(device)].position_m.data(), position_m, 3 * sizeof(double));
  std::memcpy(devices[static_cast<std::size_t>(device)].velocity_m_s.data(), velocity_m_s, 3 * sizeof(double));
  devices[static_cast<std::size_t>(device)].buttons = buttons;
}
void fake_dhd_plug(int device, bool is_plugged, bool is_powered, bool is_initialised) {
  const std::lock_guard lock(mutex);
  Device& changed = devices[static_cast<std::size_t>(device)];
  changed.is_plugged = is_plugged;
  changed.is_powered = is_powered;
  changed.is_initialised = is_initialised;
}
void fake_dhd_fail(int device, bool fails, int force_result) {
  const std::lock_guard lock(mutex);
  devices[static_cast<std::size_t>(device)].fails = fails;
  devices[static_cast<std::size_t>(device)].force_result = force_result;
}
/// Other devices are plugged in from now on.
void fake_dhd_serial(int first) {
  const std::lock_guard lock(mutex);
  serial = first;
}
/// The motors go off by this cause.
void fake_dhd_force_off(int device, int cause) {
  const std::lock_guard lock(mutex);
  devices[static_cast<std::size_t>(device)].forces_on = false;
  devices[static_cast<std::size_t>(device)].cause = cause;
}
/// What was commanded last [N], and how often; as the motors have it: nothing where they are off.
long fake_dhd_force(int device, double* force_N) {
  const std::lock_guard lock(mutex);
  const Device& asked = devices[static_cast<std::size_t>(device)];
  std::memcpy(force_N, asked.force_N.data(), 3 * sizeof(double));
  return asked.forces;
}
/// 0 forces on, 1 brakes, 2 gravity, 3 emulates, 4 initialisations, 5 times enabled, 6 is open.
long fake_dhd_is(int device, int what) {
  const std::lock_guard lock(mutex);
  const Device& asked = devices[static_cast<std::size_t>(device)];
  const std::array<long, 7> all = {asked.forces_on,       asked.brakes,  asked.gravity, asked.emulates,
                                   asked.initialisations, asked.enables, asked.is_open};
  return all[static_cast<std::size_t>(what)];
}
}

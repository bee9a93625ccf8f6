#include <iostream>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "app/device_check.h"
#include "app/guarded_motors.h"
#include "app/interruption.h"
#include "app/options.h"
#include "core/error.h"
#include "device/profile_file.h"
#include "device/simulated_device.h"

namespace myotact::app {

namespace {

struct KnownDevice {
  const char* name;
  const char* what;
};

// Every device of this version works without hardware; drivers are added here with what they see.
constexpr KnownDevice kDevices[] = {
    {"simulated", "a simulated hand on a simulated 3-axis device, follows the scene's script"},
    {"mouse", "the mouse moves the stylus in the window; forces are shown, not felt"},
};

int test_device(const std::string& name) {
  GuardedMotors guarded;  // first: the watchdog is forked off before there are threads
  watch_for_interruption();
  if (name != "simulated" && !name.starts_with("simulated:")) {
    throw Error(ExitStatus::Unavailable,
                "--test " + name + ": there is no such device; \"myotact devices\" lists those that can be tested");
  }
  device::SimulatedDevice device(name, Vec3::Zero(), device::simulated_profile(name));
  device.drive(guarded.motors[0]);
  LineInput answers(STDIN_FILENO);
  const bool is_right = check_device(device, &guarded.watchdog, answers, std::cout);
  return interruption() != 0 ? interruption() : (is_right ? 0 : 1);
}

}  // namespace

int devices(const Options& options) {
  if (options.test_device) return test_device(*options.test_device);
  nlohmann::json list = nlohmann::json::array();
  for (const KnownDevice& device : kDevices) {
    list.push_back({{"name", device.name}, {"what", device.what}, {"available", true}});
    if (!options.json) std::cout << device.name << "\tready\t" << device.what << '\n';
  }
  if (options.json) std::cout << list.dump(2) << '\n';
  std::cout << std::flush;
  return 0;
}

}  // namespace myotact::app

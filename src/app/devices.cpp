#include <iostream>

#include <nlohmann/json.hpp>

#include "app/options.h"

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

}  // namespace

int devices(const Options& options) {
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

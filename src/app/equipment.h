#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/options.h"
#include "device/drivers/driver_table.h"
#include "device/placed_device.h"

namespace myotact::app {

/// The device file with the --set options of devices. Throws Error BadData.
device::DeviceSettings device_settings_of(const Options& options);

/// The device of that name, closed. Throws Error Unavailable: not known, or why it cannot be opened and what to do.
std::unique_ptr<device::HardwareDevice> make_device(const device::DeviceSettings& settings, const std::string& name);

/// For a command that no hand on a device takes part in: throws Error Usage with `why` where --device names one.
void refuse_equipment(const Options& options, std::string_view why);

/// The devices on the table that --device names: opened once, kept over all scenes of a program, closed at its end.
class Equipment {
 public:
  /// Opens them, which takes seconds. Throws Error: Unavailable with cause and remedy, Usage for one named twice.
  explicit Equipment(const Options& options);
  ~Equipment();
  Equipment(const Equipment&) = delete;
  Equipment& operator=(const Equipment&) = delete;

  bool empty() const { return devices_.empty(); }
  const std::map<std::string, std::unique_ptr<device::HardwareDevice>>& devices() const { return devices_; }
  bool has(const std::string& name) const { return devices_.contains(name); }
  device::HardwareDevice& device(const std::string& name) const { return *devices_.at(name); }
  /// How it stands on the table: columns are its right, up and towards axes in the person's.
  Mat3 rotation(const std::string& name) const;
  /// One of them in the world of this scene: the middle of its workspace where the tool's hand begins, its right, up
  /// and towards the person as in the lateral view, and as the settings place it. Not longer than this.
  std::unique_ptr<device::PlacedDevice> place(const std::string& name, const scene::Scene& scene,
                                              std::size_t tool) const;

 private:
  device::DeviceSettings settings_;
  std::map<std::string, std::unique_ptr<device::HardwareDevice>> devices_;
};

/// What the devices want of a person, in the log, for programs without a window.
class HintLog {
 public:
  explicit HintLog(const Equipment& equipment) : equipment_(equipment) {}  // outlives this
  /// Logs each new hint once.
  void look();

 private:
  const Equipment& equipment_;
  std::map<std::string, std::string> told_;
};

}  // namespace myotact::app

#include "app/equipment.h"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "core/error.h"
#include "core/text.h"
#include "scene/conductor.h"

namespace myotact::app {

namespace {

constexpr double kRadians = 3.14159265358979323846 / 180.0;

/// Columns: the picture's right, up and towards the eye in the lateral view (world: x cranial, y left, z up).
Mat3 world_from_lateral_view(bool left_limb) {
  const double way = left_limb ? 1.0 : -1.0;
  Mat3 rotation;
  rotation << Vec3(-way, 0.0, 0.0), Vec3(0.0, 0.0, 1.0), Vec3(0.0, way, 0.0);
  return rotation;
}

Mat3 rotation_of(const Vec3& angles_deg) {
  const Vec3 angles_rad = kRadians * angles_deg;
  return (Eigen::AngleAxisd(angles_rad.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(angles_rad.y(), Vec3::UnitY()) *
          Eigen::AngleAxisd(angles_rad.x(), Vec3::UnitX()))
      .toRotationMatrix();
}

device::TablePlacement placement_of(const device::DeviceSettings& settings, const std::string& name) {
  const auto own = settings.placements.find(name);
  return own == settings.placements.end() ? device::TablePlacement{} : own->second;
}

std::vector<NamedDevice> devices_on_the_table(const Options& options) {
  std::vector<NamedDevice> named = named_devices(options);
  std::erase_if(named, [](const NamedDevice& device) { return !device::is_on_the_table(device.name); });
  return named;
}

}  // namespace

device::DeviceSettings device_settings_of(const Options& options) {
  Overrides overrides;
  for (const auto& [key, value] : overrides_of(options)) {
    if (device::is_device_setting(key)) overrides[key] = value;
  }
  return device::read_device_settings(device::device_settings_file(), overrides);
}

std::unique_ptr<device::HardwareDevice> make_device(const device::DeviceSettings& settings, const std::string& name) {
  for (const auto& driver : device::make_drivers(settings)) {
    if (name.substr(0, name.find(':')) == driver->name()) return driver->make(name);
  }
  const auto& known = device::driver_names();
  throw Error(ExitStatus::Unavailable, fmt::format("there is no device \"{}\"; known: {} (nearest: {})", name,
                                                   join(known), nearest_word(name, known)));
}

void refuse_equipment(const Options& options, std::string_view why) {
  const std::vector<NamedDevice> named = devices_on_the_table(options);
  if (named.empty()) return;
  throw Error(ExitStatus::Usage, fmt::format("--device {}: {}", named.front().name, why));
}

Equipment::Equipment(const Options& options) {
  const std::vector<NamedDevice> named = devices_on_the_table(options);
  if (named.empty()) return;
  settings_ = device_settings_of(options);
  for (const NamedDevice& device : named) {
    if (has(device.name)) {
      throw Error(ExitStatus::Usage, fmt::format("--device: {0} is named twice; the second device of its kind is "
                                                 "{0}:2, as \"myotact devices\" lists it",
                                                 device.name));
    }
    auto made = make_device(settings_, device.name);
    made->open();
    devices_.emplace(device.name, std::move(made));
  }
}

Equipment::~Equipment() {
  for (const auto& [name, device] : devices_) device->close();
}

Mat3 Equipment::rotation(const std::string& name) const {
  return rotation_of(placement_of(settings_, name).turn_deg);
}

std::unique_ptr<device::PlacedDevice> Equipment::place(const std::string& name, const scene::Scene& scene,
                                                       std::size_t tool) const {
  const device::TablePlacement on_table = placement_of(settings_, name);
  device::Placement placement;
  placement.world_from_device = world_from_lateral_view(scene.specimen.side != "right") * rotation(name);
  placement.middle_world_m = scene::start_of_hand(scene, tool);
  placement.scale = on_table.scale;
  placement.bubble_radius_m = on_table.bubble_radius_m;
  return std::make_unique<device::PlacedDevice>(device(name), placement);
}

void HintLog::look() {
  for (const auto& [name, device] : equipment_.devices()) {
    const std::string hint = device->report().hint;
    if (std::exchange(told_[name], hint) != hint && !hint.empty()) spdlog::warn("{}: {}", name, hint);
  }
}

}  // namespace myotact::app

#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "app/equipment.h"
#include "app/guarded_motors.h"
#include "device/mouse_device.h"
#include "device/placed_device.h"
#include "device/simulated_device.h"
#include "scene/free_session.h"
#include "view/panels/panel.h"

namespace myotact::app {

/// The devices of a scene's tools, one a tool: the mouse, one on the table, or a simulated one that the script moves.
class Hands {
 public:
  /// `led`: the tool that the mouse moves; none: as many as there are tools. `guarded` and `equipment` outlive this.
  /// Throws Error Unavailable.
  Hands(const scene::Scene& scene, std::size_t led, GuardedMotors& guarded, const Equipment& equipment);

  const std::vector<scene::ToolDevice>& devices() const { return devices_; }
  std::vector<device::DeviceProfile> profiles() const;
  device::MouseDevice& mouse() { return mouse_; }
  std::size_t led() const { return led_; }
  /// What the window shows of those on the table. `scene`: the one that these are for.
  std::vector<view::DeviceNews> news(const scene::Scene& scene) const;
  /// Of those on the table, as if held on the device itself.
  void ask_clutch(bool held) const;
  /// Of those on the table: their right, up and towards the person are the picture's from now on.
  void follow_view(const std::array<std::array<double, 3>, 3>& axes_world) const;
  /// Who ticks and watches over them: the servo clock of those on the table, which one has; the watchdog of those
  /// simulated.
  scene::Ticking ticking() const;

 private:
  std::size_t led_;
  GuardedMotors& guarded_;
  device::MouseDevice mouse_;
  std::vector<std::unique_ptr<device::SimulatedDevice>> simulated_;
  struct Placed {
    device::HardwareDevice* device;
    std::unique_ptr<device::PlacedDevice> in_world;
    std::size_t tool;
    Mat3 picture_from_device;  // as it stands on the table
  };
  std::vector<Placed> placed_;
  std::vector<scene::ToolDevice> devices_;
};

/// Takes out of the script what moves the hands of people: of the tool `led` and of those with a device on the table.
void leave_hands_to_people(scene::Scene& scene, std::size_t led);

/// Whether a person's hand holds this tool.
bool is_persons(const scene::Scene& scene, std::size_t tool, std::size_t led);

}  // namespace myotact::app

#include "app/hands.h"

#include <Eigen/Geometry>

#include "device/profile_file.h"

namespace myotact::app {

Hands::Hands(const scene::Scene& scene, std::size_t led, GuardedMotors& guarded, const Equipment& equipment)
    : led_(led), guarded_(guarded), mouse_(scene::start_of_hand(scene, led < scene.tools.size() ? led : 0)) {
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    const std::string& name = scene.tools[t].device;
    if (t == led) {
      devices_.push_back({&mouse_});
    } else if (equipment.has(name)) {
      placed_.push_back({&equipment.device(name), equipment.place(name, scene, t), t, equipment.rotation(name)});
      devices_.push_back({placed_.back().in_world.get()});
    } else {
      simulated_.push_back(std::make_unique<device::SimulatedDevice>(name, scene::start_of_hand(scene, t),
                                                                     device::simulated_profile(name)));
      simulated_.back()->drive(guarded.motors[t]);
      devices_.push_back({simulated_.back().get(), simulated_.back().get()});
    }
  }
}

std::vector<device::DeviceProfile> Hands::profiles() const {
  std::vector<device::DeviceProfile> profiles;
  for (const scene::ToolDevice& tool : devices_) profiles.push_back(tool.device->profile());
  return profiles;
}

std::vector<view::DeviceNews> Hands::news(const scene::Scene& scene) const {
  std::vector<view::DeviceNews> news;
  for (const Placed& placed : placed_) {
    news.push_back({placed.device->name(), scene.tools[placed.tool].hand == "left", placed.device->report(),
                    placed.in_world->is_clutched()});
  }
  return news;
}

scene::Ticking Hands::ticking() const {
  scene::Ticking ticking{simulated_.empty() ? nullptr : &guarded_.watchdog, nullptr};
  for (const Placed& placed : placed_) {
    if (ticking.servo == nullptr) ticking.servo = placed.device->servo_clock();
  }
  return ticking;
}

void Hands::ask_clutch(bool held) const {
  for (const Placed& placed : placed_) placed.in_world->ask_clutch(held);
}

void Hands::follow_view(const std::array<std::array<double, 3>, 3>& axes_world) const {
  Mat3 axes;
  for (int axis = 0; axis < 3; ++axis) axes.col(axis) = to_vec3(axes_world[static_cast<std::size_t>(axis)]);
  if (axes.isZero()) return;  // there is no picture yet
  // Normalized, since a picture's axes are floats.
  const Mat3 world_from_picture = Eigen::Quaterniond(axes).normalized().toRotationMatrix();
  for (const Placed& placed : placed_) placed.in_world->ask_rotation(world_from_picture * placed.picture_from_device);
}

bool is_persons(const scene::Scene& scene, std::size_t tool, std::size_t led) {
  return tool == led || device::is_on_the_table(scene.tools[tool].device);
}

void leave_hands_to_people(scene::Scene& scene, std::size_t led) {
  std::erase_if(scene.script, [&](const scene::ScriptAction& action) {
    return scene::moves_hand(action.what) && is_persons(scene, action.tool, led);
  });
}

}  // namespace myotact::app

#include "remote/scripted_device.h"

#include "device/profile_file.h"

namespace myotact::remote {

ScriptedDevice::ScriptedDevice(const scene::Scene& scene, std::size_t tool)
    : tool_(tool),
      limb_(scene.specimen, scene.settings),
      conductor_(scene, limb_),
      device_(scene.tools[tool].device, conductor_.hand(tool, 0.0).position_world_m,
              device::simulated_profile(scene.tools[tool].device)) {}

void ScriptedDevice::move_to(double time_s) {
  const scene::HandTarget hand = conductor_.hand(tool_, time_s);
  device_.set_hand_target({to_array(hand.position_world_m), {}, hand.buttons});
}

}  // namespace myotact::remote

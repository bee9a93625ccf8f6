#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "anatomy/specimen.h"
#include "device/device.h"
#include "scene/recording.h"
#include "scene/scene_file.h"

namespace myotact::scene {

/// What a recording must hold to be run again: seed, devices (one a tool), the scene's text and where its specimen is.
std::string recording_header(const Scene& scene, std::uint64_t seed,
                             const std::vector<device::DeviceProfile>& profiles);

/// What the recorded devices could support, one a tool; that of a simulated one where a recording does not say. Throws
/// Error BadData.
std::vector<device::DeviceProfile> devices_of_recording(const nlohmann::json& header,
                                                        const std::filesystem::path& file);

/// The scene that a recording's header describes. Throws Error BadData, also for a recording of a later version.
Scene scene_of_recording(const nlohmann::json& header, const std::filesystem::path& file, const Overrides& overrides);

/// Throws Error BadData unless every step has an entry for each muscle, joint and tool of the scene.
void require_fit(const Recording& recording, const Scene& scene, const std::filesystem::path& file);

}  // namespace myotact::scene

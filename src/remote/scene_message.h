#pragma once

#include <cstdint>
#include <string>

#include "scene/scene_file.h"

namespace myotact::remote {

/// What a server sends every client of its scene, as JSON: {"scene": {name, title, seed, text, specimen {name,
/// sha256}, muscles[], bones[], bodies[], joints[], tools[]}}; keys in the order in which frames number them.
std::string scene_message(const scene::Scene& scene, std::uint64_t seed);

/// The same scene from this machine's own files. Throws Error BadData for an invalid message, NoInput where the
/// specimen is missing, BadData where it is another than the server's.
scene::Scene scene_of_message(const std::string& message);

}  // namespace myotact::remote

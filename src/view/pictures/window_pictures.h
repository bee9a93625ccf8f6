#pragma once

#include <filesystem>
#include <string>

#include "view/render/scene_renderer.h"

namespace myotact::view {

// What is in the framebuffer is to be read before the buffers are swapped: afterwards it is undefined.

/// Throws Error InputOutput.
void save_framebuffer(const std::filesystem::path& path, const Viewport& box);

/// Into the person's own folder "pictures". Returns where, or what is wrong, as a sentence.
std::string save_picture_for_person(const std::string& scene_name, const Viewport& box);

}  // namespace myotact::view

#pragma once

#include <filesystem>

#include "core/json_reader.h"
#include "haptics/effects/texture_set.h"

namespace myotact::scene {

/// How one tissue feels, from a file (assets/textures/README.md).
struct TextureFile {
  messages::Tissue tissue = messages::Tissue::Muscle;
  haptics::TextureSet set;
};

/// Throws Error NoInput or BadData.
TextureFile read_texture(const std::filesystem::path& path);

/// Every tissue with its own file of assets/textures. Throws as above.
haptics::TextureSettings own_textures();

/// What the key `texture` of a tool asks for: true: own_textures(), false: none, a name in assets/textures or a path
/// (relative to the scene's file): that one on every tissue. Throws Error NoInput or BadData, naming the known ones.
haptics::TextureSettings textures_asked_for(const JsonValue& value);

}  // namespace myotact::scene

#pragma once

#include <filesystem>

#include "simulation/contact/contact_law.h"

namespace myotact::scene {

/// assets/tissue/fascia.json, what holds neighbouring muscles where a scene says so.
std::filesystem::path fascia_path();

/// Reads the properties of loose connective tissue. Throws Error NoInput or BadData naming file, place and range.
simulation::Fascia read_fascia(const std::filesystem::path& file);

}  // namespace myotact::scene

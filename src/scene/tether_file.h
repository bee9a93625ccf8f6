#pragma once

#include "core/json_reader.h"
#include "simulation/particle/tether.h"

namespace myotact::scene {

/// What the key `original` of a scene asks for (assets/scenes/README.md). Throws Error BadData.
simulation::TetherSettings read_tether(const JsonValue& value);

}  // namespace myotact::scene

#pragma once

#include <string>

#include "scene/free_session.h"

namespace myotact::remote {

/// Adds what one Control frame asks for to what was asked for so far; src/net/README.md lists the controls. Throws
/// Error BadData that names the place.
void add_control(const std::string& json, scene::Requests& requests);

}  // namespace myotact::remote

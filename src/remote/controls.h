#pragma once

#include <string>
#include <vector>

#include "scene/free_session.h"

namespace myotact::remote {

/// Adds what one Control frame asks for to what was asked for so far; src/net/README.md lists the controls. Throws
/// Error BadData that names the place.
void add_control(const std::string& json, scene::Requests& requests);

/// The Control frames that ask for what changed, stops aside: those have a frame of their own, which everybody may
/// send.
std::vector<std::string> controls_between(const scene::Requests& before, const scene::Requests& now);

}  // namespace myotact::remote

#pragma once

#include <optional>
#include <string>

#include "messages/command.h"

namespace myotact::remote {

/// What one Control frame asks for; src/net/README.md lists the controls. Nothing: the emergency stop, which goes
/// beside every queue. Throws Error BadData that names the place.
std::optional<messages::Order> order_of(const std::string& control);

/// The Control frame that asks for it; nothing for what only the scene's own machine is asked.
std::optional<std::string> control_of(const messages::Order& order);

}  // namespace myotact::remote

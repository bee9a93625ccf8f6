#pragma once

#include <optional>
#include <string>

#include "net/socket.h"
#include "net/token.h"

namespace myotact::app {

/// What members of a class open to join. The token stands in the fragment, which browsers keep to themselves. `role`:
/// "student" may be left out.
std::string class_link(const net::Endpoint& page, const std::optional<net::Token>& token, const std::string& role);

/// An address under which other machines reach one that listens at `bind`: `bind` itself, or where that means every
/// address the first of this machine's own that is no loopback.
std::string reachable_address(const std::string& bind);

/// A QR code (ISO/IEC 18004) for a terminal, two rows of it a line, light on dark as most terminals are; empty for a
/// text that is too long for one.
std::string qr_for_terminal(const std::string& text);

}  // namespace myotact::app

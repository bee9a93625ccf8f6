#pragma once

#include <optional>

#include "app/options.h"
#include "net/small_frames.h"
#include "net/socket.h"

namespace myotact::app {

/// The token in a variable of the environment, where no list of processes shows it. Throws Error Usage for an
/// invalid token.
std::optional<net::Token> token_of(const char* variable);

/// --connect. Throws Error Usage when it is missing.
net::Endpoint server_of(const Options& options);

/// The one that was typed, else MYOTACT_TOKEN, or no token at all. Throws Error Usage for an invalid one.
net::Token own_token(const Options& options);

}  // namespace myotact::app

#pragma once

#include <optional>

#include "net/small_frames.h"

namespace myotact::net {

/// Whom a server lets in.
struct AccessPolicy {
  std::optional<Token> token;             // admits a client; none: everybody who can reach the port
  std::optional<Token> instructor_token;  // admits one as instructor; none: whoever is admitted may be one
};

/// Reads the first frame of a client. Why it may not come in, or nothing.
std::optional<Bye> refusal_of(const Frame& first, const AccessPolicy& rules, Hello& hello);

}  // namespace myotact::net

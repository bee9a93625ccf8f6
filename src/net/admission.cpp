#include "net/admission.h"

#include <fmt/format.h>

namespace myotact::net {

std::optional<Bye> refusal_of(const Frame& first, const AccessPolicy& rules, Hello& hello) {
  if (first.header.type != FrameType::Hello || !decode(first.payload, hello)) {
    return Bye{ByeReason::BadFrame, "the first frame is to be a sound Hello"};
  }
  if (hello.version != kProtocolVersion) {
    return Bye{ByeReason::Version, fmt::format("this server speaks version {} of the protocol", kProtocolVersion)};
  }
  const bool teaches = rules.instructor_token && is_same(*rules.instructor_token, hello.token);
  if (rules.token && !teaches && !is_same(*rules.token, hello.token)) {
    return Bye{ByeReason::Token, "wrong token; the server printed the right one when it started"};
  }
  if (hello.role == Role::Instructor && rules.instructor_token && !teaches) {
    return Bye{ByeReason::Token, "wrong token for an instructor; join as a student or use the instructor's token"};
  }
  return std::nullopt;
}

}  // namespace myotact::net

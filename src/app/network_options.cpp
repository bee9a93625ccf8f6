#include "app/network_options.h"

#include <cstdlib>

#include <fmt/format.h>

#include "core/error.h"

namespace myotact::app {

namespace {

constexpr std::uint16_t kTcpPort = 7480;

/// `source`: for the message.
net::Token read_token(const char* source, const std::string& text) {
  const auto token = net::parse_token(text);
  if (token) return *token;
  throw Error(ExitStatus::Usage,
              fmt::format("{}: is no token; a token is 32 hexadecimal digits, as the server prints it", source));
}

}  // namespace

std::optional<net::Token> token_of(const char* variable) {
  const char* text = std::getenv(variable);
  if (text == nullptr || *text == '\0') return std::nullopt;
  return read_token(variable, text);
}

net::Endpoint server_of(const Options& options) {
  if (!options.connect) {
    throw Error(ExitStatus::Usage, "--connect HOST:PORT is missing: the machine on which `myotact serve` runs");
  }
  return net::parse_endpoint(*options.connect, kTcpPort);
}

net::Token own_token(const Options& options) {
  if (!options.token.empty()) return read_token("token", options.token);
  return token_of("MYOTACT_TOKEN").value_or(net::Token{});
}

}  // namespace myotact::app

#include "net/token.h"

#include <charconv>

#include <fmt/format.h>
#include <sys/random.h>

#include "core/error.h"

namespace myotact::net {

Token new_token() {
  Token token{};
  if (getrandom(token.data(), token.size(), 0) != static_cast<ssize_t>(token.size())) {
    throw Error(ExitStatus::Unavailable, "the system gives no random bits; without a token no other machine may join");
  }
  return token;
}

std::string to_text(const Token& token) {
  std::string text;
  for (const std::uint8_t byte : token) text += fmt::format("{:02x}", byte);
  return text;
}

std::optional<Token> parse_token(std::string_view text) {
  Token token{};
  if (text.size() != 2 * token.size()) return std::nullopt;
  for (std::size_t i = 0; i < token.size(); ++i) {
    const char* begin = text.data() + 2 * i;
    const auto read = std::from_chars(begin, begin + 2, token[i], 16);
    if (read.ec != std::errc() || read.ptr != begin + 2) return std::nullopt;
  }
  return token;
}

bool is_same(const Token& a, const Token& b) noexcept {
  volatile std::uint8_t differing = 0;  // volatile: the compiler may not stop at the first difference
  for (std::size_t i = 0; i < a.size(); ++i) differing = static_cast<std::uint8_t>(differing | (a[i] ^ b[i]));
  return differing == 0;
}

}  // namespace myotact::net

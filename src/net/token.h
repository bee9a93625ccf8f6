#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace myotact::net {

/// What admits a client: 128 random bits, which cannot be guessed.
using Token = std::array<std::uint8_t, 16>;

/// From the system's own source of randomness. Throws Error Unavailable where there is none.
Token new_token();

/// 32 hexadecimal digits.
std::string to_text(const Token& token);
std::optional<Token> parse_token(std::string_view text);

/// Takes the same time wherever they differ, so that a token cannot be found digit by digit.
bool is_same(const Token& a, const Token& b) noexcept;

}  // namespace myotact::net

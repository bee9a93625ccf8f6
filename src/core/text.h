#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace myotact {

/// Shortest text that reads back to the same double ("nan" and "inf" included). Independent of the locale.
std::string to_text(double value);

/// The whole of `text` as a number, or nothing; a leading "+" is allowed. Independent of the locale.
std::optional<double> parse_number(std::string_view text);

/// The candidate nearest to `word`, slips and shortening counted, for "did you mean"; empty when there are none.
/// Of a longer word only the first 64 bytes are compared, so that no input makes this slow.
std::string nearest_word(std::string_view word, std::span<const std::string> candidates);

/// The parts of `line` between blanks (space, tab, carriage return).
std::vector<std::string_view> words_of(std::string_view line);

/// With small letters for the capitals of ASCII. Independent of the locale.
std::string lower(std::string_view text);

/// With &, <, > and quotes as XML and HTML write them, so that any text may stand between tags and in attributes.
std::string escape_markup(std::string_view text);

/// "a, b, c".
std::string join(std::span<const std::string> words, std::string_view separator = ", ");

}  // namespace myotact

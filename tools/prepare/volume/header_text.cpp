#include "prepare/volume/header_text.h"

#include <array>
#include <charconv>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"

namespace myotact::prepare {

namespace {

constexpr std::size_t kMostShown = 60;  // letters of a value that an error repeats

std::vector<std::string_view> exactly(std::string_view text, std::size_t count, const FieldPlace& place) {
  std::vector<std::string_view> words = words_of(text);
  if (words.size() == count) return words;
  throw bad_data(
      place.file, place.field,
      fmt::format("holds {} values in \"{}\"; must be {}", words.size(), trimmed(text).substr(0, kMostShown), count));
}

}  // namespace

std::vector<double> parse_numbers(std::string_view text, std::size_t count, const FieldPlace& place) {
  std::vector<double> numbers;
  for (const std::string_view word : exactly(text, count, place)) {
    const auto number = parse_number(word);
    if (!number) {
      throw bad_data(place.file, place.field, fmt::format("\"{}\" is no number", word.substr(0, kMostShown)));
    }
    numbers.push_back(*number);
  }
  return numbers;
}

std::vector<std::int64_t> parse_integers(std::string_view text, std::size_t count, const FieldPlace& place) {
  std::vector<std::int64_t> numbers;
  for (const std::string_view word : exactly(text, count, place)) {
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size()) {
      throw bad_data(place.file, place.field, fmt::format("\"{}\" is no whole number", word.substr(0, kMostShown)));
    }
    numbers.push_back(number);
  }
  return numbers;
}

std::optional<double> millimetres_in(std::string_view unit) {
  constexpr std::array<std::pair<std::string_view, double>, 15> kUnits = {{{"mm", 1.0},
                                                                           {"millimeter", 1.0},
                                                                           {"millimeters", 1.0},
                                                                           {"millimetre", 1.0},
                                                                           {"millimetres", 1.0},
                                                                           {"cm", 10.0},
                                                                           {"centimeter", 10.0},
                                                                           {"centimetre", 10.0},
                                                                           {"m", 1e3},
                                                                           {"meter", 1e3},
                                                                           {"metre", 1e3},
                                                                           {"um", 1e-3},
                                                                           {"\xc2\xb5m", 1e-3},
                                                                           {"micrometer", 1e-3},
                                                                           {"micrometre", 1e-3}}};
  const std::string wanted = lower(trimmed(unit));
  for (const auto& [name, millimetres] : kUnits) {
    if (wanted == name) return millimetres;
  }
  return {};
}

std::filesystem::path data_file_beside(const std::filesystem::path& header, const std::string& name,
                                       const std::string& field) {
  const bool many = name.find('%') != std::string::npos || name == "LIST" || name.starts_with("LIST ");
  if (many) {
    throw bad_data(header.string(), field,
                   fmt::format("names several files (\"{}\"); must be one. Save the segmentation as a single file",
                               name.substr(0, kMostShown)));
  }
  const std::string plain = name.starts_with("./") ? name.substr(2) : name;
  const bool here = !plain.empty() && plain != "." && plain != ".." && plain.find('/') == std::string::npos &&
                    plain.find('\\') == std::string::npos && plain.find('\0') == std::string::npos;
  if (here) return header.parent_path() / plain;
  throw bad_data(header.string(), field,
                 fmt::format("\"{}\" must be the name of a file in the header's own folder. Put both in one folder, or "
                             "save the segmentation as a single file",
                             name.substr(0, kMostShown)));
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

}  // namespace myotact::prepare

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Pieces of text that headers of volumes are made of. Every function throws Error BadData naming file and field.

namespace myotact::prepare {

/// Where a value stands, for errors.
struct FieldPlace {
  std::string file;
  std::string field;
};

/// Numbers between blanks, exactly `count` of them.
std::vector<double> parse_numbers(std::string_view text, std::size_t count, const FieldPlace& place);
/// The same of whole numbers.
std::vector<std::int64_t> parse_integers(std::string_view text, std::size_t count, const FieldPlace& place);

/// Of a unit of length: millimetres in one of it. "mm", "cm", "m", "um" and their long names; nothing for others.
std::optional<double> millimetres_in(std::string_view unit);

/// The data file that a header names, which lies in the header's own folder. Throws for a path that leads elsewhere,
/// and for lists or patterns of several files.
std::filesystem::path data_file_beside(const std::filesystem::path& header, const std::string& name,
                                       const std::string& field);

/// Without blanks at both ends.
std::string_view trimmed(std::string_view text);

}  // namespace myotact::prepare

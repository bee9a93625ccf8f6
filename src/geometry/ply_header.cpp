#include "geometry/ply_header.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/text.h"

namespace myotact::geometry {

namespace {

constexpr std::size_t kMostElements = kMostMeshElements;

Scalar scalar_named(const std::string& file, std::string_view word, int line) {
  struct Name {
    std::string_view name;
    Scalar type;
  };
  static constexpr std::array<Name, 16> kNames = {{{"char", Scalar::Int8},
                                                   {"int8", Scalar::Int8},
                                                   {"uchar", Scalar::Uint8},
                                                   {"uint8", Scalar::Uint8},
                                                   {"short", Scalar::Int16},
                                                   {"int16", Scalar::Int16},
                                                   {"ushort", Scalar::Uint16},
                                                   {"uint16", Scalar::Uint16},
                                                   {"int", Scalar::Int32},
                                                   {"int32", Scalar::Int32},
                                                   {"uint", Scalar::Uint32},
                                                   {"uint32", Scalar::Uint32},
                                                   {"float", Scalar::Float32},
                                                   {"float32", Scalar::Float32},
                                                   {"double", Scalar::Float64},
                                                   {"float64", Scalar::Float64}}};
  for (const Name& known : kNames) {
    if (known.name == word) return known.type;
  }
  throw bad_data(file, fmt::format("{}:1", line), fmt::format("unknown property type \"{}\"", shown(word)));
}

PlyElement element_of(const std::string& file, const std::vector<std::string_view>& words, int line) {
  const auto count = words.size() == 3 ? parse_number(words[2]) : std::nullopt;
  if (!count || !(*count >= 0.0) || *count > static_cast<double>(kMostElements) || *count != std::floor(*count)) {
    throw bad_data(file, fmt::format("{}:1", line),
                   fmt::format("must be \"element NAME COUNT\" with a count of 0 to {}", kMostElements));
  }
  return {std::string(words[1]), static_cast<std::size_t>(*count), {}};
}

PlyProperty property_of(const std::string& file, const std::vector<std::string_view>& words, int line) {
  if (words.size() == 3) return {std::string(words[2]), scalar_named(file, words[1], line), false, Scalar::Uint8};
  if (words.size() == 5 && words[1] == "list") {
    return {std::string(words[4]), scalar_named(file, words[3], line), true, scalar_named(file, words[2], line)};
  }
  throw bad_data(file, fmt::format("{}:1", line), "is no property line");
}

Encoding encoding_named(const std::string& file, std::string_view word, int line) {
  if (word == "ascii") return Encoding::Text;
  if (word == "binary_little_endian") return Encoding::LittleEndian;
  if (word == "binary_big_endian") return Encoding::BigEndian;
  throw bad_data(
      file, fmt::format("{}:1", line),
      fmt::format("unknown format \"{}\"; must be ascii, binary_little_endian or binary_big_endian", shown(word)));
}

void read_header_line(const std::string& file, std::string_view line, int number, PlyHeader& header) {
  const auto words = words_of(line);
  const std::string place = fmt::format("{}:1", number);
  if (words.empty() || words[0] == "comment" || words[0] == "obj_info") return;
  if (words[0] == "format") {
    header.encoding = encoding_named(file, words.size() < 2 ? "" : words[1], number);
    header.has_format = true;
  } else if (words[0] == "element") {
    header.elements.push_back(element_of(file, words, number));
  } else if (words[0] == "property" && !header.elements.empty()) {
    header.elements.back().properties.push_back(property_of(file, words, number));
  } else {
    throw bad_data(file, place, "is no line of a PLY header");
  }
}

}  // namespace

PlyHeader read_ply_header(const std::string& file, std::string_view bytes) {
  PlyHeader header;
  std::size_t start = 0;
  for (int number = 1; start < bytes.size(); ++number) {
    const std::size_t end = bytes.find('\n', start);
    if (end == std::string_view::npos) break;
    const std::string_view line = bytes.substr(start, std::min(end - start, kLongestLine_bytes));
    start = end + 1;
    if (number == 1) {
      if (!line.starts_with("ply")) break;
      continue;
    }
    if (line.starts_with("end_header")) {
      if (!header.has_format)
        throw bad_data(file, "2:1", "the line \"format ascii 1.0\", or of another encoding, is missing");
      header.size = start;
      header.lines = number;
      return header;
    }
    read_header_line(file, line, number, header);
  }
  throw bad_data(file, "1:1", "is no PLY file (\"ply\" .. \"end_header\" is missing)");
}

}  // namespace myotact::geometry

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>

#include <fmt/format.h>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "geometry/mesh_files.h"

namespace myotact::geometry {

static_assert(std::endian::native == std::endian::little, "binary meshes are read and written little-endian");

namespace {

constexpr std::size_t kMostElements = 20'000'000;  // ten times the largest scan seen; bounds the memory of a reader

enum class Scalar { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

std::size_t size_of(Scalar type) {
  constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

struct Property {
  std::string name;
  Scalar type = Scalar::Float32;
  bool is_list = false;
  Scalar count_type = Scalar::Uint8;
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  std::vector<Element> elements;
  bool has_format = false;
  std::size_t size = 0;  // bytes up to the body
};

/// Reads values off the body and knows the byte it is at.
class Body {
 public:
  Body(const std::string& file, std::string_view bytes, std::size_t position)
      : file_(file), bytes_(bytes), position_(position) {}

  double take(Scalar type) {
    if (bytes_.size() - position_ < size_of(type)) throw error("the file ends early");
    const char* from = bytes_.data() + position_;
    position_ += size_of(type);
    switch (type) {
      case Scalar::Int8:
        return as<std::int8_t>(from);
      case Scalar::Uint8:
        return as<std::uint8_t>(from);
      case Scalar::Int16:
        return as<std::int16_t>(from);
      case Scalar::Uint16:
        return as<std::uint16_t>(from);
      case Scalar::Int32:
        return as<std::int32_t>(from);
      case Scalar::Uint32:
        return as<std::uint32_t>(from);
      case Scalar::Float32:
        return static_cast<double>(as<float>(from));
      case Scalar::Float64:
        return as<double>(from);
    }
    return 0.0;
  }

  Error error(const std::string& problem) const { return bad_data(file_, fmt::format("byte {}", position_), problem); }

  std::size_t left() const { return bytes_.size() - position_; }

 private:
  template <class T>
  static T as(const char* from) {
    T value{};
    std::memcpy(&value, from, sizeof value);
    return value;
  }

  const std::string& file_;
  std::string_view bytes_;
  std::size_t position_;
};

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
  throw bad_data(file, fmt::format("{}:1", line), fmt::format("unknown property type \"{}\"", word));
}

Element element_of(const std::string& file, const std::vector<std::string_view>& words, int line) {
  const auto count = words.size() == 3 ? parse_number(words[2]) : std::nullopt;
  if (!count || !(*count >= 0.0) || *count > static_cast<double>(kMostElements) || *count != std::floor(*count)) {
    throw bad_data(file, fmt::format("{}:1", line),
                   fmt::format("must be \"element NAME COUNT\" with a count of 0 to {}", kMostElements));
  }
  return {std::string(words[1]), static_cast<std::size_t>(*count), {}};
}

Property property_of(const std::string& file, const std::vector<std::string_view>& words, int line) {
  if (words.size() == 3) return {std::string(words[2]), scalar_named(file, words[1], line), false, Scalar::Uint8};
  if (words.size() == 5 && words[1] == "list") {
    return {std::string(words[4]), scalar_named(file, words[3], line), true, scalar_named(file, words[2], line)};
  }
  throw bad_data(file, fmt::format("{}:1", line), "is no property line");
}

void read_header_line(const std::string& file, std::string_view line, int number, Header& header) {
  const auto words = words_of(line);
  const std::string place = fmt::format("{}:1", number);
  if (words.empty() || words[0] == "comment" || words[0] == "obj_info") return;
  if (words[0] == "format") {
    if (words.size() < 2 || words[1] != "binary_little_endian") {
      throw bad_data(file, place, "must be binary_little_endian; convert the file");
    }
    header.has_format = true;
  } else if (words[0] == "element") {
    header.elements.push_back(element_of(file, words, number));
  } else if (words[0] == "property" && !header.elements.empty()) {
    header.elements.back().properties.push_back(property_of(file, words, number));
  } else {
    throw bad_data(file, place, "is no line of a PLY header");
  }
}

Header read_header(const std::string& file, std::string_view bytes) {
  Header header;
  std::size_t start = 0;
  for (int number = 1; start < bytes.size(); ++number) {
    const std::size_t end = bytes.find('\n', start);
    if (end == std::string_view::npos) break;
    const std::string_view line = bytes.substr(start, end - start);
    start = end + 1;
    if (number == 1) {
      if (!line.starts_with("ply")) break;
      continue;
    }
    if (line.starts_with("end_header")) {
      if (!header.has_format) throw bad_data(file, "2:1", "the line \"format binary_little_endian 1.0\" is missing");
      header.size = start;
      return header;
    }
    read_header_line(file, line, number, header);
  }
  throw bad_data(file, "1:1", "is no PLY file (\"ply\" .. \"end_header\" is missing)");
}

void read_vertices(const Element& element, Body& body, TriangleMesh& mesh) {
  for (std::size_t i = 0; i < element.count; ++i) {
    Vec3 position = Vec3::Constant(std::nan(""));
    for (const Property& property : element.properties) {
      if (property.is_list) throw body.error("a vertex property that is a list is not read");
      const double value = body.take(property.type);
      if (property.name == "x") position.x() = value;
      if (property.name == "y") position.y() = value;
      if (property.name == "z") position.z() = value;
    }
    if (!position.allFinite()) throw body.error(fmt::format("vertex {} is not finite, or x, y, z are missing", i));
    mesh.positions_m.push_back(position);
  }
}

void read_face_list(const Property& property, Body& body, std::size_t face, TriangleMesh& mesh) {
  const double count = body.take(property.count_type);
  const bool is_faces = property.name == "vertex_indices" || property.name == "vertex_index";
  if (is_faces && count != 3.0) throw body.error(fmt::format("face {} has {} corners; must have 3", face, count));
  if (!(count >= 0.0) || count > static_cast<double>(body.left())) throw body.error("a list is longer than the file");
  std::array<int, 3> triangle{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    const double index = body.take(property.type);
    if (!is_faces) continue;
    if (!(index >= 0.0) || index >= static_cast<double>(mesh.positions_m.size())) {
      throw body.error(fmt::format("face {} names vertex {}; there are {}", face, index, mesh.positions_m.size()));
    }
    triangle[k] = static_cast<int>(index);
  }
  if (is_faces) mesh.triangles.push_back(triangle);
}

void read_faces(const Element& element, Body& body, TriangleMesh& mesh) {
  for (std::size_t i = 0; i < element.count; ++i) {
    for (const Property& property : element.properties) {
      if (property.is_list) {
        read_face_list(property, body, i, mesh);
      } else {
        body.take(property.type);
      }
    }
  }
}

template <class T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

TriangleMesh read_ply(const std::filesystem::path& path) {
  const std::string file = path.string();
  const std::string bytes = read_file(path);
  const Header header = read_header(file, bytes);
  Body body(file, bytes, header.size);
  TriangleMesh mesh;
  for (const Element& element : header.elements) {
    if (element.properties.empty() && element.count > 0)
      throw body.error("element " + element.name + " has no property");
    if (element.name == "vertex") {
      read_vertices(element, body, mesh);
    } else {
      read_faces(element, body, mesh);
    }
  }
  if (mesh.triangles.empty()) throw bad_data(file, "", "holds no triangles");
  return mesh;
}

void write_ply(const TriangleMesh& mesh, const std::filesystem::path& path) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double "
      "z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.positions_m.size(), mesh.triangles.size());
  for (const Vec3& position : mesh.positions_m) {
    for (const double component : to_array(position)) append(bytes, component);
  }
  for (const auto& triangle : mesh.triangles) {
    append(bytes, std::uint8_t{3});
    for (const int vertex : triangle) append(bytes, static_cast<std::int32_t>(vertex));
  }
  write_file(path, bytes);
}

}  // namespace myotact::geometry

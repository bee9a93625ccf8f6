#include <bit>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "core/file.h"
#include "geometry/parse_mesh.h"
#include "geometry/ply_header.h"
#include "geometry/surface_builder.h"

namespace myotact::geometry {

static_assert(std::endian::native == std::endian::little, "meshes are written little-endian");

namespace {

/// The entries of a list that is about to be read.
std::size_t list_length(const PlyProperty& property, Numbers& numbers) {
  const double count = numbers.take(property.count_type);
  if (!(count >= 0.0) || count != std::floor(count)) {
    throw numbers.words().error(fmt::format("a list has {} entries; must be a whole number from 0", count));
  }
  // An entry takes a byte at least, in text too.
  if (count > static_cast<double>(numbers.words().left()))
    throw numbers.words().error("a list is longer than the file");
  return static_cast<std::size_t>(count);
}

void skip(const PlyProperty& property, Numbers& numbers) {
  numbers.skip(property.type, property.is_list ? list_length(property, numbers) : 1);
}

void read_vertices(const PlyElement& element, Numbers& numbers, SurfaceBuilder& surface) {
  for (std::size_t i = 0; i < element.count; ++i) {
    Vec3 position = Vec3::Constant(std::nan(""));
    for (const PlyProperty& property : element.properties) {
      if (property.is_list || property.name.size() != 1 || property.name < "x" || property.name > "z") {
        skip(property, numbers);
      } else {
        position[property.name[0] - 'x'] = numbers.take(property.type);
      }
    }
    if (!position.allFinite()) {
      throw numbers.words().error(fmt::format("vertex {} is not finite, or x, y, z are missing", i));
    }
    surface.add_position(position);
  }
}

/// The corners of a face, of which `face` is the number.
void read_corners(const PlyProperty& property, Numbers& numbers, std::size_t face, SurfaceBuilder& surface) {
  const std::size_t count = list_length(property, numbers);
  surface.require_face(count);
  std::vector<int> corners(count);
  for (int& corner : corners) {
    const double index = numbers.take(property.type);
    if (!(index >= 0.0) || index >= surface.position_count() || index != std::floor(index)) {
      throw numbers.words().error(
          fmt::format("face {} names vertex {}; there are {}", face, index, surface.position_count()));
    }
    corner = static_cast<int>(index);
  }
  surface.add_face(corners);
}

void read_faces(const PlyElement& element, Numbers& numbers, SurfaceBuilder& surface) {
  for (std::size_t i = 0; i < element.count; ++i) {
    for (const PlyProperty& property : element.properties) {
      const bool is_corners = property.name == "vertex_indices" || property.name == "vertex_index";
      if (is_corners && property.is_list) {
        read_corners(property, numbers, i, surface);
      } else {
        skip(property, numbers);
      }
    }
  }
}

void read_over(const PlyElement& element, Numbers& numbers) {
  for (std::size_t i = 0; i < element.count; ++i) {
    for (const PlyProperty& property : element.properties) skip(property, numbers);
  }
}

void read_element(const PlyElement& element, Numbers& numbers, SurfaceBuilder& surface) {
  if (element.properties.empty() && element.count > 0) {
    throw numbers.words().error("element " + shown(element.name) + " has no property");
  }
  if (element.name == "vertex") {
    if (surface.position_count() > 0) throw numbers.words().error("the element vertex stands twice; keep one");
    read_vertices(element, numbers, surface);
  } else if (element.name == "face") {
    read_faces(element, numbers, surface);
  } else {
    read_over(element, numbers);
  }
}

/// Anything but blanks behind the last element shows that a count is wrong.
void require_end(Words& words, Encoding encoding) {
  const std::string_view rest = encoding == Encoding::Text ? std::string_view() : words.bytes(words.left());
  const bool clean = encoding == Encoding::Text ? words.at_end()
                                                : rest.find_first_not_of(std::string_view(" \t\r\n\0", 5)) == rest.npos;
  if (clean) return;
  if (encoding == Encoding::Text) words.next();
  throw words.error("goes on after the elements that the header announces; correct its counts or export it again");
}

template <class T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

SurfaceFile parse_ply(std::string_view bytes, const std::string& file) {
  const PlyHeader header = read_ply_header(file, bytes);
  Words words(file, bytes);
  if (header.encoding == Encoding::Text) {
    for (int line = 0; line < header.lines; ++line) words.rest_of_line();
  } else {
    words.bytes(header.size);
  }
  Numbers numbers(words, header.encoding);
  SurfaceBuilder surface(words);
  for (const PlyElement& element : header.elements) read_element(element, numbers, surface);
  require_end(words, header.encoding);
  return surface.take();
}

TriangleMesh read_ply(const std::filesystem::path& path) {
  return parse_ply(read_file(path), path.string()).mesh;
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

#include <array>
#include <limits>

#include <fmt/format.h>

#include "core/text.h"
#include "geometry/parse_mesh.h"
#include "geometry/scalars.h"
#include "geometry/surface_builder.h"

// Legacy VTK with PolyData, ASCII or binary (big-endian). Two ways to write cells: to version 4 "POLYGONS cells size",
// then each cell's number of corners before its corners; from version 5 "POLYGONS offsets size", then a list OFFSETS of
// where cells begin and end in a list CONNECTIVITY.

namespace myotact::geometry {

namespace {

constexpr int kMostEntries = std::numeric_limits<int>::max();

Scalar type_named(const Words& words, std::string_view word) {
  struct Name {
    std::string_view name;
    Scalar type;
  };
  static constexpr std::array<Name, 13> kNames = {{{"char", Scalar::Int8},
                                                   {"unsigned_char", Scalar::Uint8},
                                                   {"short", Scalar::Int16},
                                                   {"unsigned_short", Scalar::Uint16},
                                                   {"int", Scalar::Int32},
                                                   {"vtkIdType", Scalar::Int32},  // written as int
                                                   {"unsigned_int", Scalar::Uint32},
                                                   {"long", Scalar::Int64},
                                                   {"unsigned_long", Scalar::Uint64},
                                                   {"vtktypeint64", Scalar::Int64},
                                                   {"vtktypeuint64", Scalar::Uint64},
                                                   {"float", Scalar::Float32},
                                                   {"double", Scalar::Float64}}};
  for (const Name& known : kNames) {
    if (known.name == word) return known.type;
  }
  throw words.error(fmt::format("values of the type \"{}\" are not read", shown(word)));
}

/// Binary values begin behind the end of the line that announces them.
Scalar read_type(Numbers& numbers) {
  const Scalar type = type_named(numbers.words(), numbers.words().next());
  if (numbers.encoding() != Encoding::Text) numbers.words().rest_of_line();
  return type;
}

void read_points(Numbers& numbers, SurfaceBuilder& surface) {
  if (surface.position_count() > 0) throw numbers.words().error("the section POINTS stands twice; keep one");
  const int count = numbers.words().integer(0, kMostMeshElements);
  const Scalar type = read_type(numbers);
  for (int i = 0; i < count; ++i) {
    const double x = numbers.finite(type);
    const double y = numbers.finite(type);
    surface.add_position({x, y, numbers.finite(type)});
  }
}

/// Cells one after the other, whichever way they are written.
struct Cells {
  std::vector<int> corners;
  std::vector<std::size_t> ends;  // of each cell in `corners`
};

/// `count` cells that take `size` numbers, each with its number of corners before them.
Cells read_counted_cells(Numbers& numbers, int count, int size, int last_vertex) {
  Cells cells;
  int left = size;
  for (int i = 0; i < count; ++i) {
    const int corners = numbers.integer(Scalar::Int32, 0, static_cast<int>(kMostCorners));
    left -= corners + 1;
    if (left < 0) break;
    for (int k = 0; k < corners; ++k) cells.corners.push_back(numbers.integer(Scalar::Int32, 0, last_vertex));
    cells.ends.push_back(cells.corners.size());
  }
  if (left != 0) throw numbers.words().error(fmt::format("{} cells do not take {} numbers", count, size));
  return cells;
}

/// Lists of `offsets` and of `size` entries; the next word of the file is OFFSETS.
Cells read_offset_cells(Numbers& numbers, int offsets, int size, int last_vertex) {
  Words& words = numbers.words();
  Cells cells;
  words.expect("OFFSETS");
  const Scalar offset_type = read_type(numbers);
  int previous = 0;
  for (int i = 0; i < offsets; ++i) {
    previous = numbers.integer(offset_type, previous, i == 0 ? 0 : size);
    if (i > 0) cells.ends.push_back(static_cast<std::size_t>(previous));
  }
  if (previous != size) throw words.error(fmt::format("the last offset is {}; must be {}", previous, size));
  words.expect("CONNECTIVITY");
  const Scalar corner_type = read_type(numbers);
  for (int i = 0; i < size; ++i) cells.corners.push_back(numbers.integer(corner_type, 0, last_vertex));
  return cells;
}

Cells read_cells(Numbers& numbers, bool by_offsets, int last_vertex) {
  const int count = numbers.words().integer(0, kMostMeshElements);
  const int size = numbers.words().integer(0, kMostEntries);
  if (by_offsets) return read_offset_cells(numbers, count, size, last_vertex);
  if (numbers.encoding() != Encoding::Text) numbers.words().rest_of_line();
  return read_counted_cells(numbers, count, size, last_vertex);
}

/// Every second triangle of a strip turns the other way.
void add_strip(std::span<const int> corners, SurfaceBuilder& surface) {
  for (std::size_t k = 0; k + 2 < corners.size(); ++k) {
    const bool turned = k % 2 == 1;
    surface.add_face(std::array{corners[k], corners[turned ? k + 2 : k + 1], corners[turned ? k + 1 : k + 2]});
  }
}

void add_cells(const Cells& cells, bool strips, SurfaceBuilder& surface) {
  std::size_t start = 0;
  for (const std::size_t end : cells.ends) {
    const std::span corners(cells.corners.data() + start, end - start);
    if (strips) {
      add_strip(corners, surface);
    } else {
      surface.add_face(corners);
    }
    start = end;
  }
}

/// "FIELD name arrays", each with "name components tuples type" before its values.
void read_over_field(Numbers& numbers) {
  Words& words = numbers.words();
  words.next();
  const int arrays = words.integer(0, 1000);
  for (int i = 0; i < arrays; ++i) {
    words.next();
    const auto components = static_cast<std::size_t>(words.integer(0, 1000));
    const auto tuples = static_cast<std::size_t>(words.integer(0, kMostMeshElements));
    numbers.skip(read_type(numbers), components * tuples);
  }
}

/// What programs know about the list before; ends with an empty line.
void read_over_metadata(Words& words) {
  words.rest_of_line();
  while (words.left() > 0 && !words_of(words.rest_of_line()).empty()) {
  }
}

/// Sections up to the values at points or cells, which are no part of the surface.
void read_sections(Numbers& numbers, bool by_offsets, SurfaceBuilder& surface) {
  Words& words = numbers.words();
  while (!words.at_end()) {
    const std::string_view section = words.next();
    if (section == "POINT_DATA" || section == "CELL_DATA") return;
    if (section == "POINTS") {
      read_points(numbers, surface);
    } else if (section == "FIELD") {
      read_over_field(numbers);
    } else if (section == "METADATA") {
      read_over_metadata(words);
    } else if (section == "POLYGONS" || section == "TRIANGLE_STRIPS") {
      add_cells(read_cells(numbers, by_offsets, surface.position_count() - 1), section != "POLYGONS", surface);
    } else if (section == "VERTICES" || section == "LINES") {
      read_cells(numbers, by_offsets, surface.position_count() - 1);
    } else {
      throw words.error(fmt::format("\"{}\" begins no section of PolyData", shown(section)));
    }
  }
}

}  // namespace

SurfaceFile parse_vtk_surface(std::string_view bytes, const std::string& file) {
  Words words(file, bytes);
  const std::string_view mark = words.rest_of_line();
  const std::size_t version = mark.find("vtk DataFile Version ");
  if (version == std::string_view::npos) {
    throw words.error("is no legacy VTK file (\"# vtk DataFile Version\" is missing)");
  }
  const bool by_offsets = mark.substr(version).find(" 5.") != std::string_view::npos;
  words.rest_of_line();  // the title, which may be empty
  const std::string_view encoding = words.next();
  if (encoding != "ASCII" && encoding != "BINARY") {
    throw words.error(fmt::format("is \"{}\"; must be ASCII or BINARY", shown(encoding)));
  }
  words.expect("DATASET");
  const std::string_view kind = words.next();
  if (kind == "UNSTRUCTURED_GRID") return boundary_surface(parse_vtk(bytes, file), file);
  if (kind != "POLYDATA") {
    throw words.error(fmt::format("is \"{}\"; must be POLYDATA or UNSTRUCTURED_GRID", shown(kind)));
  }
  Numbers numbers(words, encoding == "ASCII" ? Encoding::Text : Encoding::BigEndian);
  SurfaceBuilder surface(words);
  read_sections(numbers, by_offsets, surface);
  return surface.take();
}

}  // namespace myotact::geometry

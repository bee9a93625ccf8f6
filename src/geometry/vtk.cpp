#include <cmath>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "geometry/parse_mesh.h"
#include "geometry/words.h"

namespace myotact::geometry {

namespace {

constexpr int kLinearTet = 10, kQuadraticTet = 24;  // VTK cell types

void read_points(Words& words, TetMesh& mesh) {
  const int count = words.integer(0, kMostMeshElements);
  const std::string_view type = words.next();
  if (type != "double" && type != "float") {
    throw words.error(fmt::format("points are of the type \"{}\"; must be double or float", shown(type)));
  }
  for (int i = 0; i < count; ++i) {
    const double x = words.number();
    const double y = words.number();
    mesh.nodes_m.emplace_back(x, y, words.number());
  }
}

void read_cells(Words& words, TetMesh& mesh) {
  const int count = words.integer(1, kMostMeshElements);
  words.integer(0, std::numeric_limits<int>::max());  // size of the list: implied by the cells
  const int last_node = static_cast<int>(mesh.nodes_m.size()) - 1;
  for (int i = 0; i < count; ++i) {
    const std::string_view first = words.next();
    if (first == "OFFSETS") throw words.error("tets of VTK's version 5 are not read; write the file as version 4.2");
    const int nodes = words.integer_in(first, 4, 10);
    if (nodes != 4 && nodes != 10) throw words.error(fmt::format("a tet has 4 or 10 nodes, not {}", nodes));
    std::array<int, 4> corners{};
    for (int& node : corners) node = words.integer(0, last_node);
    mesh.corners.push_back(corners);
    if (nodes == 4) continue;
    std::array<int, 6> midsides{};
    for (int& node : midsides) node = words.integer(0, last_node);
    mesh.midsides.push_back(midsides);
  }
  if (!mesh.midsides.empty() && mesh.midsides.size() != mesh.corners.size()) {
    throw words.error("linear and quadratic tets are mixed; use one kind");
  }
}

void read_cell_types(Words& words, const TetMesh& mesh) {
  const int count = words.integer(0, kMostMeshElements);
  if (static_cast<std::size_t>(count) != mesh.corners.size()) throw words.error("must have one type a cell");
  const int wanted = mesh.quadratic() ? kQuadraticTet : kLinearTet;
  for (int i = 0; i < count; ++i) {
    const int type = words.integer(0, 1000);
    if (type != wanted) throw words.error(fmt::format("cell type {}; must be {}", type, wanted));
  }
}

/// "SCALARS name type [components]" followed by "LOOKUP_TABLE name" and one number an entry.
std::vector<double> read_scalars(Words& words, std::size_t count) {
  const auto type_and_components = words_of(words.rest_of_line());
  if (type_and_components.size() > 1 && type_and_components[1] != "1") {
    throw words.error("scalars must have 1 component");
  }
  words.expect("LOOKUP_TABLE");
  words.next();
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(words.number());
  return values;
}

std::vector<int> to_integers(const std::vector<double>& values, const Words& words) {
  std::vector<int> integers;
  for (const double value : values) {
    if (value != std::floor(value) || std::abs(value) > 1e6) throw words.error("must be small whole numbers");
    integers.push_back(static_cast<int>(value));
  }
  return integers;
}

std::vector<Vec3> read_vectors(Words& words, std::size_t count) {
  words.next();  // the type
  std::vector<Vec3> vectors;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = words.number();
    const double y = words.number();
    vectors.emplace_back(x, y, words.number());
  }
  return vectors;
}

/// One array of the cells or the points; arrays with other names are read over.
void read_array(Words& words, std::string_view kind, bool of_cells, TetFile& file) {
  const std::string_view name = words.next();
  const std::size_t count = of_cells ? file.mesh.corners.size() : file.mesh.nodes_m.size();
  if (kind == "VECTORS") {
    std::vector<Vec3> vectors = read_vectors(words, count);
    if (of_cells && name == "fibre") file.fibres = std::move(vectors);
    return;
  }
  if (kind != "SCALARS") {
    throw words.error(fmt::format("\"{}\" is not read; must be SCALARS or VECTORS", shown(kind)));
  }
  const std::vector<double> values = read_scalars(words, count);
  if (of_cells && name == "region") file.regions = to_integers(values, words);
  if (of_cells && name == "section") file.sections_m2 = values;
  if (!of_cells && name == "attachment") file.attachments = to_integers(values, words);
}

/// Data arrays of the points or the cells, to the end of the file.
void read_data(Words& words, TetFile& file) {
  bool of_cells = false;
  while (!words.at_end()) {
    const std::string_view kind = words.next();
    if (kind != "CELL_DATA" && kind != "POINT_DATA") {
      read_array(words, kind, of_cells, file);
      continue;
    }
    of_cells = kind == "CELL_DATA";
    const std::size_t wanted = of_cells ? file.mesh.corners.size() : file.mesh.nodes_m.size();
    if (static_cast<std::size_t>(words.integer(0, kMostMeshElements)) != wanted) {
      throw words.error(fmt::format("{} must have {} entries", kind, wanted));
    }
  }
}

void append_numbers(std::string& text, std::initializer_list<double> values) {
  const char* separator = "";
  for (const double value : values) {
    text += separator;
    text += to_text(value);
    separator = " ";
  }
  text += '\n';
}

void append_vectors(std::string& text, const std::string& name, const std::vector<Vec3>& vectors) {
  text += fmt::format("VECTORS {} double\n", name);
  for (const Vec3& vector : vectors) append_numbers(text, {vector.x(), vector.y(), vector.z()});
}

void append_scalars(std::string& text, const std::string& name, const char* type, const std::vector<double>& values) {
  text += fmt::format("SCALARS {} {} 1\nLOOKUP_TABLE default\n", name, type);
  for (const double value : values) append_numbers(text, {value});
}

void append_cells(std::string& text, const TetMesh& mesh) {
  const int nodes = mesh.quadratic() ? 10 : 4;
  const std::size_t count = mesh.corners.size();
  text += fmt::format("CELLS {} {}\n", count, count * static_cast<std::size_t>(nodes + 1));
  for (std::size_t t = 0; t < count; ++t) {
    text += std::to_string(nodes);
    for (const int node : mesh.corners[t]) text += ' ' + std::to_string(node);
    if (mesh.quadratic()) {
      for (const int node : mesh.midsides[t]) text += ' ' + std::to_string(node);
    }
    text += '\n';
  }
  text += fmt::format("CELL_TYPES {}\n", count);
  for (std::size_t t = 0; t < count; ++t) text += mesh.quadratic() ? "24\n" : "10\n";
}

}  // namespace

TetFile parse_vtk(std::string_view bytes, const std::string& file_name) {
  Words words(file_name, bytes);
  if (words.rest_of_line().find("vtk DataFile") == std::string_view::npos) {
    throw words.error("is no legacy VTK file (\"# vtk DataFile Version\" is missing)");
  }
  words.rest_of_line();  // the title, which may be empty
  words.expect("ASCII");
  words.expect("DATASET");
  words.expect("UNSTRUCTURED_GRID");
  TetFile file;
  words.expect("POINTS");
  read_points(words, file.mesh);
  words.expect("CELLS");
  read_cells(words, file.mesh);
  words.expect("CELL_TYPES");
  read_cell_types(words, file.mesh);
  read_data(words, file);
  return file;
}

TetFile read_vtk(const std::filesystem::path& path) {
  return parse_vtk(read_file(path), path.string());
}

void write_vtk(const TetFile& file, const std::filesystem::path& path) {
  write_vtk(file, TetResults{}, path);
}

void write_vtk(const TetFile& file, const TetResults& results, const std::filesystem::path& path) {
  std::string text = "# vtk DataFile Version 3.0\nmuscle\nASCII\nDATASET UNSTRUCTURED_GRID\n";
  text += fmt::format("POINTS {} double\n", file.mesh.nodes_m.size());
  for (const Vec3& node : file.mesh.nodes_m) append_numbers(text, {node.x(), node.y(), node.z()});
  append_cells(text, file.mesh);
  text += fmt::format("CELL_DATA {}\n", file.mesh.corners.size());
  if (!file.fibres.empty()) append_vectors(text, "fibre", file.fibres);
  if (!file.sections_m2.empty()) append_scalars(text, "section", "double", file.sections_m2);
  if (!file.regions.empty()) append_scalars(text, "region", "int", {file.regions.begin(), file.regions.end()});
  for (const auto& [name, values] : results.cell_scalars) append_scalars(text, name, "double", values);
  if (!file.attachments.empty() || !results.point_vectors.empty()) {
    text += fmt::format("POINT_DATA {}\n", file.mesh.nodes_m.size());
  }
  if (!file.attachments.empty()) {
    append_scalars(text, "attachment", "int", {file.attachments.begin(), file.attachments.end()});
  }
  for (const auto& [name, vectors] : results.point_vectors) append_vectors(text, name, vectors);
  write_file(path, text);
}

}  // namespace myotact::geometry

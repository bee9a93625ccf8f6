#include <array>

#include <fmt/format.h>

#include "core/file.h"
#include "geometry/parse_mesh.h"
#include "geometry/words.h"

// TetGen's .node (points) and .ele (tets), one entry a line, "#" before a comment:
//   .node  <points> <dimension 3> [attributes] [markers 0 or 1]    then  <index> <x> <y> <z> [attributes] [marker]
//   .ele   <tets> <nodes per tet 4 or 10> [attributes]             then  <index> <nodes> [attributes]
// The first index, 0 or 1, is that of both files.

namespace myotact::geometry {

namespace {

/// Which of TetGen's six mid-side nodes is the n-th of ours. TetGen's lie between the corners 23, 03, 01, 12, 13, 02
/// (read off a mesh of one tet made by libtet 1.5.1 with "o2").
constexpr std::array<std::size_t, 6> kTetgenMidside = {2, 3, 5, 1, 4, 0};

struct Nodes {
  std::vector<Vec3> positions_m;
  int first_index = 0;
};

/// The words of the next entry, of which at least `least` are needed.
std::vector<std::string_view> entry(Words& words, std::size_t least) {
  auto line = words.next_line();
  if (line.size() < least) throw words.error(fmt::format("has {} numbers; must have at least {}", line.size(), least));
  return line;
}

Nodes parse_nodes(std::string_view text, const std::string& file) {
  Words words(file, text, '#');
  const auto header = entry(words, 1);
  const int count = words.integer_in(header[0], 4, kMostMeshElements);
  if (header.size() > 1) words.integer_in(header[1], 3, 3);
  Nodes nodes;
  for (int i = 0; i < count; ++i) {
    const auto line = entry(words, 4);
    if (i == 0) nodes.first_index = words.integer_in(line[0], 0, 1);
    const int index = nodes.first_index + i;
    if (words.integer_in(line[0], 0, kMostMeshElements) != index) {
      throw words.error(fmt::format("has the index {}; must be {}, one after the other", shown(line[0]), index));
    }
    nodes.positions_m.emplace_back(words.number_in(line[1]), words.number_in(line[2]), words.number_in(line[3]));
  }
  return nodes;
}

void parse_tets(std::string_view text, const std::string& file, int first_index, TetMesh& mesh) {
  Words words(file, text, '#');
  const auto header = entry(words, 2);
  const int count = words.integer_in(header[0], 1, kMostMeshElements);
  const int nodes_of_tet = words.integer_in(header[1], 4, 10);
  if (nodes_of_tet != 4 && nodes_of_tet != 10) {
    throw words.error(fmt::format("a tet has 4 or 10 nodes, not {}", nodes_of_tet));
  }
  const int last_index = first_index + static_cast<int>(mesh.nodes_m.size()) - 1;
  for (int t = 0; t < count; ++t) {
    const auto line = entry(words, static_cast<std::size_t>(nodes_of_tet) + 1);
    const auto node = [&](std::size_t k) {
      return words.integer_in(line[k + 1], first_index, last_index) - first_index;
    };
    mesh.corners.push_back({node(0), node(1), node(2), node(3)});
    if (nodes_of_tet == 4) continue;
    std::array<int, 6> midsides{};
    for (std::size_t e = 0; e < midsides.size(); ++e) midsides[e] = node(4 + kTetgenMidside[e]);
    mesh.midsides.push_back(midsides);
  }
}

}  // namespace

TetFile parse_tetgen(std::string_view nodes, std::string_view tets, const std::string& stem) {
  Nodes read = parse_nodes(nodes, stem + ".node");
  TetFile file;
  file.mesh.nodes_m = std::move(read.positions_m);
  parse_tets(tets, stem + ".ele", read.first_index, file.mesh);
  return file;
}

TetFile read_tetgen(const std::filesystem::path& path) {
  std::filesystem::path stem = path;
  stem.replace_extension();
  const std::string nodes = read_file(stem.string() + ".node");
  return parse_tetgen(nodes, read_file(stem.string() + ".ele"), stem.string());
}

}  // namespace myotact::geometry

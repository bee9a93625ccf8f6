#include <array>

#include "core/file.h"
#include "geometry/parse_mesh.h"
#include "geometry/words.h"

// Medit's ASCII .mesh: keywords, each followed by a count and its entries; nodes count from 1; "#" before a comment.

namespace myotact::geometry {

namespace {

void read_vertices(Words& words, TetMesh& mesh) {
  if (!mesh.nodes_m.empty()) throw words.error("the section Vertices stands twice; keep one");
  const int count = words.integer(4, kMostMeshElements);
  for (int i = 0; i < count; ++i) {
    const double x = words.number();
    const double y = words.number();
    mesh.nodes_m.emplace_back(x, y, words.number());
    words.number();  // the reference
  }
}

void read_tetrahedra(Words& words, TetFile& file) {
  if (!file.mesh.corners.empty()) throw words.error("the section Tetrahedra stands twice; keep one");
  if (file.mesh.nodes_m.empty()) throw words.error("Tetrahedra stand before Vertices; put Vertices first");
  const int count = words.integer(1, kMostMeshElements);
  const int last_node = static_cast<int>(file.mesh.nodes_m.size());
  constexpr int kLargestReference = 1'000'000;  // as the regions of the other formats
  for (int t = 0; t < count; ++t) {
    std::array<int, 4> corners{};
    for (int& node : corners) node = words.integer(1, last_node) - 1;
    file.mesh.corners.push_back(corners);
    file.regions.push_back(words.integer(-kLargestReference, kLargestReference));
  }
}

}  // namespace

TetFile parse_medit(std::string_view bytes, const std::string& file_name) {
  Words words(file_name, bytes, '#');
  if (words.next() != "MeshVersionFormatted") {
    throw words.error("is no Medit mesh in text form (\"MeshVersionFormatted\" is missing); write it as ASCII");
  }
  words.integer(1, 4);
  TetFile file;
  while (!words.at_end()) {
    const std::string_view word = words.next();
    if (word == "End") break;
    if (word == "Dimension") words.integer(3, 3);
    if (word == "Vertices") read_vertices(words, file.mesh);
    if (word == "Tetrahedra") read_tetrahedra(words, file);
    // Every other section is read over word by word: its numbers do not look like a keyword.
  }
  if (file.mesh.corners.empty()) throw words.error("the file holds no Tetrahedra; mesh the volume first");
  return file;
}

TetFile read_medit(const std::filesystem::path& path) {
  return parse_medit(read_file(path), path.string());
}

}  // namespace myotact::geometry

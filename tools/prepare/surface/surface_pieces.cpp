#include "prepare/surface/surface_pieces.h"

#include <map>

#include "prepare/surface/edge_table.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

/// The lowest vertex that each one hangs together with.
std::vector<int> roots_of(const TriangleMesh& mesh) {
  Groups groups(mesh.positions_m.size());
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 1; k < 3; ++k) groups.join(triangle[0], triangle[k]);
  }
  std::vector<int> roots;
  for (int v = 0; v < static_cast<int>(mesh.positions_m.size()); ++v) roots.push_back(groups.group_of(v));
  return roots;
}

}  // namespace

std::vector<TriangleMesh> pieces_of(const TriangleMesh& mesh) {
  const std::vector<int> root = roots_of(mesh);
  std::map<int, std::size_t> piece_of_root;
  std::vector<TriangleMesh> pieces;
  std::vector<int> index(mesh.positions_m.size(), -1);  // in its piece
  const auto piece_at = [&](int vertex) -> TriangleMesh& {
    const auto [found, added] = piece_of_root.try_emplace(root[static_cast<std::size_t>(vertex)], pieces.size());
    if (added) pieces.emplace_back();
    return pieces[found->second];
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) piece_at(mesh.triangles[t][0]);  // order of first triangles
  for (const auto& triangle : mesh.triangles) {
    for (const int v : triangle) index[static_cast<std::size_t>(v)] = 0;
  }
  for (int v = 0; v < static_cast<int>(index.size()); ++v) {
    if (index[static_cast<std::size_t>(v)] < 0) continue;  // no triangle uses it
    TriangleMesh& piece = piece_at(v);
    index[static_cast<std::size_t>(v)] = static_cast<int>(piece.positions_m.size());
    piece.positions_m.push_back(mesh.positions_m[static_cast<std::size_t>(v)]);
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    piece_at(a).triangles.push_back(
        {index[static_cast<std::size_t>(a)], index[static_cast<std::size_t>(b)], index[static_cast<std::size_t>(c)]});
  }
  return pieces;
}

std::vector<int> piece_of_triangles(const TriangleMesh& mesh) {
  const std::vector<int> root = roots_of(mesh);
  std::vector<int> piece_of_root(mesh.positions_m.size(), -1);
  std::vector<int> pieces;
  int count = 0;
  for (const auto& triangle : mesh.triangles) {
    int& piece = piece_of_root[static_cast<std::size_t>(root[static_cast<std::size_t>(triangle[0])])];
    if (piece < 0) piece = count++;
    pieces.push_back(piece);
  }
  return pieces;
}

void append(TriangleMesh& mesh, const TriangleMesh& part) {
  const int base = static_cast<int>(mesh.positions_m.size());
  mesh.positions_m.insert(mesh.positions_m.end(), part.positions_m.begin(), part.positions_m.end());
  for (const auto& [a, b, c] : part.triangles) mesh.triangles.push_back({a + base, b + base, c + base});
}

}  // namespace myotact::prepare

#include "geometry/tet_topology.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace myotact::geometry {

namespace {

/// Corners of a tet's faces, counter-clockwise seen from outside.
constexpr std::array<std::array<std::size_t, 3>, 4> kFaces = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

struct Face {
  std::array<int, 3> sorted{};
  std::size_t tet = 0;
  std::size_t face = 0;
};

std::vector<Face> all_faces(const TetMesh& mesh) {
  std::vector<Face> faces;
  faces.reserve(4 * mesh.corners.size());
  for (std::size_t tet = 0; tet < mesh.corners.size(); ++tet) {
    for (std::size_t f = 0; f < kFaces.size(); ++f) {
      Face face{{}, tet, f};
      for (std::size_t k = 0; k < 3; ++k) face.sorted[k] = mesh.corners[tet][kFaces[f][k]];
      std::sort(face.sorted.begin(), face.sorted.end());
      faces.push_back(face);
    }
  }
  return faces;
}

std::size_t edge_between(std::size_t a, std::size_t b) {
  for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
    const auto first = static_cast<std::size_t>(kTetEdges[e][0]);
    const auto second = static_cast<std::size_t>(kTetEdges[e][1]);
    if ((first == a && second == b) || (first == b && second == a)) return e;
  }
  return 0;  // not reached: every two corners of a tet have an edge
}

BoundaryTriangle triangle_of(const TetMesh& mesh, const Face& face) {
  BoundaryTriangle triangle;
  const auto& corners = kFaces[face.face];
  for (std::size_t k = 0; k < 3; ++k) {
    triangle.corners[k] = mesh.corners[face.tet][corners[k]];
    if (!mesh.quadratic()) continue;
    triangle.midsides[k] = mesh.midsides[face.tet][edge_between(corners[k], corners[(k + 1) % 3])];
  }
  return triangle;
}

/// The representative of an entry's set; halves the path on the way.
int root_of(std::vector<int>& parent, int entry) {
  while (parent[static_cast<std::size_t>(entry)] != entry) {
    int& above = parent[static_cast<std::size_t>(entry)];
    above = parent[static_cast<std::size_t>(above)];
    entry = above;
  }
  return entry;
}

void join(std::vector<int>& parent, int a, int b) {
  const int root = root_of(parent, a);
  parent[static_cast<std::size_t>(root_of(parent, b))] = root;
}

/// Sets counted from 0 in the order in which they first appear.
std::vector<int> numbered_in_order(const std::vector<int>& set_of_tet) {
  std::map<int, int> number;
  std::vector<int> numbers;
  for (const int set : set_of_tet)
    numbers.push_back(number.emplace(set, static_cast<int>(number.size())).first->second);
  return numbers;
}

}  // namespace

std::vector<BoundaryTriangle> boundary_triangles(const TetMesh& mesh) {
  std::vector<Face> faces = all_faces(mesh);
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.sorted < b.sorted; });
  std::vector<Face> alone;
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t end = i + 1;
    while (end < faces.size() && faces[end].sorted == faces[i].sorted) ++end;
    if (end == i + 1) alone.push_back(faces[i]);
    i = end;
  }
  std::sort(alone.begin(), alone.end(),
            [](const Face& a, const Face& b) { return a.tet != b.tet ? a.tet < b.tet : a.face < b.face; });
  std::vector<BoundaryTriangle> triangles;
  for (const Face& face : alone) triangles.push_back(triangle_of(mesh, face));
  return triangles;
}

std::vector<int> connected_parts(const TetMesh& mesh) {
  std::vector<int> parent(mesh.nodes_m.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const auto& corners : mesh.corners) {
    for (const int node : corners) join(parent, corners[0], node);
  }
  std::vector<int> set_of_tet;
  for (const auto& corners : mesh.corners) set_of_tet.push_back(root_of(parent, corners[0]));
  return numbered_in_order(set_of_tet);
}

std::vector<int> face_connected_blocks(const TetMesh& mesh) {
  std::vector<Face> faces = all_faces(mesh);
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.sorted < b.sorted; });
  std::vector<int> parent(mesh.corners.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (std::size_t i = 1; i < faces.size(); ++i) {
    if (faces[i].sorted != faces[i - 1].sorted) continue;
    join(parent, static_cast<int>(faces[i - 1].tet), static_cast<int>(faces[i].tet));
  }
  std::vector<int> set_of_tet;
  for (std::size_t tet = 0; tet < parent.size(); ++tet) set_of_tet.push_back(root_of(parent, static_cast<int>(tet)));
  return numbered_in_order(set_of_tet);
}

}  // namespace myotact::geometry

#include "geometry/tet_mesh.h"

#include <map>
#include <utility>

#include <Eigen/Geometry>

namespace myotact::geometry {

double corner_volume_m3(const TetMesh& mesh, std::size_t tet) {
  const auto& c = mesh.corners[tet];
  const Vec3& origin = mesh.nodes_m[static_cast<std::size_t>(c[0])];
  const Vec3 a = mesh.nodes_m[static_cast<std::size_t>(c[1])] - origin;
  const Vec3 b = mesh.nodes_m[static_cast<std::size_t>(c[2])] - origin;
  const Vec3 d = mesh.nodes_m[static_cast<std::size_t>(c[3])] - origin;
  return a.cross(b).dot(d) / 6.0;
}

double total_volume_m3(const TetMesh& mesh) {
  double volume = 0.0;
  for (std::size_t tet = 0; tet < mesh.corners.size(); ++tet) volume += corner_volume_m3(mesh, tet);
  return volume;
}

TetMesh make_quadratic(const TetMesh& linear, std::vector<std::array<int, 2>>* edge_of_added_node) {
  TetMesh mesh{linear.nodes_m, linear.corners, {}};
  std::map<std::pair<int, int>, int> node_of_edge;
  for (const auto& tet : linear.corners) {
    std::array<int, 6> midsides{};
    for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
      const int a = tet[static_cast<std::size_t>(kTetEdges[e][0])];
      const int b = tet[static_cast<std::size_t>(kTetEdges[e][1])];
      const auto [found, added] = node_of_edge.try_emplace(std::minmax(a, b), static_cast<int>(mesh.nodes_m.size()));
      if (added) {
        const Vec3 middle =
            0.5 * (mesh.nodes_m[static_cast<std::size_t>(a)] + mesh.nodes_m[static_cast<std::size_t>(b)]);
        mesh.nodes_m.push_back(middle);
        if (edge_of_added_node != nullptr) edge_of_added_node->push_back({a, b});
      }
      midsides[e] = found->second;
    }
    mesh.midsides.push_back(midsides);
  }
  return mesh;
}

}  // namespace myotact::geometry

#include "prepare/remesh/crossing_triangles.h"

#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include "prepare/cgal_mesh.h"

namespace myotact::prepare {

std::vector<std::pair<int, int>> crossing_triangles(const geometry::TriangleMesh& mesh, unsigned most) {
  const CgalMesh surface = to_cgal(mesh);
  std::vector<std::pair<CgalMesh::Face_index, CgalMesh::Face_index>> found;
  CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(found),
                                                    CGAL::parameters::maximum_number(most));
  std::vector<std::pair<int, int>> pairs;
  for (const auto& [a, b] : found) pairs.emplace_back(static_cast<int>(a.idx()), static_cast<int>(b.idx()));
  return pairs;
}

}  // namespace myotact::prepare

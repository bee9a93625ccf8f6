#pragma once

#include <array>
#include <vector>

#include "core/vector.h"
#include "geometry/triangle_tree.h"
#include "simulation/bone_contact.h"
#include "simulation/muscle_tissue.h"

namespace myotact::simulation {

struct Limb;
class WorkerPool;

/// The surface of a muscle as its neighbours touch it, and which of them it touches. Faces of quadratic tets are four
/// flat triangles.
struct TouchSurface {
  /// A face under a node.
  struct Found {
    int node = -1;  // of the list below
    int other = -1;
    int triangle = -1;
    std::array<double, 3> weights{};
    Vec3 normal_W = Vec3::Zero();
  };
  std::vector<SurfaceNode> nodes;  // free ones
  /// How deep each of them lies in each other muscle at the file pose; empty for a muscle that none lies in. Below 0:
  /// too deep to tell which face it lies under, so it touches none.
  std::vector<std::vector<double>> rest_depths_m;
  geometry::TriangleTree tree;  // over the mesh's nodes
  std::vector<Vec3> normals_W;  // one a node of the mesh, of length 0 inside
  Eigen::AlignedBox3d box;
  /// Of each node and other muscle: how far both may travel, from the start on, before they can come within reach.
  std::vector<std::vector<double>> clear_until_m;
  std::vector<std::vector<int>> last_triangles;  // that were nearest, or -1: the next ones are no farther
  double travelled_m = 0.0;                      // sum of the largest ways of a node from one search to the next
  Eigen::VectorXd searched_at_m;                 // node positions of the last search
  std::vector<Found> found;
};

/// Surfaces of all muscles that are not rigid, at the file pose, with the depths that count as touching.
std::vector<TouchSurface> make_touch_surfaces(const std::vector<MuscleTissue*>& tissues);

/// Which faces the muscles' nodes are over in the present positions, as far as a step may bring them to touch; also
/// sees the neighbours. The result does not depend on the workers.
void find_touches(Limb& limb, WorkerPool& workers);

/// The same where something has moved since; else the faces stay, and the neighbours are seen.
void follow_touches(Limb& limb, WorkerPool& workers);

/// Takes over where the neighbours' nodes are now.
void see_neighbours(Limb& limb);

}  // namespace myotact::simulation

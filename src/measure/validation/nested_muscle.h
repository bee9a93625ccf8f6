#pragma once

#include <string>
#include <vector>

#include "geometry/tet_mesh.h"
#include "simulation/solid/solid.h"

namespace myotact::measure {

/// A muscle's linear mesh with what must stay the same when it is refined: which end holds each node, which tets are
/// tendon, and which tets of the coarsest mesh carry the loads.
struct NestedMuscle {
  geometry::TetMesh mesh;
  std::vector<Vec3> fibre;       // of each tet
  std::vector<char> tendon;      // of each tet
  std::vector<int> end;          // of each node: 0 origin, 1 insertion, -1 neither; tendon belongs to its end
  std::vector<char> end_tets;    // of each tet: it, or the one it is a part of, touches the insertion
  std::vector<char> belly_tets;  // lies in the middle of the muscle
  Vec3 axis = Vec3::UnitX();     // from origin to insertion, unit
  Vec3 across = Vec3::UnitY();   // unit
  int refinements = 0;
};

/// A muscle by name from a specimen in meshes/ of the data folder. Throws as read_vtk().
NestedMuscle read_nested_muscle(const std::string& specimen, const std::string& name);

/// The same muscle of eight times as many tets; the first nodes are its own.
NestedMuscle refine_muscle(const NestedMuscle& muscle);

/// The end that holds each node of a solid built on the muscle's mesh: a mid-side node is held where both corners are.
std::vector<int> ends_of_nodes(const NestedMuscle& muscle, const simulation::Solid& solid);

/// Shares of a force spread evenly over the volume of the tets at the insertion, one a node of the solid, sum 1; and of
/// one spread evenly over the surface of the middle on the side that `across` points to.
Eigen::VectorXd insertion_shares(const NestedMuscle& muscle, const simulation::Solid& solid);
Eigen::VectorXd belly_shares(const NestedMuscle& muscle, const simulation::Solid& solid);

}  // namespace myotact::measure

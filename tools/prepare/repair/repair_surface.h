#pragma once

#include <string>
#include <vector>

#include "geometry/triangle_mesh.h"

// From any heap of triangles to a surface that encloses a body: closed, manifold, wound outward, free of crossings. Or
// a refusal that names the cause, the place, the value, the limit and the remedy. README.md gives the order.

namespace myotact::prepare {

/// Lengths are parts of the diagonal of the surface's box, areas parts of its area, so that units make no difference.
struct RepairSettings {
  double tolerance = 0.005;     // how far the surface may move; a fifth of a usual triangle's edge
  double largest_hole = 0.05;   // area of the smallest patch over a hole; a larger one would be guessed
  double all_holes = 0.15;      // the same for all holes together
  double all_fins = 0.10;       // more than this hanging outside is rather a part of the body with a hole at its foot
  double debris = 0.01;         // a loose piece with less area is a speck of the scan
  double all_debris = 0.10;     // more than this in specks: the surface is shattered
  double floater = 0.05;        // a second body with less area goes, when there must be one
  bool several_bodies = false;  // bones of a paw lie in one file; a muscle is one body
};

/// A kind of repair, how often, and one place.
struct RepairStep {
  std::string what;
  int count = 0;
  Vec3 place_m = Vec3::Zero();
};

struct RepairResult {
  geometry::TriangleMesh mesh;
  std::vector<RepairStep> steps;  // empty: `mesh` is the input, bit for bit
  /// How far the surface moved, both ways: see hausdorff.h for what counts.
  double hausdorff_m = 0.0;
  Vec3 hausdorff_place_m = Vec3::Zero();
};

/// Throws Error BadData. Vertices that were not moved keep their coordinates bit for bit. Deterministic.
RepairResult repair_surface(const std::string& name, const geometry::TriangleMesh& raw,
                            const RepairSettings& settings = {});

/// "12 welded vertices at (0.1, 0.2, 0.3) m".
std::string step_text(const RepairStep& step);

}  // namespace myotact::prepare

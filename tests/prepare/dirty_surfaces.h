#pragma once

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "geometry/triangle_mesh.h"

// Closed bodies and everything that scans, exports and editors do to them.

namespace myotact::testing {

/// A closed body of rings about a bent line, outward: vertex 1 + ring * sides + side, the two ends first and last.
struct TubeBody {
  std::string name;
  int rings = 0, sides = 0;
  geometry::TriangleMesh mesh;

  int vertex(int ring, int side) const { return 1 + ring * sides + side % sides; }
  int last() const { return 1 + rings * sides; }
};

TubeBody sphere_body();  // radius 50 mm
TubeBody muscle_body();  // a spindle of 150 mm, bent
TubeBody sheet_body();   // a strap of 120 x 60 x 4 mm
std::vector<TubeBody> dirty_bodies();

geometry::TriangleMesh torus_surface();

enum class Expected { Untouched, Repaired, Refused };

struct DirtyKind {
  std::string name;
  std::function<geometry::TriangleMesh(const TubeBody&, std::mt19937&)> make;
  Expected expected = Expected::Repaired;
  std::string cause;               // a word of the refusal, or of a repair step
  double volume_tolerance = 0.01;  // relative to `volume`
  double volume = 1.0;             // what is expected, relative to the clean body's; 0: any above none
  double unit = 1.0;               // the dirty surface's coordinates are this times metres
};

/// Defects of a body, each made on every one of dirty_bodies().
std::vector<DirtyKind> body_defects();
std::vector<DirtyKind> piece_defects();
/// Inputs that do not start from a body.
std::vector<DirtyKind> lone_surfaces();

}  // namespace myotact::testing

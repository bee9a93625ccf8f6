#pragma once

#include <vector>

#include "simulation/element/tet_elements.h"

// The passive part of a mass-spring muscle: a preview that takes a quarter of the time of the finite elements, because
// it stands on the mesh's corners alone.
//
//   energy = sum over edges of 1/2 k (l - L)^2  +  sum over tets of 1/2 kVolumeSpring_Pa V (J - 1)^2
//
// Each tet gives each of its edges k = scale 5/2 mu V / L^2 (Van Gelder, J Graphics Tools 3:21, 1998, with E = 5/2 mu).
// That is the stiffness at which regular tets of all orientations resist shear like a solid of shear modulus mu: six
// springs of one length hold 1/2 (k L^2 / V) sum (n . strain n)^2 a volume, whose mean over all orientations is that of
// a solid with lambda = mu = 2/5 k L^2 / V. A net of springs cannot have another Poisson's ratio than this 1/4; the
// volume springs bring it near that of muscle. The deviation of a mesh of few, unequal tets is compensated by the one
// scale.

namespace myotact::simulation {

/// Over the stiffness of Van Gelder's springs: at this a round press of 6 mm radius on the relaxed long head of the
/// forelimb's triceps gives way as its finite elements do. On the other muscles of that specimen it gives way 0.8 to
/// 1.25 times as far, under its own weight a muscle 1 to 1.6 times. It is below 1 because tets that keep their volume
/// one by one stiffen a coarse mesh, most of all an irregular one as tetrahedral meshers make it: a bar of regular
/// cells carries more, and with this scale it gives way 2 to 3 times as far.
inline constexpr double kSpringScale = 0.2;

/// Of the volume springs, a fifth of the tissue's bulk modulus (kBulk_Pa). The forelimb's muscles then keep their
/// volume within 2 % when they pull with all force at rest and 3 % in motion (half of it: 4 and 5 %); more stiffens the
/// linear tets, which follow the volume of each tet: the compliance falls by a tenth when this is doubled.
inline constexpr double kVolumeSpring_Pa = 600e3;

/// Edges of a tet, and the two corners of one (0 .. 3), in the order of geometry::kTetEdges.
inline constexpr std::size_t kTetEdgeCount = 6;
constexpr std::array<std::size_t, 2> edge_nodes(std::size_t edge) {
  return {static_cast<std::size_t>(geometry::kTetEdges[edge][0]),
          static_cast<std::size_t>(geometry::kTetEdges[edge][1])};
}

/// Springs along the edges of eight tets, edges in the order of geometry::kTetEdges; each the tet's own share.
struct EdgeSprings {
  std::array<Eight, kTetEdgeCount> length_m{};  // at rest
  std::array<Eight, kTetEdgeCount> stiffness_N_m{};
};

/// Eight tets of a mass-spring muscle.
struct SpringBatch {
  TetBatch<LinearTet> tets;  // slots in the matrix of free nodes
  EdgeSprings edges;
};

/// Eight deformed tets with the nominal stress of their fibres and its slope against the stretch.
struct SpringTets {
  const SpringBatch& batch;
  const TetNodeVectors<Eight, LinearTet>& position_m;  // W
  const Point<Eight>& point;                           // deform_batch() of these positions
  Eight stress_Pa, slope_Pa;                           // of the fibres, see FibreStress
};

/// Forces that hold the deformed tets (slope of their energy): edges, volume springs and fibres. Overwrites; W.
void spring_forces(const SpringTets& tets, TetNodeVectors<Eight, LinearTet>& force_N);

/// Slope of the forces against the positions. Overwrites. `definite` drops what could make it indefinite: the geometric
/// part of compressed edges and fibres, and the curvature of the volume ratio.
void spring_stiffness(const SpringTets& tets, bool definite, TetBlocks<Eight, LinearTet>& blocks_N_m);

/// Slope of the fibres' stretch times the tets' volume against the node positions [m^2].
void spring_stretch_slopes(const SpringTets& tets, TetNodeVectors<Eight, LinearTet>& slope_m2);

}  // namespace myotact::simulation

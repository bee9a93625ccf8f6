#pragma once

#include <vector>

#include "anatomy/specimen.h"
#include "core/vector.h"
#include "geometry/tet_mesh.h"
#include "prepare/architecture/fibre_field.h"
#include "prepare/field/local_radius.h"

namespace myotact::prepare {

/// A muscle cut across its fibres into slices of equal volume, from origin to insertion.
struct MuscleProfile {
  std::vector<double> section_m2;      // one a slice: cross-section along the fibres, bounded against the poles
  std::vector<double> arc_m;           // one a slice: way along the fibres from the origin to its middle
  std::vector<Vec3> centre_m;          // one a slice: where the fibres' flux is centred
  std::vector<double> radius_m;        // one a slice: mean of balls that fit in there; empty: not measured
  double length_m = 0.0;               // of the whole way along the fibres
  std::vector<double> tet_arc_m;       // one a tet: way from the origin to the slice surface through its centre
  std::vector<double> tet_section_m2;  // one a tet: section_m2 between the slices
};

/// Slices by the potential at the tets' centres.
MuscleProfile slice_muscle(const geometry::TetMesh& tets, const FibreField& field);

/// Fills in radius_m by balls inside the muscle's fine surface: a coarse cage makes thick ends of thin tendons.
void measure_radii(const std::vector<TouchingBall>& balls, const geometry::TetMesh& tets, MuscleProfile& profile);

/// Whether the muscle is a slender tendon so far from its origin.
bool is_slender(const MuscleProfile& profile, double arc_m);

/// Ways along the fibres at which the belly begins and ends; 0 and length_m where an end is fleshy.
struct BellySpan {
  double begin_m = 0.0;
  double end_m = 0.0;
};

/// Tendon is the part from an end to where the section first exceeds 45 % of its largest, but the belly keeps at least
/// half of the length. Slender slices are tendon, too, however many branches lie side by side: together the four to a
/// paw's digits are as wide as the belly.
BellySpan find_belly(const MuscleProfile& profile);

/// Belly or tendon, one a tet.
std::vector<anatomy::TissueRegion> mark_regions(const MuscleProfile& profile, const BellySpan& belly);

/// Makes the belly's tets that lie on a patch with a face aponeurosis: of a pennate muscle, whose fibres end there.
void mark_aponeuroses(const geometry::TetMesh& tets, const AttachmentPatches& patches,
                      std::vector<anatomy::TissueRegion>& regions);

}  // namespace myotact::prepare

#pragma once

#include <optional>

#include "prepare/repair/repair_job.h"

// The stages after the soup: from a surface with holes and several pieces to bodies.

namespace myotact::prepare {

/// Drops loose pieces that are specks of the scan. Refuses a surface that is shattered into specks.
void drop_debris(RepairJob& job);

/// Spans every hole with a patch that continues the surface around it. Refuses holes above the settings' limits.
/// Afterwards the surface is closed and manifold.
void close_holes(RepairJob& job);

/// Drops pieces inside others (cavities, inner shells) and winds the rest outward. Refuses pieces without volume.
void settle_pieces(RepairJob& job);

/// Takes out crossings of a piece with itself, by local repair, else by resample().
void remove_crossings(RepairJob& job);

/// Unites pieces that cross each other and drops floaters. Refuses several bodies where one is asked for.
void unite_pieces(RepairJob& job);

/// The last resort for a piece that crosses itself beyond local repair: a new surface round what it winds round more
/// than half a time, on a lattice of about the tolerance [working coordinates]. Folds inside vanish. Nothing when parts
/// that are inside out would be lost.
std::optional<geometry::TriangleMesh> resample(const geometry::TriangleMesh& piece, double tolerance);

}  // namespace myotact::prepare

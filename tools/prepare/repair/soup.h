#pragma once

#include "prepare/repair/repair_job.h"

// The stages that work on a mere heap of triangles, in this order. After them every edge has one triangle or two wound
// alike, and the triangles around a vertex form one fan, or open fans that meet there at the corners of holes.

namespace myotact::prepare {

/// Refuses input that has no triangles, indices without a vertex, or coordinates that are not finite.
void check_input(const std::string& name, const geometry::TriangleMesh& raw);

/// Joins vertices in one place and drops the triangles that repeat a vertex then.
void weld_equal_vertices(RepairJob& job);

/// Drops triangles without height and second copies, whichever way they are wound. The edge opposite to the middle
/// corner of a flat triangle is left with a vertex on it; close_seams splits it there.
void drop_flat_triangles(RepairJob& job);
void drop_copies(RepairJob& job);

/// Joins vertices of open edges that lie near each other, and splits open edges at vertices that lie on them, in ever
/// wider reach while that leaves fewer edges open.
void close_seams(RepairJob& job);

/// Where edges have more than two triangles: keeps the skin between outside and inside; drops fins, sheets and inner
/// walls.
void drop_fins_and_walls(RepairJob& job);

/// Winds neighbours alike. Refuses a surface with one side only.
void wind_alike(RepairJob& job);

/// Gives every fan of triangles around a vertex a vertex of its own and pulls them apart a little. Fans with open edges
/// stay together until the holes are closed.
void split_shared_vertices(RepairJob& job);

}  // namespace myotact::prepare

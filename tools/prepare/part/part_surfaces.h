#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/triangle_mesh.h"
#include "prepare/recipe/named_surface.h"

namespace myotact::prepare {

/// What parting did to one muscle.
struct PartReport {
  double volume_before_m3 = 0.0;
  double volume_lost_m3 = 0.0;  // to neighbours, bones and the clearance between them
  double dropped_m3 = 0.0;      // of that: loose ends and flaps too thin to be muscle
  bool kept_core = false;       // would have been cut in two: its core stays, and overlaps what cut it
  bool filmed = false;          // would have been pierced: its middle layer closes the holes
  int added_genus = 0;          // holes through it that it did not have before
  std::vector<std::pair<double, std::string>> gave_way;  // to bones and muscles: overlap [m3], key; largest first
  std::vector<std::string> hosts;  // neighbours that it lies in for the most part: they were hollowed out for it
};

struct PartSettings {
  /// Left free between parted neighbours, so that their skins, made of flat triangles, do not touch [m].
  double clearance_m = 1e-4;
  /// A muscle with more than this part of its volume inside a neighbour is nested: it keeps its shape, the neighbour
  /// is hollowed out. A shared middle surface would leave nothing of it.
  double nested = 0.5;
  int threads = 1;
};

/// Removes the overlaps of muscles with each other and with bones. Bones keep their shape. Two muscles meet at the
/// surface that lies equally deep in both; a nested one keeps its shape. Where a muscle would reach through a thin
/// neighbour, it leaves the middle layer to that. Muscles that touch nothing pass through bit for bit. Surfaces must be
/// closed, outward and free of crossings. Throws Error BadData naming the muscle when nothing would be left of it.
/// `done` is called after each muscle, from any thread.
std::vector<PartReport> part_surfaces(std::vector<NamedSurface>& muscles, const std::vector<NamedSurface>& bones,
                                      const PartSettings& settings = {}, const std::function<void()>& done = {});

}  // namespace myotact::prepare

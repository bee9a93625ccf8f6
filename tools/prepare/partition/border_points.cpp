#include "prepare/partition/border_points.h"

#include <algorithm>

#include "prepare/part/node_steps.h"

namespace myotact::prepare {

namespace {

constexpr int kRim = 2;

/// Calls visit(point, layer) for every point, layer 0 being the outermost; stops when it returns false.
template <class Visit>
bool for_each_point(const std::array<int, 3>& counts, Visit&& visit) {
  std::size_t point = 0;
  for (int z = 0; z < counts[2]; ++z) {
    const int z_layer = std::min(z, counts[2] - 1 - z);
    for (int y = 0; y < counts[1]; ++y) {
      const int row_layer = std::min({z_layer, y, counts[1] - 1 - y});
      for (int x = 0; x < counts[0]; ++x, ++point) {
        if (!visit(point, std::min({row_layer, x, counts[0] - 1 - x}))) return false;
      }
    }
  }
  return true;
}

}  // namespace

bool has_free_rim(const Lattice& lattice, const Labels& labels) {
  return for_each_point(lattice.counts,
                        [&](std::size_t point, int layer) { return layer >= kRim || labels[point] == 0; });
}

std::vector<std::size_t> border_points(const Lattice& lattice, const Labels& labels) {
  const NodeSteps steps(lattice.counts);
  std::vector<std::size_t> border;
  for_each_point(lattice.counts, [&](std::size_t point, int layer) {
    if (layer == 0) return true;
    const bool mixed = std::any_of(steps.linked.begin(), steps.linked.end(), [&](std::ptrdiff_t step) {
      return labels[NodeSteps::go(point, step)] != labels[point];
    });
    if (mixed) border.push_back(point);
    return true;
  });
  return border;
}

}  // namespace myotact::prepare

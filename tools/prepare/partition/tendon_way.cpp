#include "prepare/partition/tendon_way.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "prepare/part/simple_point.h"
#include "prepare/partition/point_box.h"

namespace myotact::prepare {

namespace {

/// The box around both ends is wider than they span by this part of their distance and so many steps: room to go round
/// a bone.
constexpr double kDetour = 0.4;
constexpr int kRoom = 10;
/// What a step costs beside bone and through another muscle, in steps through the free.
constexpr float kBesideBone = 2.0F, kThroughMuscle = 12.0F;
/// A part is thin where no block of so many points to each side of a middle fits into it: a tendon through it would
/// leave less than a point on one side.
constexpr std::ptrdiff_t kAround = 2;
/// Rounds in which each place moves halfway to the middle of its neighbours: over some eight steps, the corners of a
/// lattice's way are gone.
constexpr int kRounds = 16;

class Search {
 public:
  Search(const TendonGround& ground, const PointBox& box)
      : ground_(ground), box_(box), steps_(ground.volume().lattice.counts) {}

  /// From the lattice point `from` to the muscle's first one; empty: there is none.
  std::vector<std::size_t> run(std::size_t from) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    std::vector<float> costs(box_.size(), kInfinity);
    std::vector<std::uint32_t> before(box_.size(), 0);
    using Entry = std::pair<float, std::size_t>;  // cost, number in the box
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const std::size_t start = box_.to_box(from);
    costs[start] = 0.0F;
    open.push({0.0F, start});
    while (!open.empty()) {
      const auto [cost, here] = open.top();
      open.pop();
      if (cost > costs[here]) continue;
      const std::size_t point = box_.to_lattice(here);
      if (ground_.own(point)) return way_back(before, here, start);
      if (on_rim(box_.counts, here)) continue;
      for (std::size_t bit = 0; bit < steps_.block.size(); ++bit) {
        const std::size_t next = NodeSteps::go(point, steps_.block[bit]);
        const float step = step_cost(bit, next);
        if (step == kInfinity) continue;
        const std::size_t there = box_.to_box(next);
        if (cost + step >= costs[there]) continue;
        costs[there] = cost + step;
        before[there] = static_cast<std::uint32_t>(here);
        open.push({costs[there], there});
      }
    }
    return {};
  }

 private:
  float step_cost(std::size_t bit, std::size_t to) const {
    if (ground_.closed(to)) return std::numeric_limits<float>::infinity();
    const int moved = (bit % 3 != 1 ? 1 : 0) + (bit / 3 % 3 != 1 ? 1 : 0) + (bit / 9 != 1 ? 1 : 0);
    const float length = std::sqrt(static_cast<float>(moved));
    if (ground_.own(to)) return length;
    return length * (ground_.other_muscle(to) ? kThroughMuscle : ground_.beside_bone(to) ? kBesideBone : 1.0F);
  }

  std::vector<std::size_t> way_back(const std::vector<std::uint32_t>& before, std::size_t end,
                                    std::size_t start) const {
    std::vector<std::size_t> way;
    for (std::size_t point = end; point != start; point = before[point]) way.push_back(box_.to_lattice(point));
    way.push_back(box_.to_lattice(start));
    std::reverse(way.begin(), way.end());
    return way;
  }

  const TendonGround& ground_;
  const PointBox& box_;
  NodeSteps steps_;
};

/// Where the ground is closed, corners stay corners.
void even_out(std::vector<Vec3>& places_m, const TendonGround& ground) {
  std::vector<Vec3> moved_m = places_m;
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 1; i + 1 < places_m.size(); ++i) {
      const Vec3 p_m = 0.5 * places_m[i] + 0.25 * (places_m[i - 1] + places_m[i + 1]);
      moved_m[i] = ground.closed(nearest_point(ground.volume().lattice, p_m)) ? places_m[i] : p_m;
    }
    places_m = moved_m;
  }
}

}  // namespace

TendonGround::TendonGround(const PartVolume& volume, const std::vector<bool>& bone, std::uint16_t part)
    : volume_(volume), bone_(bone), part_(part), steps_(volume.lattice.counts) {
  const std::ptrdiff_t row = volume.lattice.counts[0], layer = row * volume.lattice.counts[1];
  for (std::ptrdiff_t z = -kAround; z <= kAround; ++z) {
    for (std::ptrdiff_t y = -kAround; y <= kAround; ++y) {
      for (std::ptrdiff_t x = -kAround; x <= kAround; ++x) block_.push_back(x + y * row + z * layer);
    }
  }
}

bool TendonGround::closed(std::size_t point) const {
  return bone_[volume_.labels[point]] || (other_muscle(point) && thin(point));
}

bool TendonGround::beside_bone(std::size_t point) const {
  return std::any_of(steps_.linked.begin(), steps_.linked.end(),
                     [&](std::ptrdiff_t step) { return bone_[label(point, step)]; });
}

bool TendonGround::leaves_whole(std::size_t point) const {
  const std::uint16_t here = volume_.labels[point];
  if (here == 0) return true;
  Neighbourhood same = 0;
  for (std::size_t bit = 0; bit < steps_.block.size(); ++bit) {
    same |= label(point, steps_.block[bit]) == here ? Neighbourhood{1} << bit : 0U;
  }
  return is_simple(same);
}

bool TendonGround::other_muscle(std::size_t point) const {
  const std::uint16_t here = volume_.labels[point];
  return here != 0 && here != part_ && !bone_[here];
}

std::uint16_t TendonGround::label(std::size_t point, std::ptrdiff_t step) const {
  const std::size_t there = NodeSteps::go(point, step);
  return there < volume_.labels.size() ? volume_.labels[there] : std::uint16_t{0};
}

bool TendonGround::thin(std::size_t point) const {
  const std::uint16_t here = volume_.labels[point];
  const auto all_around = [&](std::ptrdiff_t middle) {
    return std::all_of(block_.begin(), block_.end(),
                       [&](std::ptrdiff_t step) { return label(point, middle + step) == here; });
  };
  return std::none_of(block_.begin(), block_.end(), all_around);
}

std::optional<std::vector<Vec3>> find_tendon_way(const TendonGround& ground, std::size_t from, std::size_t to) {
  const Lattice& lattice = ground.volume().lattice;
  const double span = (place_m(lattice, from) - place_m(lattice, to)).norm() / step_m(lattice);
  const int around = static_cast<int>(std::ceil(kDetour * span)) + kRoom;
  const PointBox box = box_around(std::vector<std::size_t>{from, to}, lattice, around);
  const std::vector<std::size_t> points = Search(ground, box).run(from);
  if (points.empty()) return {};
  std::vector<Vec3> places_m;
  for (const std::size_t point : points) places_m.push_back(place_m(lattice, point));
  even_out(places_m, ground);
  return places_m;
}

}  // namespace myotact::prepare

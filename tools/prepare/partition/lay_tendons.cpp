#include "prepare/partition/lay_tendons.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "prepare/part/node_steps.h"
#include "prepare/partition/point_box.h"
#include "prepare/partition/tendon_way.h"

namespace myotact::prepare {

namespace {

/// A muscle whose outermost points are as near to those of its bone is fixed as it is: between the surfaces there is
/// less [m].
constexpr double kNear_m = 2e-3;
/// With a smaller radius a tendon would fall to pieces where bone or another part cuts into it; thicker ones than this
/// are aponeuroses, whose area is spread wide [m].
constexpr double kThinnest_steps = 1.5, kThickest_m = 3e-3;
/// A tendon's points so near to its way become its own wherever the ground is open, even in the midst of a thick
/// muscle: so it hangs together.
constexpr double kCore_steps = 0.9;
/// How much of a muscle counts as its end [m].
constexpr double kEnd_m = 5e-3;
/// Where the recipe does not say how large an attachment is [m2]: a tendon of 3 mm.
constexpr double kUnknownArea_m2 = 7e-6;

struct Place {
  std::size_t point = 0;
  double distance_m = std::numeric_limits<double>::infinity();
};

using Points = std::vector<std::size_t>;

class Layer {
 public:
  Layer(PartVolume& volume, const std::vector<MuscleData>& muscles)
      : volume_(volume), steps_(volume.lattice.counts), bone_(volume.keys.size() + 1, true) {
    bone_[0] = false;
    for (const MuscleData& muscle : muscles) bone_[label_of(muscle.mechanics.key)] = false;
    collect_borders();
  }

  /// Nothing: the muscle reaches its bone, or one of the two is not there.
  std::optional<LaidTendon> lay(const MuscleData& muscle, const AttachmentSite& site) {
    const std::uint16_t part = label_of(muscle.mechanics.key);
    if (part == 0) return {};
    const Place on_bone = nearest_of(site.bones, site.point_m);
    if (!std::isfinite(on_bone.distance_m) || reaches(part, site.bones)) return {};
    const Vec3 from_m = place_m(volume_.lattice, on_bone.point);
    const Place on_muscle = nearest(borders_[part], from_m);
    if (!std::isfinite(on_muscle.distance_m)) return {};
    const TendonGround ground(volume_, bone_, part);
    const auto way_m = find_tendon_way(ground, on_bone.point, on_muscle.point);
    if (!way_m) return {};
    LaidTendon tendon{muscle.mechanics.key, volume_.keys[volume_.labels[on_bone.point] - std::size_t{1}],
                      on_muscle.distance_m, 0.0, radius_m(site, part, on_muscle.point)};
    for (std::size_t i = 1; i < way_m->size(); ++i) tendon.length_m += ((*way_m)[i] - (*way_m)[i - 1]).norm();
    fill(part, ground, *way_m, tendon.radius_m);
    return tendon;
  }

 private:
  /// 0: the volume has no such part.
  std::uint16_t label_of(const std::string& key) const {
    const auto found = std::find(volume_.keys.begin(), volume_.keys.end(), key);
    return found == volume_.keys.end() ? std::uint16_t{0}
                                       : static_cast<std::uint16_t>(found - volume_.keys.begin() + 1);
  }

  /// Of the attachment's area, but no more than the muscle's own end is wide.
  double radius_m(const AttachmentSite& site, std::uint16_t part, std::size_t end) const {
    const double area_m2 = site.area_m2 > 0.0 ? site.area_m2 : kUnknownArea_m2;
    const double thinnest_m = kThinnest_steps * step_m(volume_.lattice);
    const double radius_m = std::min({std::sqrt(area_m2 / std::numbers::pi), end_radius_m(part, end), kThickest_m});
    return std::max(radius_m, thinnest_m);
  }

  /// Of a tube whose end fills as much of a ball round the point as the part does.
  double end_radius_m(std::uint16_t part, std::size_t end) const {
    const double step = step_m(volume_.lattice);
    const PointBox box = box_around(Points{end}, volume_.lattice, static_cast<int>(std::ceil(kEnd_m / step)));
    std::size_t points = 0;
    for (std::size_t b = 0; b < box.size(); ++b) {
      const std::size_t point = box.to_lattice(b);
      if (volume_.labels[point] != part) continue;
      points += (place_m(volume_.lattice, point) - place_m(volume_.lattice, end)).norm() <= kEnd_m ? 1 : 0;
    }
    return std::sqrt(static_cast<double>(points) * std::pow(step, 3) / (std::numbers::pi * kEnd_m));
  }

  void collect_borders() {
    borders_.resize(volume_.keys.size() + 1);
    const std::vector<std::uint16_t>& labels = volume_.labels;
    for (std::size_t point = 0; point < labels.size(); ++point) {
      if (labels[point] == 0 || on_rim(volume_.lattice.counts, point)) continue;
      const bool border = std::any_of(steps_.linked.begin(), steps_.linked.end(), [&](std::ptrdiff_t step) {
        return labels[NodeSteps::go(point, step)] != labels[point];
      });
      if (border) borders_[labels[point]].push_back(point);
    }
  }

  Place nearest(const Points& border, const Vec3& p_m) const {
    Place best;
    for (const std::size_t point : border) {
      const double distance_m = (place_m(volume_.lattice, point) - p_m).norm();
      if (distance_m < best.distance_m) best = {point, distance_m};
    }
    return best;
  }

  Place nearest_of(const std::vector<std::string>& bones, const Vec3& p_m) const {
    Place best;
    for (const std::string& key : bones) {
      const std::uint16_t label = label_of(key);
      if (label == 0) continue;
      const Place place = nearest(borders_[label], p_m);
      if (place.distance_m < best.distance_m) best = place;
    }
    return best;
  }

  /// Whether the muscle comes as near to one of the bones as it should.
  bool reaches(std::uint16_t part, const std::vector<std::string>& bones) const {
    std::vector<bool> wanted(volume_.keys.size() + 1, false);
    for (const std::string& key : bones) wanted[label_of(key)] = true;
    wanted[0] = false;
    const auto around = static_cast<int>(std::ceil(kNear_m / step_m(volume_.lattice)));
    return std::any_of(borders_[part].begin(), borders_[part].end(), [&](std::size_t point) {
      const Vec3 here_m = place_m(volume_.lattice, point);
      const PointBox box = box_around(Points{point}, volume_.lattice, around);
      for (std::size_t b = 0; b < box.size(); ++b) {
        const std::size_t other = box.to_lattice(b);
        if (wanted[volume_.labels[other]] && (place_m(volume_.lattice, other) - here_m).norm() <= kNear_m) return true;
      }
      return false;
    });
  }

  void fill(std::uint16_t part, const TendonGround& ground, const std::vector<Vec3>& way_m, double radius_m) {
    Points along;
    for (const Vec3& p_m : way_m) along.push_back(nearest_point(volume_.lattice, p_m));
    const double step = step_m(volume_.lattice);
    const int around = static_cast<int>(std::ceil(radius_m / step + kLargestMargin)) + 1;
    const PointBox box = box_around(along, volume_.lattice, around);
    const auto depth = [&](std::size_t point) {  // in the tendon [steps]
      return (radius_m - distance_m(way_m, place_m(volume_.lattice, point))) / step;
    };
    const double core = radius_m / step - kCore_steps;
    const Points taken = take(part, along, [&](std::size_t point) {
      const double inside = depth(point);
      return inside > 0.0 && (inside >= core ? !ground.closed(point) : ground.leaves_whole(point));
    });
    for (std::size_t b = 0; b < box.size(); ++b) {
      const std::size_t point = box.to_lattice(b);
      const double inside = on_rim(volume_.lattice.counts, point) ? -kLargestMargin : depth(point);
      if (inside <= -kLargestMargin) continue;
      const bool is_taken = std::binary_search(taken.begin(), taken.end(), point);
      set_margin(point, part, inside, is_taken, ground.beside_bone(point));
    }
    borders_[part].insert(borders_[part].end(), taken.begin(), taken.end());
  }

  /// What hangs together with the way and may be taken becomes the part's, from the way outwards; sorted.
  template <class Take>
  Points take(std::uint16_t part, const Points& way, Take&& may_take) {
    Points taken;
    Points open = way;  // of the part, or about to be
    for (std::size_t next = 0; next < open.size(); ++next) {
      const std::size_t point = open[next];
      std::uint16_t& label = volume_.labels[point];
      if (on_rim(volume_.lattice.counts, point) || bone_[label]) continue;
      if (label != part) {
        if (!may_take(point)) continue;
        label = part;
        taken.push_back(point);
      } else if (next >= way.size()) {
        continue;
      }
      for (const std::ptrdiff_t step : steps_.linked) open.push_back(NodeSteps::go(point, step));
    }
    std::sort(taken.begin(), taken.end());
    return taken;
  }

  static double distance_m(const std::vector<Vec3>& way_m, const Vec3& p_m) {
    double nearest_m = (way_m.front() - p_m).norm();
    for (std::size_t i = 1; i < way_m.size(); ++i) {
      const Vec3 &a_m = way_m[i - 1], along_m = way_m[i] - way_m[i - 1];
      const double t = std::clamp(along_m.dot(p_m - a_m) / std::max(along_m.squaredNorm(), 1e-18), 0.0, 1.0);
      nearest_m = std::min(nearest_m, (a_m + t * along_m - p_m).norm());
    }
    return nearest_m;
  }

  /// Of a point so deep [steps] in the tendon, which was `taken` for it or belonged to whom it belongs.
  void set_margin(std::size_t point, std::uint16_t part, double depth, bool taken, bool beside_bone) {
    if (bone_[volume_.labels[point]]) return;  // the tendon ends there, and bone's border stays
    std::uint8_t& margin = volume_.margins[point];
    const double before = margin / kMarginsPerStep;
    double now = std::min(before, std::abs(depth));
    if (taken) {
      now = beside_bone ? now : depth;
    } else if (volume_.labels[point] == part) {
      now = std::max(before, std::min(depth, beside_bone ? before : kLargestMargin));
    }
    margin = static_cast<std::uint8_t>(std::lround(kMarginsPerStep * std::clamp(now, 0.0, kLargestMargin)));
  }

  PartVolume& volume_;
  NodeSteps steps_;
  std::vector<bool> bone_;       // one a label
  std::vector<Points> borders_;  // one a label: its points with a neighbour of another
};

}  // namespace

std::vector<LaidTendon> lay_tendons(PartVolume& volume, const std::vector<MuscleData>& muscles) {
  Layer layer(volume, muscles);
  std::vector<LaidTendon> laid;
  for (const MuscleData& muscle : muscles) {
    for (const auto* sites : {&muscle.origins, &muscle.insertions}) {
      for (const AttachmentSite& site : *sites) {
        if (auto tendon = layer.lay(muscle, site)) laid.push_back(std::move(*tendon));
      }
    }
  }
  return laid;
}

}  // namespace myotact::prepare

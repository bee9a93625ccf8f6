#include <algorithm>
#include <cmath>
#include <memory>

#include "prepare/field/signed_distance.h"
#include "prepare/parallel.h"
#include "prepare/part/overlap_measure.h"
#include "prepare/remesh/guarded_mesh.h"
#include "prepare/remesh/restore_volume.h"
#include "prepare/stages/stages.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

/// Rounds of moving apart; the depths halve with each.
constexpr int kRounds = 6;
/// What lies deeper was left so on purpose, because parting would have cut the muscle in two [m].
constexpr double kDeepest_m = 1.5e-3;
/// Skins come to lie this far apart [m].
constexpr double kClearance_m = 5e-5;
/// Skins may move by this part of their diagonal against the parted surface.
constexpr double kReach = 0.004;
constexpr double kLeastShape = 0.05;
/// Remaining overlaps of less depth are not worth a line in the specimen [m].
constexpr double kListedDepth_m = 5e-5;
/// The percentile of depths that is reported.
constexpr double kPercentile = 0.95;

struct Neighbour {
  const SignedDistance* skin = nullptr;
  bool moves = true;  // a muscle, which goes half of the way itself
};

using Fields = std::vector<std::unique_ptr<SignedDistance>>;

/// How far a point must move to be clear of the neighbours, and which way.
Vec3 depenetration(const Vec3& p, const std::vector<Neighbour>& neighbours) {
  Vec3 way = Vec3::Zero();
  for (const Neighbour& neighbour : neighbours) {
    if (!neighbour.skin->box().contains(p)) continue;
    const auto [distance_m, nearest_m] = neighbour.skin->nearest(p);
    if (distance_m >= kClearance_m || distance_m < -kDeepest_m || distance_m == 0.0) continue;
    const Vec3 outward = (distance_m < 0.0 ? Vec3(nearest_m - p) : Vec3(p - nearest_m)).normalized();
    const Vec3 step = (neighbour.moves ? 0.5 : 1.0) * (kClearance_m - distance_m) * outward;
    if (step.norm() > way.norm()) way = step;
  }
  return way;
}

/// How far a point may move in any direction so that the neighbours, who may come as far, are not met.
double room_around_m(const Vec3& p, const std::vector<Neighbour>& neighbours, double farthest_m) {
  double room_m = farthest_m;
  for (const Neighbour& neighbour : neighbours) {
    const double reach_m = kClearance_m + (neighbour.moves ? 2.0 : 1.0) * room_m;
    if (neighbour.skin->box().squaredExteriorDistance(p) > reach_m * reach_m) continue;
    const double free_m = (*neighbour.skin)(p)-kClearance_m;
    room_m = std::min(room_m, std::max(0.0, neighbour.moves ? 0.5 * free_m : free_m));
  }
  return room_m;
}

/// Asks measure(point) at vertices, middles of edges and centres of triangles; offer(vertex, answer) hears it for every
/// vertex that carries the point.
template <class Measure, class Offer>
void ask_all_over(const TriangleMesh& skin, Measure&& measure, Offer&& offer) {
  for (std::size_t v = 0; v < skin.positions_m.size(); ++v) offer(v, measure(skin.positions_m[v]));
  for (const auto& corners : skin.triangles) {
    Vec3 centre = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto from = static_cast<std::size_t>(corners[k]), to = static_cast<std::size_t>(corners[(k + 1) % 3]);
      centre += skin.positions_m[from] / 3.0;
      const auto answer = measure(0.5 * (skin.positions_m[from] + skin.positions_m[to]));
      offer(from, answer);
      offer(to, answer);
    }
    const auto answer = measure(centre);
    for (const int v : corners) offer(static_cast<std::size_t>(v), answer);
  }
}

/// One step for every vertex: the largest that a point which it carries asks for.
std::vector<Vec3> steps_m(const TriangleMesh& skin, const std::vector<Neighbour>& neighbours) {
  std::vector<Vec3> steps(skin.positions_m.size(), Vec3::Zero());
  ask_all_over(
      skin, [&](const Vec3& p) { return depenetration(p, neighbours); },
      [&](std::size_t v, const Vec3& step) {
        if (step.norm() > steps[v].norm()) steps[v] = step;
      });
  return steps;
}

Fields fields_of(const LimbWork& limb, int threads) {
  Fields fields(limb.muscles.size());
  for_each_index(fields.size(), threads,
                 [&](std::size_t m) { fields[m] = std::make_unique<SignedDistance>(limb.muscles[m].skin); });
  return fields;
}

std::vector<Neighbour> neighbours_of(const Fields& muscles, const Fields& bones, std::size_t m) {
  std::vector<Neighbour> neighbours;
  for (std::size_t other = 0; other < muscles.size(); ++other) {
    if (other != m && muscles[other]->box().intersects(muscles[m]->box())) {
      neighbours.push_back({muscles[other].get(), true});
    }
  }
  for (const auto& bone : bones) {
    if (bone->box().intersects(muscles[m]->box())) neighbours.push_back({bone.get(), false});
  }
  return neighbours;
}

double reach_m(const MuscleWork& muscle) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : muscle.surface.positions_m) box.extend(p);
  return kReach * box.diagonal().norm();
}

GuardedMesh guarded_skin(const MuscleWork& muscle) {
  const double edge_m =
      std::sqrt(geometry::surface_area_m2(muscle.skin) / static_cast<double>(muscle.skin.triangles.size()));
  return {muscle.skin, muscle.surface, reach_m(muscle), 2.0 * edge_m};
}

void move_apart(MuscleWork& muscle, const std::vector<Neighbour>& neighbours) {
  const std::vector<Vec3> steps = steps_m(muscle.skin, neighbours);
  if (std::all_of(steps.begin(), steps.end(), [](const Vec3& step) { return step.isZero(); })) return;
  GuardedMesh guarded = guarded_skin(muscle);
  for (std::size_t v = 0; v < steps.size(); ++v) {
    if (steps[v].isZero()) continue;
    guarded.try_move(OpenMesh::VertexHandle(static_cast<int>(v)), muscle.skin.positions_m[v] + steps[v], kLeastShape);
  }
  muscle.skin = guarded.take();
}

/// What moving apart took is given back where nothing is near.
void fill_out(MuscleWork& muscle, const std::vector<Neighbour>& neighbours) {
  const double farthest_m = reach_m(muscle);
  std::vector<double> room_m(muscle.skin.positions_m.size(), farthest_m);
  ask_all_over(
      muscle.skin, [&](const Vec3& p) { return room_around_m(p, neighbours, farthest_m); },
      [&](std::size_t v, double room) { room_m[v] = std::min(room_m[v], room); });
  GuardedMesh guarded = guarded_skin(muscle);
  restore_volume(guarded, geometry::enclosed_volume_m3(muscle.surface), std::move(room_m));
  muscle.skin = guarded.take();
}

/// How deep a muscle's vertices and triangles' centres lie inside its neighbours.
void report_depths(const TriangleMesh& skin, const std::vector<Neighbour>& neighbours, SurfaceReport& report) {
  std::vector<std::pair<double, Vec3>> depths_m;
  const auto measure = [&](const Vec3& p) {
    for (const Neighbour& neighbour : neighbours) {
      if (!neighbour.skin->box().contains(p)) continue;
      const double depth_m = -(*neighbour.skin)(p);
      if (depth_m > 0.0) depths_m.emplace_back(depth_m, p);
    }
  };
  for (const Vec3& p : skin.positions_m) measure(p);
  for (const auto& [a, b, c] : skin.triangles) {
    const auto at = [&](int v) -> const Vec3& { return skin.positions_m[static_cast<std::size_t>(v)]; };
    measure((at(a) + at(b) + at(c)) / 3.0);
  }
  if (depths_m.empty()) return;
  std::stable_sort(depths_m.begin(), depths_m.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  report.overlap_p95_m =
      depths_m[static_cast<std::size_t>(kPercentile * static_cast<double>(depths_m.size() - 1))].first;
  report.overlap_largest_m = depths_m.back().first;
  if (report.overlap_largest_m > kListedDepth_m) report.marks.push_back({MarkKind::Overlap, depths_m.back().second});
}

/// Lists what remains, muscle by muscle.
void list_overlaps(LimbWork& limb, const Fields& muscles, const Fields& bones, const std::vector<std::string>& names) {
  std::vector<std::vector<anatomy::Overlap>> found(muscles.size());
  for_each_index(muscles.size(), limb.settings.threads, [&](std::size_t m) {
    const std::string& key = limb.muscles[m].data.mechanics.key;
    report_depths(limb.muscles[m].skin, neighbours_of(muscles, bones, m), limb.muscles[m].report);
    const auto list = [&](const SignedDistance& other, const std::string& name) {
      const OverlapMeasure both = measure_overlap(*muscles[m], other);
      if (both.depth_m > kListedDepth_m) found[m].push_back({key, name, both.depth_m, both.volume_m3});
    };
    for (std::size_t n = m + 1; n < muscles.size(); ++n) list(*muscles[n], limb.muscles[n].data.mechanics.key);
    for (std::size_t b = 0; b < bones.size(); ++b) list(*bones[b], names[b]);
  });
  for (auto& overlaps : found) limb.overlaps.insert(limb.overlaps.end(), overlaps.begin(), overlaps.end());
}

}  // namespace

void settle_skins(LimbWork& limb, const PartDone& done) {
  Fields bones;
  std::vector<std::string> names;
  for (const BoneWork& bone : limb.bones) {
    bones.push_back(std::make_unique<SignedDistance>(bone.skin));
    names.push_back(bone.data.key);
  }
  for (int round = 0; round < kRounds; ++round) {
    const Fields muscles = fields_of(limb, limb.settings.threads);
    for_each_index(muscles.size(), limb.settings.threads,
                   [&](std::size_t m) { move_apart(limb.muscles[m], neighbours_of(muscles, bones, m)); });
  }
  const Fields muscles = fields_of(limb, limb.settings.threads);
  for_each_index(muscles.size(), limb.settings.threads, [&](std::size_t m) {
    fill_out(limb.muscles[m], neighbours_of(muscles, bones, m));
    done();
  });
  list_overlaps(limb, fields_of(limb, limb.settings.threads), bones, names);
}

}  // namespace myotact::prepare

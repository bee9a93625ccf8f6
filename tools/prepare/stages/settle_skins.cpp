#include <algorithm>
#include <cmath>
#include <memory>

#include "prepare/field/signed_distance.h"
#include "prepare/parallel.h"
#include "prepare/part/overlap_measure.h"
#include "prepare/remesh/guarded_mesh.h"
#include "prepare/stages/stages.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

/// Rounds of moving apart; the depths halve with each.
constexpr int kRounds = 4;
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
Vec3 way_out(const Vec3& p, const std::vector<Neighbour>& neighbours) {
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

/// One step for every vertex: its own, or the largest that a triangle's centre or an edge's middle asks for.
std::vector<Vec3> steps_m(const TriangleMesh& skin, const std::vector<Neighbour>& neighbours) {
  std::vector<Vec3> steps;
  for (const Vec3& p : skin.positions_m) steps.push_back(way_out(p, neighbours));
  const auto offer = [&](int v, const Vec3& step) {
    Vec3& known = steps[static_cast<std::size_t>(v)];
    if (step.norm() > known.norm()) known = step;
  };
  for (const auto& corners : skin.triangles) {
    Vec3 centre = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& a = skin.positions_m[static_cast<std::size_t>(corners[k])];
      const Vec3& b = skin.positions_m[static_cast<std::size_t>(corners[(k + 1) % 3])];
      centre += a / 3.0;
      const Vec3 step = way_out(0.5 * (a + b), neighbours);
      offer(corners[k], step);
      offer(corners[(k + 1) % 3], step);
    }
    const Vec3 step = way_out(centre, neighbours);
    for (const int v : corners) offer(v, step);
  }
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

void move_apart(MuscleWork& muscle, const std::vector<Neighbour>& neighbours) {
  const std::vector<Vec3> steps = steps_m(muscle.skin, neighbours);
  if (std::all_of(steps.begin(), steps.end(), [](const Vec3& step) { return step.isZero(); })) return;
  Eigen::AlignedBox3d box;
  for (const Vec3& p : muscle.surface.positions_m) box.extend(p);
  const double edge_m =
      std::sqrt(geometry::surface_area_m2(muscle.skin) / static_cast<double>(muscle.skin.triangles.size()));
  GuardedMesh guarded(muscle.skin, muscle.surface, kReach * box.diagonal().norm(), 2.0 * edge_m);
  for (std::size_t v = 0; v < steps.size(); ++v) {
    if (steps[v].isZero()) continue;
    guarded.try_move(OpenMesh::VertexHandle(static_cast<int>(v)), muscle.skin.positions_m[v] + steps[v], kLeastShape);
  }
  muscle.skin = guarded.take();
}

/// Depths of a muscle's vertices and triangle centres inside its neighbours [m].
std::vector<double> depths_m(const TriangleMesh& skin, const std::vector<Neighbour>& neighbours) {
  std::vector<double> depths;
  const auto measure = [&](const Vec3& p) {
    for (const Neighbour& neighbour : neighbours) {
      if (!neighbour.skin->box().contains(p)) continue;
      const double depth_m = -(*neighbour.skin)(p);
      if (depth_m > 0.0) depths.push_back(depth_m);
    }
  };
  for (const Vec3& p : skin.positions_m) measure(p);
  for (const auto& [a, b, c] : skin.triangles) {
    const auto at = [&](int v) -> const Vec3& { return skin.positions_m[static_cast<std::size_t>(v)]; };
    measure((at(a) + at(b) + at(c)) / 3.0);
  }
  return depths;
}

/// Lists what remains, muscle by muscle.
void list_overlaps(LimbWork& limb, const Fields& muscles, const Fields& bones, const std::vector<std::string>& names) {
  std::vector<std::vector<anatomy::Overlap>> found(muscles.size());
  for_each_index(muscles.size(), limb.settings.threads, [&](std::size_t m) {
    const std::string& key = limb.muscles[m].data.mechanics.key;
    std::vector<double> depths = depths_m(limb.muscles[m].skin, neighbours_of(muscles, bones, m));
    std::sort(depths.begin(), depths.end());
    SurfaceReport& report = limb.muscles[m].report;
    if (!depths.empty()) {
      report.overlap_p95_m = depths[static_cast<std::size_t>(kPercentile * static_cast<double>(depths.size() - 1))];
      report.overlap_largest_m = depths.back();
    }
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
    for_each_index(muscles.size(), limb.settings.threads, [&](std::size_t m) {
      move_apart(limb.muscles[m], neighbours_of(muscles, bones, m));
      if (round + 1 == kRounds) done();
    });
  }
  list_overlaps(limb, fields_of(limb, limb.settings.threads), bones, names);
}

}  // namespace myotact::prepare

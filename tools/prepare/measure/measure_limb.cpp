#include "prepare/measure/measure_limb.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/at.h"
#include "core/error.h"
#include "prepare/measure/keep_whole.h"
#include "prepare/parallel.h"
#include "prepare/part/film.h"
#include "prepare/surface/surface_pieces.h"

namespace myotact::prepare {

namespace {

/// Free layers around the limb.
constexpr int kRim = 4;

struct NamedBody {
  std::string key;
  bool bone = false;
  const geometry::TriangleMesh* surface = nullptr;
};

std::vector<NamedBody> bodies_of(const LimbWork& limb) {
  std::vector<NamedBody> bodies;
  for (const BoneWork& bone : limb.bones) bodies.push_back({bone.data.key, true, &bone.surface});
  for (const MuscleWork& muscle : limb.muscles) bodies.push_back({muscle.data.mechanics.key, false, &muscle.surface});
  return bodies;
}

std::vector<MuscleData> muscles_of(const LimbWork& limb) {
  std::vector<MuscleData> muscles;
  for (const MuscleWork& muscle : limb.muscles) muscles.push_back(muscle.data);
  return muscles;
}

Lattice lattice_around(const std::vector<NamedBody>& bodies, double step_m) {
  Eigen::AlignedBox3d box;
  for (const NamedBody& body : bodies) {
    for (const Vec3& p : body.surface->positions_m) box.extend(p);
  }
  Lattice lattice;
  lattice.steps_m = step_m * Mat3::Identity();
  // On whole steps, so that limbs of one frame have one lattice.
  double points = 1.0;
  for (int k = 0; k < 3; ++k) {
    lattice.origin_m[k] = step_m * (std::floor(box.min()[k] / step_m) - kRim);
    const double count = std::ceil(box.max()[k] / step_m) - std::floor(box.min()[k] / step_m) + 1 + 2 * kRim;
    points *= count;
    lattice.counts[at(k)] = static_cast<int>(std::min(count, 1e9));
  }
  if (points >= static_cast<double>(std::numeric_limits<std::int32_t>::max())) {
    throw Error(ExitStatus::Usage,
                fmt::format("--step: {:.3f} mm makes {:.3g} lattice points; take a longer one", 1e3 * step_m, points));
  }
  return lattice;
}

/// The deepest of several pieces, point by point: those of a bone may overlap.
std::vector<DepthSample> deepest(std::vector<DepthSample> a, const std::vector<DepthSample>& b) {
  a.insert(a.end(), b.begin(), b.end());
  std::stable_sort(a.begin(), a.end(), [](const DepthSample& p, const DepthSample& q) {
    return p.point != q.point ? p.point < q.point : p.depth > q.depth;
  });
  a.erase(std::unique(a.begin(), a.end(), [](const auto& p, const auto& q) { return p.point == q.point; }), a.end());
  return a;
}

Claim claim_of(const NamedBody& body, const Lattice& lattice) {
  Claim claim{body.key, body.bone, {}};
  for (const geometry::TriangleMesh& piece : pieces_of(*body.surface)) {
    std::vector<DepthSample> samples = sample_depths(piece, lattice);
    claim.samples = claim.samples.empty() ? std::move(samples) : deepest(std::move(claim.samples), samples);
  }
  return claim;
}

}  // namespace

MeasuredLimb measure_limb(const LimbWork& limb, double step_m, const std::function<void()>& measured) {
  const std::vector<NamedBody> bodies = bodies_of(limb);
  const Lattice lattice = lattice_around(bodies, step_m);
  std::vector<Claim> claims(bodies.size());
  std::vector<int> genera(bodies.size());
  for_each_index(bodies.size(), limb.settings.threads, [&](std::size_t b) {
    claims[b] = claim_of(bodies[b], lattice);
    genera[b] = genus(*bodies[b].surface);
    measured();
  });
  for (Claim& claim : claims) {
    if (!claim.bone) thicken(claim.samples);
  }
  std::vector<Share> shares;
  MeasuredLimb result{share_out(lattice, claims, shares), {}, {}};
  const std::vector<Wholeness> wholeness = keep_whole(result.volume, claims, genera);
  result.tendons = lay_tendons(result.volume, muscles_of(limb));
  std::vector<std::size_t> points(claims.size() + 1, 0);
  for (const std::uint16_t label : result.volume.labels) ++points[label];
  for (std::size_t c = 0; c < claims.size(); ++c) {
    shares[c].kept = points[c + 1];
    result.parts.push_back({claims[c].key, shares[c], wholeness[c].added, wholeness[c].dropped});
    if (points[c + 1] == 0) {
      throw bad_data(claims[c].key, "surface",
                     fmt::format("its neighbours and {:.2f} mm steps leave nothing of it; take shorter steps, or leave "
                                 "it out of the recipe",
                                 1e3 * step_m));
    }
  }
  return result;
}

}  // namespace myotact::prepare

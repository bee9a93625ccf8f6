#include "prepare/part/part_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "core/error.h"
#include "prepare/field/level_set.h"
#include "prepare/field/local_radius.h"
#include "prepare/field/signed_distance.h"
#include "prepare/parallel.h"
#include "prepare/part/overlap_measure.h"
#include "prepare/repair/surface_pieces.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

/// Overlaps below this volume are grazing contacts: the clearance alone sees to them [m3].
constexpr double kLeastOverlap_m3 = 1e-12;
/// Triangles that a parted surface is extracted with, roughly; where the body is thin, up to the larger number. Limb
/// muscles get lattices of 0.5 to 1.7 mm.
constexpr double kTriangles = 22000.0;
constexpr double kMostTriangles = 90000.0;
constexpr double kFinestSpacing_m = 4e-4;
/// The field that is extracted is flattened by this: the local radius, which it is scaled by, varies in space, so that
/// the field itself may change a little faster than distance does.
constexpr double kFlattening = 0.75;
/// What may come off as loose ends, as a part of the volume, before the muscle counts as cut in two.
constexpr double kLooseEnds = 0.02;

/// The part of a muscle that stays whatever overlaps it: what lies deeper than `depth` of its local radius, looked at
/// on a lattice finer by `spacing`.
struct Core {
  double depth, spacing;
};
constexpr std::array<Core, 2> kCores = {{{0.4, 1.0}, {0.2, 0.6}}};

struct Body {
  SignedDistance distance;
  std::unique_ptr<LocalRadius> radius;  // once a border is known to need it

  explicit Body(const TriangleMesh& surface) : distance(surface) {}
};

/// One neighbour that takes room from a muscle.
struct Taker {
  const SignedDistance* distance = nullptr;
  const Body* shares = nullptr;  // none: keeps its shape and takes all that it covers (a bone, a nested muscle)
};

/// Negative in what is left of a muscle [m]. The border to a neighbour lies equally deep in both, each depth measured
/// against the local radius: a thin tendon keeps its core where it crosses a thick belly.
double parted_m(const Body& own, const std::vector<Taker>& takers, double half_gap_m, const Vec3& p) {
  const double own_m = own.distance(p);
  if (own_m > 0.0) return own_m;
  const double reach_m = 2.0 * half_gap_m - own_m;  // what lies farther off takes nothing here
  double value_m = own_m, own_radius_m = 0.0;
  for (const Taker& taker : takers) {
    if (taker.distance->box().exteriorDistance(p) > reach_m) continue;
    const double other_m = (*taker.distance)(p);
    if (other_m > reach_m) continue;
    if (!taker.shares) {
      value_m = std::max(value_m, half_gap_m - other_m);
      continue;
    }
    if (own_radius_m == 0.0) own_radius_m = (*own.radius)(p);
    const double radius_m = (*taker.shares->radius)(p);
    value_m = std::max(value_m, half_gap_m + (own_m * radius_m - other_m * own_radius_m) / (own_radius_m + radius_m));
  }
  return value_m;
}

double spacing_for_m(const SignedDistance& body) {
  const double area_m2 = geometry::surface_area_m2(body.surface());
  return std::max(
      {kFinestSpacing_m, spacing_for_triangles_m(area_m2, kMostTriangles),
       std::min(spacing_for_triangles_m(area_m2, kTriangles), spacing_for_thickness_m(area_m2, body.volume_m3()))});
}

/// The largest piece; adds what the others enclosed to `dropped_m3`.
TriangleMesh keep_largest(const TriangleMesh& mesh, double& dropped_m3) {
  TriangleMesh best;
  double best_m3 = 0.0, sum_m3 = 0.0;
  for (TriangleMesh& piece : pieces_of(mesh)) {
    const double volume_m3 = geometry::enclosed_volume_m3(piece);
    sum_m3 += volume_m3;
    if (volume_m3 <= best_m3) continue;
    best_m3 = volume_m3;
    best = std::move(piece);
  }
  dropped_m3 += sum_m3 - best_m3;
  return best;
}

/// Overlap volumes of one muscle with those after it and with the bones [m3].
struct OverlapRow {
  std::vector<double> muscles_m3, bones_m3;
};

/// Who takes from whom, and why.
struct Borders {
  std::vector<std::vector<Taker>> takers;  // by muscle
  std::vector<PartReport> reports;
};

struct Limb {
  std::vector<std::unique_ptr<Body>> muscles;
  std::vector<std::unique_ptr<SignedDistance>> bones;
  const std::vector<NamedSurface>& muscle_names;
  const std::vector<NamedSurface>& bone_names;
};

std::vector<OverlapRow> measure_overlaps(const Limb& limb, int threads) {
  std::vector<OverlapRow> rows(limb.muscles.size());
  for_each_index(rows.size(), threads, [&](std::size_t i) {
    const SignedDistance& own = limb.muscles[i]->distance;
    for (std::size_t j = 0; j < rows.size(); ++j) {
      rows[i].muscles_m3.push_back(j <= i ? 0.0 : measure_overlap(own, limb.muscles[j]->distance).volume_m3);
    }
    for (const auto& bone : limb.bones) rows[i].bones_m3.push_back(measure_overlap(own, *bone).volume_m3);
  });
  return rows;
}

/// Sets the border between two muscles that share `both_m3`.
void set_border(const Limb& limb, std::array<std::size_t, 2> pair, double both_m3, double nested, Borders& borders) {
  auto [small, large] = pair;
  const auto volume_m3 = [&](std::size_t m) { return limb.muscles[m]->distance.volume_m3(); };
  if (volume_m3(small) > volume_m3(large)) std::swap(small, large);
  const Body &small_body = *limb.muscles[small], &large_body = *limb.muscles[large];
  borders.reports[large].gave_way.emplace_back(both_m3, limb.muscle_names[small].key);
  if (both_m3 > nested * volume_m3(small)) {
    borders.reports[small].hosts.push_back(limb.muscle_names[large].key);
    borders.takers[large].push_back({&small_body.distance, nullptr});
    return;
  }
  borders.takers[large].push_back({&small_body.distance, &small_body});
  borders.takers[small].push_back({&large_body.distance, &large_body});
  borders.reports[small].gave_way.emplace_back(both_m3, limb.muscle_names[large].key);
}

Borders set_borders(const Limb& limb, const PartSettings& settings) {
  const std::size_t n = limb.muscles.size();
  const std::vector<OverlapRow> rows = measure_overlaps(limb, settings.threads);
  Borders borders;
  borders.takers.resize(n);
  borders.reports.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    borders.reports[i].volume_before_m3 = limb.muscles[i]->distance.volume_m3();
    for (std::size_t j = i + 1; j < n; ++j) {
      const double both_m3 = rows[i].muscles_m3[j];
      if (both_m3 >= kLeastOverlap_m3) set_border(limb, {i, j}, both_m3, settings.nested, borders);
    }
    for (std::size_t b = 0; b < limb.bones.size(); ++b) {
      if (rows[i].bones_m3[b] < kLeastOverlap_m3) continue;
      borders.takers[i].push_back({limb.bones[b].get(), nullptr});
      borders.reports[i].gave_way.emplace_back(rows[i].bones_m3[b], limb.bone_names[b].key);
    }
  }
  for (PartReport& report : borders.reports) {
    std::sort(report.gave_way.begin(), report.gave_way.end(), std::greater<>());
  }
  return borders;
}

/// What is left of one muscle, in one piece. When parting would cut it in two, its core stays; when even that falls
/// apart, a thicker core is taken, on a finer lattice.
TriangleMesh part_one(const Body& own, const std::vector<Taker>& takers, double clearance_m, PartReport& report) {
  const double spacing_m = spacing_for_m(own.distance);
  const auto field = [&](const Vec3& p) { return kFlattening * parted_m(own, takers, 0.5 * clearance_m, p); };
  TriangleMesh left = keep_largest(extract_level_set(field, own.distance.box(), spacing_m), report.dropped_m3);
  for (const Core& core : kCores) {
    if (report.dropped_m3 <= kLooseEnds * report.volume_before_m3) break;
    const auto with_core = [&](const Vec3& p) {
      return std::min(field(p), kFlattening * (own.distance(p) + core.depth * (*own.radius)(p)));
    };
    double dropped_m3 = 0.0;
    TriangleMesh more =
        keep_largest(extract_level_set(with_core, own.distance.box(), core.spacing * spacing_m), dropped_m3);
    if (dropped_m3 >= report.dropped_m3) continue;
    report.kept_core = true;
    report.dropped_m3 = dropped_m3;
    left = std::move(more);
  }
  return left;
}

}  // namespace

std::vector<PartReport> part_surfaces(std::vector<NamedSurface>& muscles, const std::vector<NamedSurface>& bones,
                                      const PartSettings& settings, const std::function<void()>& done) {
  Limb limb{{}, {}, muscles, bones};
  limb.muscles.resize(muscles.size());
  limb.bones.resize(bones.size());
  for_each_index(muscles.size() + bones.size(), settings.threads, [&](std::size_t i) {
    if (i < muscles.size())
      limb.muscles[i] = std::make_unique<Body>(muscles[i].surface);
    else
      limb.bones[i - muscles.size()] = std::make_unique<SignedDistance>(bones[i - muscles.size()].surface);
  });
  Borders borders = set_borders(limb, settings);
  for_each_index(muscles.size(), settings.threads, [&](std::size_t i) {
    if (!borders.takers[i].empty()) limb.muscles[i]->radius = std::make_unique<LocalRadius>(limb.muscles[i]->distance);
  });
  for_each_index(muscles.size(), settings.threads, [&](std::size_t i) {
    if (done) done();
    if (borders.takers[i].empty()) return;
    PartReport& report = borders.reports[i];
    TriangleMesh left = part_one(*limb.muscles[i], borders.takers[i], settings.clearance_m, report);
    if (left.triangles.empty()) {
      throw bad_data(muscles[i].key, "part", "lies wholly inside its neighbours; leave one of them out");
    }
    report.volume_lost_m3 = report.volume_before_m3 - geometry::enclosed_volume_m3(left);
    muscles[i].surface = std::move(left);
  });
  return borders.reports;
}

}  // namespace myotact::prepare

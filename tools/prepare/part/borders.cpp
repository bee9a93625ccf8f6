#include "prepare/part/borders.h"

#include <algorithm>
#include <array>
#include <limits>

#include "prepare/parallel.h"
#include "prepare/part/overlap_measure.h"

namespace myotact::prepare {

namespace {

/// Overlaps below this volume are grazing contacts: the clearance alone sees to them [m3].
constexpr double kLeastOverlap_m3 = 1e-12;

/// Overlap volumes of one muscle with those after it and with the bones [m3].
struct OverlapRow {
  std::vector<double> muscles_m3, bones_m3;
};

std::vector<OverlapRow> measure_overlaps(const BodiesToPart& bodies, int threads) {
  std::vector<OverlapRow> rows(bodies.muscles.size());
  for_each_index(rows.size(), threads, [&](std::size_t i) {
    const SignedDistance& own = bodies.muscles[i]->distance;
    for (std::size_t j = 0; j < rows.size(); ++j) {
      rows[i].muscles_m3.push_back(j <= i ? 0.0 : measure_overlap(own, bodies.muscles[j]->distance).volume_m3);
    }
    for (const auto& bone : bodies.bones) rows[i].bones_m3.push_back(measure_overlap(own, *bone).volume_m3);
  });
  return rows;
}

/// Sets the border between two muscles that have `both_m3` in common.
void set_border(const BodiesToPart& bodies, std::array<std::size_t, 2> pair, double both_m3, double nested,
                std::vector<Borders>& borders, std::vector<PartReport>& reports) {
  auto [small, large] = pair;
  const auto volume_m3 = [&](std::size_t m) { return bodies.muscles[m]->distance.volume_m3(); };
  if (volume_m3(small) > volume_m3(large)) std::swap(small, large);
  const Body &small_body = *bodies.muscles[small], &large_body = *bodies.muscles[large];
  reports[large].gave_way.emplace_back(both_m3, bodies.muscle_names[small].key);
  if (both_m3 > nested * volume_m3(small)) {
    reports[small].hosts.push_back(bodies.muscle_names[large].key);
    borders[large].taken.push_back(&small_body.distance);
    return;
  }
  borders[large].shared.push_back(&small_body);
  borders[small].shared.push_back(&large_body);
  reports[small].gave_way.emplace_back(both_m3, bodies.muscle_names[large].key);
}

/// The muscle's depth or its way to the nearest half-way border, whichever is less, as a negative number [m].
double shared_m(const Body& own, const Borders& borders, double half_gap_m, const Vec3& p, double own_m) {
  const double reach_m = 2.0 * half_gap_m - own_m;  // what lies farther off takes nothing here
  const double own_radius_m = borders.shared.empty() ? 0.0 : own.radius(p);
  double value_m = own_m;
  for (const Body* other : borders.shared) {
    if (other->distance.box().exteriorDistance(p) > reach_m) continue;
    const double other_m = other->distance(p);
    if (other_m > reach_m) continue;
    const double radius_m = other->radius(p);
    value_m = std::max(value_m, half_gap_m + (own_m * radius_m - other_m * own_radius_m) / (own_radius_m + radius_m));
  }
  return value_m;
}

}  // namespace

std::vector<Borders> set_borders(const BodiesToPart& bodies, const PartSettings& settings,
                                 std::vector<PartReport>& reports) {
  const std::size_t n = bodies.muscles.size();
  const std::vector<OverlapRow> rows = measure_overlaps(bodies, settings.threads);
  std::vector<Borders> borders(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const double both_m3 = rows[i].muscles_m3[j];
      if (both_m3 >= kLeastOverlap_m3) set_border(bodies, {i, j}, both_m3, settings.nested, borders, reports);
    }
    for (std::size_t b = 0; b < bodies.bones.size(); ++b) {
      if (rows[i].bones_m3[b] < kLeastOverlap_m3) continue;
      borders[i].taken.push_back(bodies.bones[b].get());
      reports[i].gave_way.emplace_back(rows[i].bones_m3[b], bodies.bone_names[b].key);
    }
  }
  for (PartReport& report : reports) std::sort(report.gave_way.begin(), report.gave_way.end(), std::greater<>());
  return borders;
}

double left_of_m(const Body& own, const Borders& borders, double half_gap_m, const Vec3& p) {
  const double own_m = own.distance(p);
  double value_m = own_m < 0.0 ? shared_m(own, borders, half_gap_m, p, own_m) : own_m;
  const auto take = [&](const SignedDistance& taker, double body_m) {  // what lies farther off takes nothing here
    if (taker.box().exteriorDistance(p) <= 2.0 * half_gap_m - body_m)
      value_m = std::max(value_m, half_gap_m - taker(p));
  };
  for (const SignedDistance* film : borders.later_films) take(*film, own_m);
  const double film_m = borders.own_film ? (*borders.own_film)(p) : std::numeric_limits<double>::infinity();
  value_m = std::min(value_m, film_m);
  const double body_m = std::min(own_m, film_m);
  for (const SignedDistance* film : borders.earlier_films) take(*film, body_m);
  for (const SignedDistance* taken : borders.taken) take(*taken, body_m);
  if (borders.core > 0.0) value_m = std::min(value_m, own_m + borders.core * own.radius(p));
  return value_m;
}

double taken_m(const Borders& borders, double half_gap_m, const Vec3& p) {
  double value_m = -std::numeric_limits<double>::infinity();
  for (const auto* takers : {&borders.taken, &borders.earlier_films}) {
    for (const SignedDistance* taker : *takers) {
      if (half_gap_m - taker->box().exteriorDistance(p) <= value_m) continue;  // too far off to be the deepest
      value_m = std::max(value_m, half_gap_m - (*taker)(p));
    }
  }
  return value_m;
}

}  // namespace myotact::prepare

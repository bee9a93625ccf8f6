#include "prepare/architecture/sections.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace myotact::prepare {

namespace {

/// Tets a slice: fewer, and the slice surface through the tets is ragged; more, and short tendons are not seen.
constexpr std::size_t kTetsPerSlice = 10;
constexpr std::size_t kFewestSlices = 5;
constexpr std::size_t kMostSlices = 16;
/// Sections stay within these multiples of the median slice's: the ends of a field have poles, and in corners that no
/// flux reaches the quotient means nothing.
constexpr double kLeastSection = 0.2;
constexpr double kMostSection = 3.0;
/// Slices through which less than this part of the mean flux runs say nothing of the median: a wide sheet with short
/// fibres is mostly corners.
constexpr double kLeastFlux = 0.01;
/// Sections below this part of the largest are tendon. Tapering bellies have more until close to their ends; the
/// tendons of the canine elbow muscles have 10 .. 40 %.
constexpr double kTendonSection = 0.45;
constexpr double kLeastBelly = 0.5;
/// A slice is slender when its balls are smaller than this part of the whole way, and than this part of the largest:
/// the tendons of the canine digits have .003 to .005 and a fifth to a half.
constexpr double kSlender = 5e-3, kSlenderAgainstLargest = 0.6;

struct CutTet {
  double potential = 0.0;  // at the centre
  std::size_t tet = 0;
};

std::vector<CutTet> sort_by_potential(const geometry::TetMesh& tets, const FibreField& field) {
  std::vector<CutTet> sorted;
  for (std::size_t t = 0; t < tets.corners.size(); ++t) {
    double potential = 0.0;
    for (const int n : tets.corners[t]) potential += 0.25 * field.potential[static_cast<std::size_t>(n)];
    sorted.push_back({potential, t});
  }
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const CutTet& a, const CutTet& b) { return a.potential < b.potential; });
  return sorted;
}

/// Value at x of the line through the points (xs rising); constant beyond them.
double interpolate(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
  const auto above = static_cast<std::size_t>(std::lower_bound(xs.begin(), xs.end(), x) - xs.begin());
  if (above == 0) return ys.front();
  if (above == xs.size()) return ys.back();
  const double part = (x - xs[above - 1]) / (xs[above] - xs[above - 1]);
  return ys[above - 1] + part * (ys[above] - ys[above - 1]);
}

/// Sums over the tets of one slice.
struct Slice {
  double volume_m3 = 0.0;
  double flux_m = 0.0;  // integral of |gradient| over the volume [m, for a flux of 1]
  Vec3 moment = Vec3::Zero();
};

/// Median section of the slices that the flux runs through.
double usual_section_m2(const std::vector<Slice>& slices) {
  double flux_m = 0.0;
  for (const Slice& slice : slices) flux_m += slice.flux_m;
  std::vector<double> sections_m2;
  for (const Slice& slice : slices) {
    const double least_m = kLeastFlux * flux_m / static_cast<double>(slices.size());
    if (slice.flux_m > 0.0 && slice.flux_m >= least_m) sections_m2.push_back(slice.volume_m3 / slice.flux_m);
  }
  std::sort(sections_m2.begin(), sections_m2.end());
  return sections_m2[sections_m2.size() / 2];
}

std::size_t nearest_slice(const MuscleProfile& profile, double arc_m) {
  const auto above = std::lower_bound(profile.arc_m.begin(), profile.arc_m.end(), arc_m);
  const auto slice = std::min(static_cast<std::size_t>(above - profile.arc_m.begin()), profile.arc_m.size() - 1);
  return slice > 0 && arc_m - profile.arc_m[slice - 1] < profile.arc_m[slice] - arc_m ? slice - 1 : slice;
}

bool is_slender_slice(const MuscleProfile& profile, std::size_t slice) {
  if (profile.radius_m.empty()) return false;
  const double largest_m = *std::max_element(profile.radius_m.begin(), profile.radius_m.end());
  return profile.radius_m[slice] < std::min(kSlender * profile.length_m, kSlenderAgainstLargest * largest_m);
}

/// As the profile's, but 0 where the muscle is slender.
std::vector<double> sections_of_thick_slices(const MuscleProfile& profile) {
  std::vector<double> sections_m2 = profile.section_m2;
  for (std::size_t s = 0; s < sections_m2.size(); ++s) {
    if (is_slender_slice(profile, s)) sections_m2[s] = 0.0;
  }
  return sections_m2;
}

/// The one whose centre is nearest.
std::size_t nearest_tet(const geometry::TetMesh& tets, const Vec3& p_m) {
  std::size_t nearest = 0;
  double best_m2 = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < tets.corners.size(); ++t) {
    Vec3 centre_m = Vec3::Zero();
    for (const int n : tets.corners[t]) centre_m += 0.25 * tets.nodes_m[static_cast<std::size_t>(n)];
    const double away_m2 = (centre_m - p_m).squaredNorm();
    if (away_m2 < best_m2) best_m2 = away_m2, nearest = t;
  }
  return nearest;
}

}  // namespace

MuscleProfile slice_muscle(const geometry::TetMesh& tets, const FibreField& field) {
  const std::vector<CutTet> sorted = sort_by_potential(tets, field);
  const std::size_t count = std::clamp(sorted.size() / kTetsPerSlice, kFewestSlices, kMostSlices);
  const double whole_m3 = geometry::total_volume_m3(tets);
  std::vector<Slice> slices(count);
  std::vector<double> reached(sorted.size());  // part of the volume before the tet's middle
  double before_m3 = 0.0;
  for (const CutTet& cut : sorted) {
    const double volume_m3 = geometry::corner_volume_m3(tets, cut.tet);
    reached[cut.tet] = (before_m3 + 0.5 * volume_m3) / whole_m3;
    before_m3 += volume_m3;
    const auto s = std::min(static_cast<std::size_t>(reached[cut.tet] * static_cast<double>(count)), count - 1);
    const double flux_m = volume_m3 * field.gradient[cut.tet].norm();
    Vec3 centre = Vec3::Zero();
    for (const int n : tets.corners[cut.tet]) centre += 0.25 * tets.nodes_m[static_cast<std::size_t>(n)];
    slices[s].volume_m3 += volume_m3;
    slices[s].flux_m += flux_m;
    slices[s].moment += flux_m * centre;
  }

  MuscleProfile profile;
  std::vector<double> middles;  // parts of the volume
  double part = 0.0;
  for (const Slice& slice : slices) {
    if (!(slice.flux_m > 0.0)) continue;  // tets larger than a slice can leave one empty
    profile.section_m2.push_back(slice.volume_m3 / slice.flux_m);
    profile.centre_m.push_back(slice.moment / slice.flux_m);
    profile.arc_m.push_back(profile.length_m + 0.5 * slice.flux_m);
    profile.length_m += slice.flux_m;  // volume over section
    middles.push_back(part + 0.5 * slice.volume_m3 / whole_m3);
    part += slice.volume_m3 / whole_m3;
  }
  const double usual_m2 = usual_section_m2(slices);
  for (double& section_m2 : profile.section_m2) {
    section_m2 = std::clamp(section_m2, kLeastSection * usual_m2, kMostSection * usual_m2);
  }
  for (std::size_t t = 0; t < sorted.size(); ++t) {
    profile.tet_arc_m.push_back(interpolate(middles, profile.arc_m, reached[t]));
    profile.tet_section_m2.push_back(interpolate(middles, profile.section_m2, reached[t]));
  }
  return profile;
}

void measure_radii(const std::vector<TouchingBall>& balls, const geometry::TetMesh& tets, MuscleProfile& profile) {
  const std::size_t n = profile.arc_m.size();
  std::vector<double> sums_m(n, 0.0), counts(n, 0.0);
  for (const TouchingBall& ball : balls) {
    const double arc_m = profile.tet_arc_m[nearest_tet(tets, ball.place_m)];
    const std::size_t slice = nearest_slice(profile, arc_m);
    sums_m[slice] += ball.radius_m;
    counts[slice] += 1.0;
  }
  if (balls.empty()) return;
  auto seen = static_cast<std::size_t>(std::find_if(counts.begin(), counts.end(), [](double c) { return c > 0.0; }) -
                                       counts.begin());
  profile.radius_m.clear();
  for (std::size_t s = 0; s < n; ++s) {
    if (counts[s] > 0.0) seen = s;  // slices without a ball are as the last one with
    profile.radius_m.push_back(sums_m[seen] / counts[seen]);
  }
}

bool is_slender(const MuscleProfile& profile, double arc_m) {
  return is_slender_slice(profile, nearest_slice(profile, arc_m));
}

BellySpan find_belly(const MuscleProfile& profile) {
  const std::vector<double> sections_m2 = sections_of_thick_slices(profile);
  const double tendon_m2 = kTendonSection * *std::max_element(sections_m2.begin(), sections_m2.end());
  const auto fleshy = [&](double section_m2) { return section_m2 > tendon_m2; };
  const auto first = std::find_if(sections_m2.begin(), sections_m2.end(), fleshy);
  const auto last = std::find_if(sections_m2.rbegin(), sections_m2.rend(), fleshy);
  const auto index = static_cast<std::size_t>(first - sections_m2.begin());
  const auto back = static_cast<std::size_t>(last - sections_m2.rbegin());
  const std::size_t n = profile.section_m2.size();
  // The border lies half-way between the last tendinous slice and the first fleshy one.
  double head_m = index == 0 ? 0.0 : 0.5 * (profile.arc_m[index - 1] + profile.arc_m[index]);
  double tail_m = back == 0 ? 0.0 : profile.length_m - 0.5 * (profile.arc_m[n - back - 1] + profile.arc_m[n - back]);
  const double most_m = (1.0 - kLeastBelly) * profile.length_m;
  if (head_m + tail_m > most_m) {
    const double scale = most_m / (head_m + tail_m);
    head_m *= scale;
    tail_m *= scale;
  }
  return {head_m, profile.length_m - tail_m};
}

std::vector<anatomy::TissueRegion> mark_regions(const MuscleProfile& profile, const BellySpan& belly) {
  std::vector<anatomy::TissueRegion> regions;
  for (const double arc_m : profile.tet_arc_m) {
    const bool inside = arc_m >= belly.begin_m && arc_m <= belly.end_m;
    regions.push_back(inside ? anatomy::TissueRegion::Belly : anatomy::TissueRegion::Tendon);
  }
  return regions;
}

void mark_aponeuroses(const geometry::TetMesh& tets, const AttachmentPatches& patches,
                      std::vector<anatomy::TissueRegion>& regions) {
  for (const AttachmentPatch& patch : patches) {
    for (std::size_t t = 0; t < regions.size(); ++t) {
      const auto on_patch = std::count_if(tets.corners[t].begin(), tets.corners[t].end(), [&](int n) {
        return std::binary_search(patch.vertices.begin(), patch.vertices.end(), n);
      });
      const bool has_face = on_patch >= 3;
      if (has_face && regions[t] == anatomy::TissueRegion::Belly) regions[t] = anatomy::TissueRegion::Aponeurosis;
    }
  }
}

}  // namespace myotact::prepare

#include "prepare/part/overlap_measure.h"

#include <algorithm>
#include <cmath>

namespace myotact::prepare {

namespace {

/// Lattice points in the common box: 18 a side of a cube. Volumes come out within 5 % of large overlaps.
constexpr double kLatticePoints = 6000.0;
constexpr double kMostAlong = 60.0;  // one side

}  // namespace

OverlapMeasure measure_overlap(const SignedDistance& a, const SignedDistance& b) {
  OverlapMeasure measure;
  const Eigen::AlignedBox3d box = a.box().intersection(b.box());
  if (box.isEmpty() || !(box.volume() > 0.0)) return measure;
  const double spacing_m =
      std::max(std::cbrt(box.volume() / kLatticePoints), box.sizes().maxCoeff() / kMostAlong);  // the box may be flat
  Eigen::Array3i counts = (box.sizes() / spacing_m).array().ceil().cast<int>().max(1);
  const Vec3 step_m = box.sizes().cwiseQuotient(counts.matrix().cast<double>());
  for (int x = 0; x < counts[0]; ++x) {
    for (int y = 0; y < counts[1]; ++y) {
      for (int z = 0; z < counts[2]; ++z) {
        const Vec3 p = box.min() + step_m.cwiseProduct(Vec3(x + 0.5, y + 0.5, z + 0.5));
        const double inside_a_m = -a(p);
        if (inside_a_m <= 0.0) continue;
        const double depth_m = std::min(inside_a_m, -b(p));
        if (depth_m <= 0.0) continue;
        measure.volume_m3 += step_m.prod();
        measure.depth_m = std::max(measure.depth_m, depth_m);
      }
    }
  }
  return measure;
}

}  // namespace myotact::prepare

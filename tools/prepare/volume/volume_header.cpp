#include "prepare/volume/volume_header.h"

#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "prepare/volume/specimen_frame.h"

namespace myotact::prepare {

namespace {

constexpr double kShortest_mm = 1e-3, kLongest_mm = 100.0;  // finer than light microscopes, coarser than a dog
constexpr double kFarthest_mm = 1e5;                        // a scanner's table is 2 m long
/// Files round directions to six digits or more; beyond this it is a shear, which no spacing describes.
constexpr double kLargestCosine = 1e-3;
/// Steps that differ by less are equal but for rounding.
constexpr double kEqualSteps = 1e-3;

std::string text_of(const Vec3& v) {
  return fmt::format("({}, {}, {})", to_text(v.x()), to_text(v.y()), to_text(v.z()));
}

void check_lengths(const VolumeHeader& header, const std::string& file) {
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 step_mm = header.steps_mm.col(axis);
    const double length_mm = step_mm.norm();
    if (length_mm >= kShortest_mm && length_mm <= kLongest_mm) continue;  // false for NaN
    throw bad_data(
        file, header.steps_field,
        fmt::format("the step along axis {} is {}, {} mm long; must be {} .. {} mm. Correct the spacing, or "
                    "its unit",
                    axis, text_of(step_mm), to_text(length_mm), to_text(kShortest_mm), to_text(kLongest_mm)));
  }
  if (header.origin_mm.norm() <= kFarthest_mm) return;
  throw bad_data(file, "origin",
                 fmt::format("is {} mm; must be within {} m of zero. Correct it, or its unit",
                             text_of(header.origin_mm), to_text(1e-3 * kFarthest_mm)));
}

void check_angles(const VolumeHeader& header, const std::string& file) {
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    const double cosine = header.steps_mm.col(a).normalized().dot(header.steps_mm.col(b).normalized());
    if (std::abs(cosine) <= kLargestCosine) continue;
    throw bad_data(file, header.steps_field,
                   fmt::format("axes {} and {} meet at {:.2f} degrees; must be 90: a sheared lattice. Resample the "
                               "segmentation to a straight one (in 3D Slicer: Transforms, harden; then export)",
                               a, b, std::acos(cosine) * 180.0 / M_PI));
  }
}

}  // namespace

void set_counts(VolumeHeader& header, const std::array<std::int64_t, 3>& counts, std::int64_t layers,
                const std::string& file, const std::string& field) {
  std::int64_t points = 1;
  for (std::size_t axis = 0; axis < 4; ++axis) {
    const std::int64_t count = axis < 3 ? counts[axis] : layers;
    if (count < 1) throw bad_data(file, field, fmt::format("holds the size {}; must be at least 1", count));
    if (count > kMostPoints / points || (axis == 3 && count > kMostLayers)) {
      throw bad_data(file, field,
                     fmt::format("{} x {} x {} points in {} layers; at most {} in all and {} layers are read. Crop the "
                                 "segmentation to the limb, or resample it coarser",
                                 counts[0], counts[1], counts[2], layers, kMostPoints, kMostLayers));
    }
    points *= count;
    if (axis < 3) header.counts[axis] = static_cast<int>(count);
  }
  header.layers = static_cast<int>(layers);
}

Lattice lattice_of(const VolumeHeader& header, const std::string& file, std::vector<std::string>& notes) {
  check_lengths(header, file);
  check_angles(header, file);
  constexpr double kMetresPerMillimetre = 1e-3;
  Lattice lattice;
  lattice.counts = header.counts;
  lattice.steps_m = specimen_from_lps() * header.steps_mm * kMetresPerMillimetre;
  lattice.origin_m = specimen_from_lps() * header.origin_mm * kMetresPerMillimetre;
  const Vec3 lengths_mm = header.steps_mm.colwise().norm();
  const bool equal = lengths_mm.maxCoeff() <= lengths_mm.minCoeff() * (1.0 + kEqualSteps);
  notes.push_back(fmt::format("{} x {} x {} points, {:.4g} x {:.4g} x {:.4g} mm apart{}", header.counts[0],
                              header.counts[1], header.counts[2], lengths_mm.x(), lengths_mm.y(), lengths_mm.z(),
                              equal ? "" : ": coarser along one axis than along another"));
  if (header.steps_mm.determinant() < 0.0) {
    notes.push_back(
        fmt::format("{}: the axes are left-handed; the lattice is read as the file says. Should the limb "
                    "be its mirror image, the file states its space or directions wrongly",
                    header.steps_field));
  }
  return lattice;
}

}  // namespace myotact::prepare

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/vector.h"
#include "prepare/volume/label_volume.h"

// What the header of any format says of the numbers behind it and of their places.

namespace myotact::prepare {

/// A number of a file. Floating-point ones are known only to be refused by name.
struct ScalarType {
  int bytes = 1;  // 1, 2, 4 or 8
  bool is_signed = false;
  bool is_float = false;
};

struct VolumeHeader {
  std::array<int, 3> counts{};  // points along each axis, the fastest first
  int layers = 1;
  bool layers_fastest = false;  // the layers of a point lie side by side, not one volume after the other
  ScalarType type;
  bool big_endian = false;
  std::int64_t slope = 1, intercept = 0;  // label = slope * number + intercept
  Mat3 steps_mm = Mat3::Identity();       // columns: from a point to the next along each axis; LPS
  Vec3 origin_mm = Vec3::Zero();          // of the first point; LPS
  std::string steps_field;                // that holds them, for errors
  std::vector<Segment> segments;          // as the file names them; need not occur in the data
  std::vector<std::string> notes;
};

/// Largest number of points, all layers together: 2 bytes each, and indices that fit an int.
inline constexpr std::int64_t kMostPoints = (std::int64_t{1} << 31) - 1;
inline constexpr std::int64_t kMostLayers = 4096;  // more than any person segments

/// Sets the counts. Throws Error BadData naming `field` for a count below 1 and for more than kMostPoints.
void set_counts(VolumeHeader& header, const std::array<std::int64_t, 3>& counts, std::int64_t layers,
                const std::string& file, const std::string& field);

/// The lattice in the specimen frame, in metres. Throws Error BadData for steps that are zero, not finite, shorter than
/// 1 um or longer than 0.1 m, for an origin farther than 100 m, and for directions off the right angle by a cosine of
/// more than 1e-3. Adds notes on unequal steps and on axes that are a mirror image.
Lattice lattice_of(const VolumeHeader& header, const std::string& file, std::vector<std::string>& notes);

}  // namespace myotact::prepare

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include <Eigen/LU>
#include <fmt/format.h>

#include "core/at.h"
#include "core/error.h"
#include "core/text.h"
#include "prepare/volume/volume_formats.h"

// NIfTI-1 and NIfTI-2 in one file (nifti1.h and nifti2.h of the NIfTI group, 2007 and 2011). Places are RAS.

namespace myotact::prepare {

namespace {

/// Where the fields that matter lie in a header of 348 (version 1) or 540 bytes [bytes].
struct Layout {
  std::size_t size, magic, dim, datatype, bitpix, pixdim, vox_offset, slope, inter, xyzt_units, qform_code, sform_code,
      quatern, qoffset, srow;
  bool wide;  // 64-bit numbers where version 1 has 16 and 32 bits
};
constexpr Layout kVersion1 = {348, 344, 40, 70, 72, 76, 108, 112, 116, 123, 252, 254, 256, 268, 280, false};
constexpr Layout kVersion2 = {540, 4, 16, 12, 14, 104, 168, 176, 184, 500, 344, 348, 352, 376, 400, true};

std::optional<ScalarType> scalar_type(int datatype) {
  switch (datatype) {
    case 2:
      return ScalarType{1, false};
    case 4:
      return ScalarType{2, true};
    case 8:
      return ScalarType{4, true};
    case 16:
      return ScalarType{4, true, true};
    case 64:
      return ScalarType{8, true, true};
    case 256:
      return ScalarType{1, true};
    case 512:
      return ScalarType{2, false};
    case 768:
      return ScalarType{4, false};
    case 1024:
      return ScalarType{8, true};
    case 1280:
      return ScalarType{8, false};
    default:
      return {};
  }
}

class NiftiHeader {
 public:
  NiftiHeader(ByteSource& source, const std::string& file) : file_(file) {
    const std::string_view first = source.peek(4);
    if (first.size() < 4) throw error("header", "is shorter than 4 bytes; copy the file again");
    find_version(first);
    bytes_.resize(layout_->size);
    const std::size_t got = source.read(bytes_.data(), bytes_.size());
    if (got < bytes_.size()) {
      throw error("header", fmt::format("has {} bytes; must have {}: the file is cut off", got, bytes_.size()));
    }
    check_magic();
  }

  VolumeFile read() {
    read_type();
    read_sizes();
    read_scaling();
    read_places();
    read_offset();
    return std::move(result_);
  }

 private:
  Error error(const std::string& field, const std::string& problem) const { return bad_data(file_, field, problem); }

  template <class Number>
  Number number(std::size_t place) const {
    std::array<char, sizeof(Number)> bytes{};
    std::memcpy(bytes.data(), bytes_.data() + place, sizeof(Number));
    if (result_.header.big_endian) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<Number>(bytes);
  }
  double real(std::size_t place, std::size_t index = 0) const {
    return layout_->wide ? number<double>(place + 8 * index) : static_cast<double>(number<float>(place + 4 * index));
  }
  std::int64_t dim(std::size_t index) const {
    return layout_->wide ? number<std::int64_t>(layout_->dim + 8 * index)
                         : std::int64_t{number<std::int16_t>(layout_->dim + 2 * index)};
  }
  int code(std::size_t place) const {
    return layout_->wide ? number<std::int32_t>(place) : int{number<std::int16_t>(place)};
  }

  /// The first number is the size of the header, and so tells the version and the order of bytes.
  void find_version(std::string_view first) {
    for (const Layout* layout : {&kVersion1, &kVersion2}) {
      for (const bool big : {false, true}) {
        std::array<char, 4> bytes{};
        first.copy(bytes.data(), bytes.size());
        if (big) std::reverse(bytes.begin(), bytes.end());
        if (std::bit_cast<std::uint32_t>(bytes) != layout->size) continue;
        layout_ = layout;
        result_.header.big_endian = big;
        return;
      }
    }
    throw error("sizeof_hdr", "is neither 348 (NIfTI-1) nor 540 (NIfTI-2): no NIfTI file; save it again");
  }

  void check_magic() const {
    const std::string_view magic(bytes_.data() + layout_->magic, 4);
    if (magic == (layout_->wide ? std::string_view("n+2\0", 4) : std::string_view("n+1\0", 4))) return;
    const bool pair = magic.starts_with("ni1") || magic.starts_with("ni2");
    throw error("magic", pair ? "says that the points are in an .img file beside it; save it as a single .nii"
                              : "is not that of NIfTI-1 or NIfTI-2 (Analyze?); save it as .nii.gz");
  }

  void read_type() {
    const int datatype = number<std::int16_t>(layout_->datatype);
    const auto type = scalar_type(datatype);
    if (!type) {
      throw error("datatype",
                  fmt::format("is {}, no single number a point; save it as unsigned short (512)", datatype));
    }
    result_.header.type = *type;
    const int bits = number<std::int16_t>(layout_->bitpix);
    if (bits != 8 * type->bytes) {
      throw error("bitpix", fmt::format("is {}; must be {} for datatype {}", bits, 8 * type->bytes, datatype));
    }
  }

  void read_sizes() {
    const std::int64_t axes = dim(0);
    if (axes < 3 || axes > 7) throw error("dim", fmt::format("states {} axes; must be 3", axes));
    for (std::int64_t axis = 4; axis <= axes; ++axis) {
      const std::int64_t count = dim(static_cast<std::size_t>(axis));
      if (count == 1) continue;
      throw error("dim", fmt::format("states {} volumes along axis {}; must be 1. Save one segmentation", count, axis));
    }
    set_counts(result_.header, {dim(1), dim(2), dim(3)}, 1, file_, "dim");
  }

  void read_scaling() {
    const double slope = real(layout_->slope), intercept = real(layout_->inter);
    if (slope == 0.0 || !std::isfinite(slope)) return;  // no scaling, as the format says
    constexpr double kMost = 65'535.0;
    const bool whole = slope == std::floor(slope) && intercept == std::floor(intercept);
    if (!whole || std::abs(slope) > kMost || !(std::abs(intercept) <= kMost)) {
      throw error(
          "scl_slope, scl_inter",
          fmt::format("are {} and {}; must be whole numbers within +-{}, or 0: labels are not scaled. Save it as "
                      "integer labels",
                      to_text(slope), to_text(intercept), kMost));
    }
    result_.header.slope = static_cast<std::int64_t>(slope);
    result_.header.intercept = static_cast<std::int64_t>(intercept);
  }

  double millimetres() {
    const int units =
        layout_->wide ? number<std::int32_t>(layout_->xyzt_units) : int{number<std::uint8_t>(layout_->xyzt_units)};
    constexpr int kLength = 7;  // the lowest three bits; the others are of time
    switch (units & kLength) {
      case 0:
        result_.header.notes.emplace_back("xyzt_units: not stated; taken as mm");
        return 1.0;
      case 1:
        return 1e3;
      case 2:
        return 1.0;
      case 3:
        return 1e-3;
      default:
        throw error("xyzt_units", fmt::format("is {}; lengths must be 1 (m), 2 (mm) or 3 (um)", units));
    }
  }

  Vec3 spacings() const { return {real(layout_->pixdim, 1), real(layout_->pixdim, 2), real(layout_->pixdim, 3)}; }

  /// Method 2 of the format: a quaternion (a, b, c, d) of unit length with a >= 0, and the third axis reversed where
  /// pixdim[0] is negative (qfac).
  Mat3 quaternion_steps() const {
    double b = real(layout_->quatern, 0), c = real(layout_->quatern, 1), d = real(layout_->quatern, 2);
    double a = 1.0 - (b * b + c * c + d * d);
    constexpr double kRounding = 1e-7;  // of single precision, as the format's own code has it
    if (a < kRounding) {                // half a turn; b, c, d may be too long by rounding
      const double length = std::sqrt(b * b + c * c + d * d);
      b /= length;
      c /= length;
      d /= length;
      a = 0.0;
    } else {
      a = std::sqrt(a);
    }
    Mat3 turn;
    turn << a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c),  //
        2 * (b * c + a * d), a * a + c * c - b * b - d * d, 2 * (c * d - a * b),      //
        2 * (b * d - a * c), 2 * (c * d + a * b), a * a + d * d - b * b - c * c;
    const double qfac = real(layout_->pixdim, 0) < 0.0 ? -1.0 : 1.0;
    return turn * spacings().cwiseProduct(Vec3(1.0, 1.0, qfac)).asDiagonal();
  }

  Mat3 affine_steps() const {
    Mat3 steps;
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 3; ++column) {
        steps(static_cast<int>(row), static_cast<int>(column)) = real(layout_->srow, 4 * row + column);
      }
    }
    return steps;
  }

  void check_spacings() const {
    const Vec3 mm = spacings();
    if (mm.minCoeff() > 0.0 && mm.allFinite()) return;
    throw error("pixdim", fmt::format("holds the spacings {}, {}, {}; must be above zero. Correct the header",
                                      to_text(mm.x()), to_text(mm.y()), to_text(mm.z())));
  }

  /// The affine of the sform before the quaternion of the qform, as the format advises where both are there.
  void read_places() {
    VolumeHeader& header = result_.header;
    const double scale = millimetres();
    const bool affine = code(layout_->sform_code) > 0, quaternion = code(layout_->qform_code) > 0;
    Mat3 steps = Mat3::Identity();
    Vec3 origin = Vec3::Zero();
    if (affine) {
      header.steps_field = "srow";
      steps = affine_steps();
      origin = {real(layout_->srow, 3), real(layout_->srow, 7), real(layout_->srow, 11)};
      if (quaternion && steps.determinant() * quaternion_steps().determinant() < 0.0) {
        header.notes.emplace_back("sform and qform are mirror images of one another; the sform is taken");
      }
    } else {
      check_spacings();
      header.steps_field = "pixdim";
      steps = quaternion ? quaternion_steps() : Mat3(spacings().asDiagonal());
      if (quaternion) origin = {real(layout_->qoffset, 0), real(layout_->qoffset, 1), real(layout_->qoffset, 2)};
      if (!quaternion)
        header.notes.emplace_back("neither sform nor qform: the axes are taken as right, anterior, superior");
    }
    const Vec3 lps_from_ras(-1.0, -1.0, 1.0);
    header.steps_mm = scale * lps_from_ras.asDiagonal() * steps;
    header.origin_mm = scale * lps_from_ras.cwiseProduct(origin);
  }

  void read_offset() {
    const double offset =
        layout_->wide ? static_cast<double>(number<std::int64_t>(layout_->vox_offset)) : real(layout_->vox_offset);
    const auto header = static_cast<double>(layout_->size);
    constexpr double kMost = 1e9;  // extensions may lie before the points
    if (!(offset >= header && offset <= kMost)) {
      throw error("vox_offset", fmt::format("is {}; must be {} or more", to_text(offset), header + 4));
    }
    result_.skip_bytes = static_cast<std::int64_t>(offset) - static_cast<std::int64_t>(layout_->size);
  }

  const std::string& file_;
  const Layout* layout_ = nullptr;
  std::string bytes_;
  VolumeFile result_;
};

}  // namespace

VolumeFile read_nifti_header(ByteSource& source, const std::string& file) {
  return NiftiHeader(source, file).read();
}

}  // namespace myotact::prepare

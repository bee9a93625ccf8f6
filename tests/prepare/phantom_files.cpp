#include "prepare/phantom_files.h"

#include <algorithm>
#include <cstring>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <fmt/format.h>
#include <zlib.h>

namespace myotact::testing {

namespace {

std::string vector_text(const Vec3& v) {
  return fmt::format("({},{},{})", v.x(), v.y(), v.z());
}

std::string type_name(const FileNumbers& numbers) {
  return fmt::format("{}int{}", numbers.is_signed ? "" : "u", 8 * numbers.bytes);
}

std::string packed(std::string_view bytes, int window_bits) {
  z_stream stream{};
  deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, window_bits, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&stream, bytes.size()) + 64, '\0');
  std::string in(bytes);
  stream.next_in = reinterpret_cast<Bytef*>(in.data());
  stream.avail_in = static_cast<uInt>(in.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

/// A header whose fields are set by their place.
class BinaryHeader {
 public:
  BinaryHeader(std::size_t size, bool big_endian) : bytes_(size, '\0'), big_endian_(big_endian) {}

  template <class Number>
  void set(std::size_t place, Number number) {
    std::string part(sizeof number, '\0');
    std::memcpy(part.data(), &number, sizeof number);
    if (big_endian_) std::reverse(part.begin(), part.end());
    bytes_.replace(place, part.size(), part);
  }
  /// A number of 4 bytes in version 1 and of 8 in version 2.
  void set_real(bool wide, std::size_t place, std::size_t index, double value) {
    if (wide) {
      set(place + 8 * index, value);
    } else {
      set(place + 4 * index, static_cast<float>(value));
    }
  }
  void text(std::size_t place, std::string_view text) { bytes_.replace(place, text.size(), text); }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  bool big_endian_;
};

std::int16_t nifti_type(const FileNumbers& numbers) {
  switch (numbers.bytes) {
    case 1:
      return numbers.is_signed ? 256 : 2;
    case 2:
      return numbers.is_signed ? 4 : 512;
    case 4:
      return numbers.is_signed ? 8 : 768;
    default:
      return numbers.is_signed ? 1024 : 1280;
  }
}

/// Places of the same fields in versions 1 and 2 [bytes].
struct NiftiFields {
  std::size_t dim, datatype, bitpix, pixdim, offset, units, qform, sform, quaternion, qoffset, srow, magic;
};

void set_places(BinaryHeader& header, const PhantomGrid& grid, bool wide, NiftiPlaces places, const NiftiFields& at) {
  const Vec3 ras_from_lps(-1, -1, 1);
  const Mat3 steps = ras_from_lps.asDiagonal() * grid.steps_mm;
  const Vec3 origin = ras_from_lps.cwiseProduct(grid.origin_mm);
  const Vec3 spacing = steps.colwise().norm();
  Mat3 turn = steps * spacing.cwiseInverse().asDiagonal();
  const double qfac = turn.determinant() < 0.0 ? -1.0 : 1.0;
  turn.col(2) *= qfac;
  Eigen::Quaterniond q(turn);
  if (q.w() < 0.0) q.coeffs() *= -1.0;
  header.set_real(wide, at.pixdim, 0, qfac);
  const bool affine = places == NiftiPlaces::Affine;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<int>(i);
    header.set_real(wide, at.pixdim, i + 1, spacing[row]);
    if (!affine) header.set_real(wide, at.quaternion, i, q.vec()[row]);
    if (!affine) header.set_real(wide, at.qoffset, i, origin[row]);
    for (std::size_t j = 0; affine && j < 3; ++j) {
      header.set_real(wide, at.srow, 4 * i + j, steps(row, static_cast<int>(j)));
    }
    if (affine) header.set_real(wide, at.srow, 4 * i + 3, origin[row]);
  }
  const std::size_t form = affine ? at.sform : at.qform;
  if (wide) {
    header.set(form, std::int32_t{1});
  } else {
    header.set(form, std::int16_t{1});
  }
}

}  // namespace

std::string number_bytes(const PhantomGrid& grid, const FileNumbers& numbers) {
  std::string bytes;
  for (const int label : phantom_labels(grid)) {
    std::string number(static_cast<std::size_t>(numbers.bytes), '\0');
    number[numbers.big_endian ? number.size() - 1 : 0] = static_cast<char>(label);
    bytes += number;
  }
  return bytes;
}

std::string nrrd_file(const PhantomGrid& grid, const std::string& space, const Vec3& signs, const FileNumbers& numbers,
                      const std::string& more) {
  std::string bytes = fmt::format("NRRD0004\ntype: {}\ndimension: 3\nspace: {}\nsizes: {} {} {}\n", type_name(numbers),
                                  space, grid.counts[0], grid.counts[1], grid.counts[2]);
  bytes += "space directions:";
  for (int axis = 0; axis < 3; ++axis) bytes += " " + vector_text(signs.cwiseProduct(grid.steps_mm.col(axis)));
  bytes += "\nencoding: raw\nspace origin: " + vector_text(signs.cwiseProduct(grid.origin_mm));
  bytes += fmt::format("\nendian: {}\n{}\n", numbers.big_endian ? "big" : "little", more);
  return bytes + number_bytes(grid, numbers);
}

std::string nifti_file(const PhantomGrid& grid, int version, NiftiPlaces places, const FileNumbers& numbers) {
  const bool wide = version == 2;
  const NiftiFields at = wide ? NiftiFields{16, 12, 14, 104, 168, 500, 344, 348, 352, 376, 400, 4}
                              : NiftiFields{40, 70, 72, 76, 108, 123, 252, 254, 256, 268, 280, 344};
  const std::size_t size = wide ? 540 : 348;
  BinaryHeader header(size + 4, numbers.big_endian);
  header.set(0, static_cast<std::int32_t>(size));
  for (std::size_t axis = 0; axis < 4; ++axis) {
    const int value = axis == 0 ? 3 : grid.counts[axis - 1];
    if (wide) {
      header.set(at.dim + 8 * axis, std::int64_t{value});
    } else {
      header.set(at.dim + 2 * axis, static_cast<std::int16_t>(value));
    }
  }
  header.set(at.datatype, nifti_type(numbers));
  header.set(at.bitpix, static_cast<std::int16_t>(8 * numbers.bytes));
  constexpr int kMillimetres = 2;
  if (wide) {
    header.set(at.offset, static_cast<std::int64_t>(size + 4));
    header.set(at.units, std::int32_t{kMillimetres});
    header.text(at.magic, std::string_view("n+2\0\r\n\x1a\n", 8));
  } else {
    header.set(at.offset, static_cast<float>(size + 4));
    header.set(at.units, std::uint8_t{kMillimetres});
    header.text(at.magic, std::string_view("n+1\0", 4));
  }
  set_places(header, grid, wide, places, at);
  return header.bytes() + number_bytes(grid, numbers);
}

std::string meta_image_file(const PhantomGrid& grid, const FileNumbers& numbers, bool packed, const std::string& data) {
  const Vec3 spacing = grid.steps_mm.colwise().norm();
  std::string type = numbers.bytes == 1   ? "CHAR"
                     : numbers.bytes == 2 ? "SHORT"
                     : numbers.bytes == 4 ? "INT"
                                          : "LONG_LONG";
  std::string bytes = "ObjectType = Image\nNDims = 3\nBinaryData = True\n";
  bytes += fmt::format("BinaryDataByteOrderMSB = {}\nCompressedData = {}\nTransformMatrix =",
                       numbers.big_endian ? "True" : "False", packed ? "True" : "False");
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < 3; ++i) bytes += fmt::format(" {}", grid.steps_mm(i, axis) / spacing[axis]);
  }
  const Vec3& origin = grid.origin_mm;
  bytes += fmt::format("\nOffset = {} {} {}\nElementSpacing = {} {} {}\n", origin.x(), origin.y(), origin.z(),
                       spacing.x(), spacing.y(), spacing.z());
  bytes += fmt::format("DimSize = {} {} {}\nElementType = MET_{}{}\nElementDataFile = {}\n", grid.counts[0],
                       grid.counts[1], grid.counts[2], numbers.is_signed ? "" : "U", type, data);
  if (data != "LOCAL") return bytes;
  return bytes + (packed ? zlib(number_bytes(grid, numbers)) : number_bytes(grid, numbers));
}

std::string gzip(std::string_view bytes) {
  return packed(bytes, 16 + MAX_WBITS);
}

std::string zlib(std::string_view bytes) {
  return packed(bytes, MAX_WBITS);
}

}  // namespace myotact::testing

#include "prepare/volume/read_points.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <type_traits>

#include <fmt/format.h>

#include "core/at.h"
#include "core/error.h"

namespace myotact::prepare {

static_assert(std::endian::native == std::endian::little, "numbers are taken from bytes as they lie");

namespace {

constexpr std::size_t kChunk = std::size_t{1} << 15;  // numbers decoded at a time
constexpr std::int64_t kLargestLabel = std::numeric_limits<std::uint16_t>::max();

std::string place_of(std::size_t number, const VolumeHeader& header) {
  const std::size_t points = at(header.counts[0]) * at(header.counts[1]) * at(header.counts[2]);
  const std::size_t layers = at(header.layers);
  const std::size_t point = header.layers_fastest ? number / layers : number % points;
  const std::size_t layer = header.layers_fastest ? number % layers : number / points;
  const std::size_t nx = at(header.counts[0]), ny = at(header.counts[1]);
  const std::string place = fmt::format("point ({}, {}, {})", point % nx, point / nx % ny, point / nx / ny);
  return layers == 1 ? place : fmt::format("{} of layer {}", place, layer);
}

/// Decodes numbers in the order of the file and puts each where it belongs.
class Decoder {
 public:
  Decoder(const VolumeHeader& header, const std::string& file) : header_(header), file_(file) {
    const std::size_t points = at(header.counts[0]) * at(header.counts[1]) * at(header.counts[2]);
    layers_.assign(at(header.layers), Labels(points));
  }

  template <class Number>
  void decode(const char* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      Number number;
      std::memcpy(&number, bytes + i * sizeof number, sizeof number);
      put(label_of(header_.big_endian ? reversed(number) : number));
    }
  }

  std::size_t done() const { return done_; }
  std::vector<Labels> take() { return std::move(layers_); }

 private:
  template <class Number>
  static Number reversed(Number number) {
    std::array<char, sizeof number> bytes{};
    std::memcpy(bytes.data(), &number, sizeof number);
    std::reverse(bytes.begin(), bytes.end());
    std::memcpy(&number, bytes.data(), sizeof number);
    return number;
  }

  template <class Number>
  std::uint16_t label_of(Number number) const {
    // Slope and intercept are at most 65535 in size: beyond 2^32 no number becomes a label, and below nothing
    // overflows.
    constexpr std::int64_t kFar = std::int64_t{1} << 32;
    bool far = false;
    if constexpr (sizeof(Number) == 8) {
      far = number > static_cast<Number>(kFar);
      if constexpr (std::is_signed_v<Number>) far = far || number < -kFar;
    }
    const std::int64_t label = far ? -1 : header_.slope * static_cast<std::int64_t>(number) + header_.intercept;
    if (label >= 0 && label <= kLargestLabel) return static_cast<std::uint16_t>(label);
    throw bad_data(file_, place_of(done_, header_),
                   fmt::format("has the label {}; must be 0 .. {}. Save the segmentation with labels from 1 on, as "
                               "unsigned 16-bit integers; a picture of grey values is no segmentation",
                               far ? std::to_string(number) : std::to_string(label), kLargestLabel));
  }

  void put(std::uint16_t label) {
    layers_[layer_][point_] = label;
    ++done_;
    if (header_.layers_fastest) {
      if (++layer_ < layers_.size()) return;
      layer_ = 0;
      ++point_;
    } else {
      if (++point_ < layers_[layer_].size()) return;
      point_ = 0;
      ++layer_;
    }
  }

  const VolumeHeader& header_;
  const std::string& file_;
  std::vector<Labels> layers_;
  std::size_t done_ = 0, layer_ = 0, point_ = 0;
};

void decode(Decoder& decoder, const ScalarType& type, const char* bytes, std::size_t count) {
  switch (type.bytes) {
    case 1:
      return type.is_signed ? decoder.decode<std::int8_t>(bytes, count) : decoder.decode<std::uint8_t>(bytes, count);
    case 2:
      return type.is_signed ? decoder.decode<std::int16_t>(bytes, count) : decoder.decode<std::uint16_t>(bytes, count);
    case 4:
      return type.is_signed ? decoder.decode<std::int32_t>(bytes, count) : decoder.decode<std::uint32_t>(bytes, count);
    default:
      return type.is_signed ? decoder.decode<std::int64_t>(bytes, count) : decoder.decode<std::uint64_t>(bytes, count);
  }
}

Error too_few(const std::string& file, std::uint64_t there, std::uint64_t needed, const char* how) {
  return bad_data(
      file, "data",
      fmt::format("{}{} bytes, but its header asks for {}: it is cut off, or its sizes or its type are wrong", how,
                  there, needed));
}

}  // namespace

std::uint64_t size_of_points(const VolumeHeader& header) {
  std::uint64_t size = static_cast<std::uint64_t>(header.layers) * static_cast<std::uint64_t>(header.type.bytes);
  for (const int count : header.counts) size *= static_cast<std::uint64_t>(count);
  return size;
}

std::vector<Labels> read_points(const VolumeHeader& header, ByteSource& source, const std::string& file) {
  if (header.type.is_float) {
    throw bad_data(file, "type",
                   "holds floating-point numbers; a segmentation needs integers. Save it as integer labels (in 3D "
                   "Slicer: as a segmentation or a label map; else cast it to unsigned short)");
  }
  const std::uint64_t needed = size_of_points(header);
  if (source.most_left() < needed) throw too_few(file, source.most_left(), needed, "holds at most ");
  Decoder decoder(header, file);
  const auto number = static_cast<std::size_t>(header.type.bytes);
  std::vector<char> chunk(kChunk * number);
  for (std::uint64_t left = needed; left > 0;) {
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(left, chunk.size()));
    const std::size_t got = source.read(chunk.data(), wanted);
    if (got < wanted) throw too_few(file, needed - left + got, needed, "holds ");
    decode(decoder, header.type, chunk.data(), got / number);
    left -= got;
  }
  if (source.skip(1) > 0) {
    throw bad_data(
        file, "data",
        fmt::format("holds more than the {} bytes that its header asks for: its sizes or its type are wrong", needed));
  }
  return decoder.take();
}

}  // namespace myotact::prepare

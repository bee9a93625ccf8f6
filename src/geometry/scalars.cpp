#include "geometry/scalars.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "core/text.h"

namespace myotact::geometry {

namespace {

template <class T>
double value_of(std::string_view bytes, Encoding encoding) {
  std::array<char, sizeof(T)> ordered{};
  std::copy(bytes.begin(), bytes.end(), ordered.begin());
  const auto native = std::endian::native == std::endian::little ? Encoding::LittleEndian : Encoding::BigEndian;
  if (encoding != native) std::reverse(ordered.begin(), ordered.end());
  return static_cast<double>(std::bit_cast<T>(ordered));
}

}  // namespace

std::size_t size_of(Scalar type) {
  constexpr std::array<std::size_t, 10> kSizes = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

double Numbers::take(Scalar type) {
  if (encoding_ == Encoding::Text) {
    const std::string_view word = words_.next();
    const auto value = parse_number(word);
    if (!value) throw words_.error(fmt::format("\"{}\" is not a number", shown(word)));
    return *value;
  }
  const std::string_view bytes = words_.bytes(size_of(type));
  switch (type) {
    case Scalar::Int8:
      return value_of<std::int8_t>(bytes, encoding_);
    case Scalar::Uint8:
      return value_of<std::uint8_t>(bytes, encoding_);
    case Scalar::Int16:
      return value_of<std::int16_t>(bytes, encoding_);
    case Scalar::Uint16:
      return value_of<std::uint16_t>(bytes, encoding_);
    case Scalar::Int32:
      return value_of<std::int32_t>(bytes, encoding_);
    case Scalar::Uint32:
      return value_of<std::uint32_t>(bytes, encoding_);
    case Scalar::Int64:
      return value_of<std::int64_t>(bytes, encoding_);
    case Scalar::Uint64:
      return value_of<std::uint64_t>(bytes, encoding_);
    case Scalar::Float32:
      return value_of<float>(bytes, encoding_);
    case Scalar::Float64:
      return value_of<double>(bytes, encoding_);
  }
  return 0.0;
}

double Numbers::finite(Scalar type) {
  const double value = take(type);
  if (!std::isfinite(value)) throw words_.error(fmt::format("{} is no finite number", to_text(value)));
  return value;
}

void Numbers::skip(Scalar type, std::size_t count) {
  if (encoding_ != Encoding::Text) {
    words_.bytes(count * size_of(type));
    return;
  }
  for (std::size_t i = 0; i < count; ++i) take(type);
}

}  // namespace myotact::geometry

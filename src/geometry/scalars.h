#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "geometry/words.h"

namespace myotact::geometry {

enum class Scalar { Int8, Uint8, Int16, Uint16, Int32, Uint32, Int64, Uint64, Float32, Float64 };

/// How a file writes its numbers.
enum class Encoding { Text, LittleEndian, BigEndian };

std::size_t size_of(Scalar type);

/// Numbers of a mesh file, whichever way they are written. Takes them from `words`, whose errors it throws.
class Numbers {
 public:
  Numbers(Words& words, Encoding encoding) : words_(words), encoding_(encoding) {}

  /// NaN and infinity included.
  double take(Scalar type);
  double finite(Scalar type);
  int integer(Scalar type, int lowest, int highest) { return words_.whole(take(type), lowest, highest); }
  void skip(Scalar type, std::size_t count);

  Words& words() { return words_; }
  Encoding encoding() const { return encoding_; }

 private:
  Words& words_;
  Encoding encoding_;
};

}  // namespace myotact::geometry

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "geometry/scalars.h"

namespace myotact::geometry {

struct PlyProperty {
  std::string name;
  Scalar type = Scalar::Float32;
  bool is_list = false;
  Scalar count_type = Scalar::Uint8;
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  std::vector<PlyElement> elements;
  bool has_format = false;
  Encoding encoding = Encoding::Text;
  std::size_t size = 0;  // bytes up to the body
  int lines = 0;         // of the header
};

/// Throws Error BadData naming the line.
PlyHeader read_ply_header(const std::string& file, std::string_view bytes);

}  // namespace myotact::geometry

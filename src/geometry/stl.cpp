#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>

#include <fmt/format.h>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "geometry/corner_welder.h"
#include "geometry/parse_mesh.h"
#include "geometry/words.h"

namespace myotact::geometry {

namespace {

constexpr std::size_t kHeader_bytes = 80 + 4;  // title and count
constexpr std::size_t kFacet_bytes = 50;       // normal, three corners, two unused bytes

std::uint32_t announced_facets(std::string_view bytes) {
  static_assert(std::endian::native == std::endian::little, "binary STL is read little-endian");
  std::uint32_t count = 0;
  if (bytes.size() >= kHeader_bytes) std::memcpy(&count, bytes.data() + 80, sizeof count);
  return count;
}

/// Text begins with "solid" and holds no zero byte; a binary file's title may begin so too, but its numbers hold zeros.
bool is_text(std::string_view bytes) {
  constexpr std::size_t kEnough_bytes = 1024;  // of a binary file: the header and eighteen facets
  const std::string_view start = bytes.substr(0, kEnough_bytes);
  if (start.find('\0') != std::string_view::npos) return false;
  const auto words = words_of(start.substr(0, start.find('\n')));
  return !words.empty() && lower(words[0]) == "solid";
}

bool too_many(const CornerWelder& welder) {
  return welder.vertex_count() > static_cast<std::size_t>(kMostMeshElements);
}

std::string too_many_text() {
  return fmt::format("there are more than {} vertices; simplify the surface", kMostMeshElements);
}

TriangleMesh read_binary(const std::string& file, std::string_view bytes, std::size_t count) {
  CornerWelder welder(count);
  for (std::size_t facet = 0; facet < count; ++facet) {
    const std::size_t start = kHeader_bytes + facet * kFacet_bytes;
    std::array<float, 12> numbers{};
    std::memcpy(numbers.data(), bytes.data() + start, sizeof numbers);
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = {static_cast<double>(numbers[3 + 3 * k]), static_cast<double>(numbers[4 + 3 * k]),
                    static_cast<double>(numbers[5 + 3 * k])};
      if (!corners[k].allFinite()) {
        throw bad_data(file, fmt::format("byte {}", start),
                       fmt::format("facet {} has a corner that is not finite; export the surface again", facet));
      }
    }
    welder.add(corners);
    if (too_many(welder)) throw bad_data(file, fmt::format("byte {}", start), too_many_text());
  }
  return welder.take();
}

Vec3 corner_of(const std::string& file, const std::vector<std::string_view>& words, int line) {
  Vec3 position = Vec3::Constant(std::nan(""));
  for (std::size_t k = 0; k < 3 && words.size() == 4; ++k) {
    position[static_cast<Eigen::Index>(k)] = parse_number(words[k + 1]).value_or(std::nan(""));
  }
  if (!position.allFinite()) throw bad_data(file, fmt::format("{}:1", line), "must be \"vertex X Y Z\", all finite");
  return position;
}

/// Corners gathered until their facet ends; other lines of the format carry nothing that is needed.
class AsciiFacets {
 public:
  explicit AsciiFacets(const std::string& file) : file_(file) {}

  void read_line(const std::vector<std::string_view>& words, int number) {
    const std::string key = lower(words[0]);  // some programs write capitals
    if (key == "vertex") {
      if (filled_ == 3) throw error(number, "a facet has more than 3 corners");
      corners_[filled_++] = corner_of(file_, words, number);
    } else if (key == "endfacet") {
      if (filled_ != 3) throw error(number, "a facet has fewer than 3 corners");
      welder_.add(corners_);
      if (too_many(welder_)) throw error(number, too_many_text());
      filled_ = 0;
    } else if (key == "facet") {
      if (filled_ != 0) throw error(number, "a facet begins before the last one ended");
    } else if (key == "solid" || key == "endsolid") {
      open_ = key == "solid";
    } else if (key != "outer" && key != "endloop") {
      throw error(number, "is no line of an STL");
    }
  }

  TriangleMesh finish(int number) {
    if (open_ || filled_ != 0) throw error(number, "the file ends without endsolid; it was cut off, export it again");
    return welder_.take();
  }

 private:
  Error error(int number, const std::string& problem) const {
    return bad_data(file_, fmt::format("{}:1", number), problem);
  }

  const std::string& file_;
  CornerWelder welder_;
  std::array<Vec3, 3> corners_;
  std::size_t filled_ = 0;
  bool open_ = false;
};

TriangleMesh read_ascii(const std::string& file, std::string_view text) {
  AsciiFacets facets(file);
  int number = 0;
  while (!text.empty()) {
    ++number;
    const std::size_t end = std::min(text.find('\n'), text.size());
    const auto words = words_of(text.substr(0, std::min(end, kLongestLine_bytes)));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!words.empty()) facets.read_line(words, number);
  }
  return facets.finish(number);
}

Error misfit(const std::string& file, std::string_view bytes) {
  if (bytes.size() < kHeader_bytes) {
    return bad_data(file, fmt::format("byte {}", bytes.size()),
                    fmt::format("is no STL: it ends within the header of {} bytes and does not begin with \"solid\"",
                                kHeader_bytes));
  }
  const std::size_t count = announced_facets(bytes);
  return bad_data(file, "byte 80",
                  fmt::format("is no STL: its header announces {} facets ({} bytes), the file has {} bytes; export it "
                              "again",
                              count, kHeader_bytes + count * kFacet_bytes, bytes.size()));
}

}  // namespace

bool is_whole_binary_stl(std::string_view bytes) {
  return bytes.size() >= kHeader_bytes && bytes.size() == kHeader_bytes + announced_facets(bytes) * kFacet_bytes;
}

SurfaceFile parse_stl(std::string_view bytes, const std::string& file) {
  SurfaceFile surface;
  if (!is_whole_binary_stl(bytes) && is_text(bytes)) {
    surface.mesh = read_ascii(file, bytes);
  } else {
    if (bytes.size() < kHeader_bytes || (bytes.size() - kHeader_bytes) % kFacet_bytes != 0) throw misfit(file, bytes);
    const std::size_t count = (bytes.size() - kHeader_bytes) / kFacet_bytes;
    if (count != announced_facets(bytes)) {
      surface.notes.push_back(fmt::format("the header announces {} facets, the file holds {}; all of these are read",
                                          announced_facets(bytes), count));
    }
    surface.mesh = read_binary(file, bytes, count);
  }
  if (surface.mesh.triangles.empty()) throw bad_data(file, "", "holds no triangles");
  return surface;
}

TriangleMesh read_stl(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  SurfaceFile surface = parse_stl(bytes, path.string());
  if (!surface.notes.empty()) throw misfit(path.string(), bytes);
  return std::move(surface.mesh);
}

}  // namespace myotact::geometry

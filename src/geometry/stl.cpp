#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "geometry/mesh_files.h"

namespace myotact::geometry {

namespace {

constexpr std::size_t kHeader_bytes = 80 + 4;  // title and count
constexpr std::size_t kFacet_bytes = 50;       // normal, three corners, two unused bytes

/// Joins corners with the same coordinates, in order of appearance.
class Welder {
 public:
  int vertex(const Vec3& position) {
    const auto [found, added] = index_.try_emplace(to_array(position), static_cast<int>(mesh_.positions_m.size()));
    if (added) mesh_.positions_m.push_back(position);
    return found->second;
  }

  void add(const std::array<Vec3, 3>& corners) {
    mesh_.triangles.push_back({vertex(corners[0]), vertex(corners[1]), vertex(corners[2])});
  }

  TriangleMesh take() { return std::move(mesh_); }

 private:
  std::map<std::array<double, 3>, int> index_;
  TriangleMesh mesh_;
};

TriangleMesh read_binary(const std::string& file, std::string_view bytes, std::size_t count) {
  Welder welder;
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
    if (words[0] == "vertex") {
      if (filled_ == 3) throw error(number, "a facet has more than 3 corners");
      corners_[filled_++] = corner_of(file_, words, number);
    } else if (words[0] == "endfacet") {
      if (filled_ != 3) throw error(number, "a facet has fewer than 3 corners");
      welder_.add(corners_);
      filled_ = 0;
    } else if (words[0] == "solid" || words[0] == "endsolid") {
      open_ = words[0] == "solid";
    } else if (words[0] != "facet" && words[0] != "outer" && words[0] != "endloop") {
      throw error(number, "is no line of an STL");
    }
  }

  TriangleMesh finish(int number) {
    if (open_ || filled_ != 0) throw error(number, "the file ends without endsolid; it was cut off, export it again");
    return welder_.take();
  }

 private:
  Error error(int number, const char* problem) const { return bad_data(file_, fmt::format("{}:1", number), problem); }

  const std::string& file_;
  Welder welder_;
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
    const auto words = words_of(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!words.empty()) facets.read_line(words, number);
  }
  return facets.finish(number);
}

}  // namespace

TriangleMesh read_stl(const std::filesystem::path& path) {
  static_assert(std::endian::native == std::endian::little, "binary STL is read little-endian");
  const std::string file = path.string();
  const std::string bytes = read_file(path);
  std::uint32_t count = 0;
  if (bytes.size() >= kHeader_bytes) std::memcpy(&count, bytes.data() + 80, sizeof count);
  const bool binary = bytes.size() >= kHeader_bytes && bytes.size() == kHeader_bytes + count * kFacet_bytes;
  if (!binary && !bytes.starts_with("solid")) {
    throw bad_data(file, "byte 80",
                   fmt::format("is no STL: its header announces {} facets ({} bytes), the file has {} bytes", count,
                               kHeader_bytes + count * kFacet_bytes, bytes.size()));
  }
  TriangleMesh mesh = binary ? read_binary(file, bytes, count) : read_ascii(file, bytes);
  if (mesh.triangles.empty()) throw bad_data(file, "", "holds no triangles");
  return mesh;
}

}  // namespace myotact::geometry

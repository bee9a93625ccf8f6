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
    const auto [found, added] =
        index_.try_emplace(to_array(position), static_cast<int>(mesh_.positions_m.size()));
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

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t start = line.find_first_not_of(" \t\r");
    if (start == std::string_view::npos) return words;
    line.remove_prefix(start);
    const std::size_t length = std::min(line.find_first_of(" \t\r"), line.size());
    words.push_back(line.substr(0, length));
    line.remove_prefix(length);
  }
}

Vec3 corner_of(const std::string& file, const std::vector<std::string_view>& words, int line) {
  Vec3 position = Vec3::Constant(std::nan(""));
  for (std::size_t k = 0; k < 3 && words.size() == 4; ++k) {
    position[static_cast<Eigen::Index>(k)] = parse_number(words[k + 1]).value_or(std::nan(""));
  }
  if (!position.allFinite()) throw bad_data(file, fmt::format("{}:1", line), "must be \"vertex X Y Z\", all finite");
  return position;
}

TriangleMesh read_ascii(const std::string& file, std::string_view text) {
  Welder welder;
  std::array<Vec3, 3> corners;
  std::size_t filled = 0;
  int number = 0;
  while (!text.empty()) {
    ++number;
    const std::size_t end = std::min(text.find('\n'), text.size());
    const auto words = words_of(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (words.empty()) continue;
    if (words[0] == "vertex") {
      if (filled == 3) throw bad_data(file, fmt::format("{}:1", number), "a facet has more than 3 corners");
      corners[filled++] = corner_of(file, words, number);
    } else if (words[0] == "endfacet") {
      if (filled != 3) throw bad_data(file, fmt::format("{}:1", number), "a facet has fewer than 3 corners");
      welder.add(corners);
      filled = 0;
    }
  }
  return welder.take();
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

#include <array>

#include <fmt/format.h>

#include "geometry/parse_mesh.h"
#include "geometry/surface_builder.h"
#include "geometry/words.h"

// .off: "OFF", the counts of vertices, faces and edges, then a line a vertex and a line a face, "#" before a comment.
// "ST", "C" and "N" before "OFF" announce more numbers behind a vertex; these, and the colours behind a face, are read
// over.

namespace myotact::geometry {

namespace {

/// The words of the next line, of which at least `least` are needed.
std::vector<std::string_view> entry(Words& words, std::size_t least) {
  auto line = words.next_line();
  if (line.size() < least) throw words.error(fmt::format("has {} numbers; must have at least {}", line.size(), least));
  return line;
}

/// How many numbers stand behind a position at least.
std::size_t numbers_behind(const Words& words, std::string_view keyword) {
  struct Prefix {
    std::string_view name;
    std::size_t numbers;
  };
  constexpr std::array<Prefix, 3> kPrefixes = {{{"ST", 2}, {"C", 3}, {"N", 3}}};
  std::string_view rest = keyword;
  std::size_t behind = 0;
  for (const Prefix& prefix : kPrefixes) {
    if (!rest.starts_with(prefix.name)) continue;
    rest.remove_prefix(prefix.name.size());
    behind += prefix.numbers;
  }
  if (rest != "OFF") {
    throw words.error(
        fmt::format("is no OFF file: it begins with \"{}\"; must be OFF, STOFF, COFF, NOFF or CNOFF", shown(keyword)));
  }
  return behind;
}

struct Head {
  int vertices = 0, faces = 0;
  std::size_t behind = 0;
};

Head read_head(Words& words) {
  auto line = entry(words, 1);
  Head head;
  head.behind = numbers_behind(words, line[0]);
  line.erase(line.begin());
  if (line.empty()) line = entry(words, 2);
  if (line[0] == "BINARY") throw words.error("the binary kind of OFF is not read; write it as text");
  if (line.size() < 2) throw words.error("must be the counts of vertices, faces and edges");
  head.vertices = words.integer_in(line[0], 0, kMostMeshElements);
  head.faces = words.integer_in(line[1], 0, kMostMeshElements);
  return head;
}

void read_face(Words& words, SurfaceBuilder& surface, std::vector<int>& corners) {
  const auto line = entry(words, 4);
  const auto count = static_cast<std::size_t>(words.integer_in(line[0], 3, static_cast<int>(kMostCorners)));
  if (line.size() < count + 1) {
    throw words.error(fmt::format("a face of {} corners has {} numbers", count, line.size() - 1));
  }
  corners.clear();
  for (std::size_t k = 1; k <= count; ++k) {
    corners.push_back(words.integer_in(line[k], 0, surface.position_count() - 1));
  }
  surface.add_face(corners);
}

}  // namespace

SurfaceFile parse_off(std::string_view bytes, const std::string& file) {
  Words words(file, bytes, '#');
  SurfaceBuilder surface(words);
  const Head head = read_head(words);
  for (int i = 0; i < head.vertices; ++i) {
    const auto line = entry(words, 3 + head.behind);
    surface.add_position({words.number_in(line[0]), words.number_in(line[1]), words.number_in(line[2])});
  }
  std::vector<int> corners;
  for (int i = 0; i < head.faces; ++i) read_face(words, surface, corners);
  if (!words.at_end()) {
    words.next();
    throw words.error(
        fmt::format("goes on after the {} faces that the header announces; correct its counts or export "
                    "it again",
                    head.faces));
  }
  return surface.take();
}

}  // namespace myotact::geometry

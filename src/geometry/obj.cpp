#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/file.h"
#include "core/text.h"
#include "geometry/parse_mesh.h"
#include "geometry/surface_builder.h"
#include "geometry/words.h"

// Wavefront .obj: "v X Y Z" and "f A B C ..", indices from 1, or back from the last vertex when negative; a corner may
// name a texture place and a normal behind "/". "#" before a comment; "\" ends a line that goes on in the next.

namespace myotact::geometry {

namespace {

/// Words that may begin a line besides v and f; what follows them is no part of the surface. Any other word is refused:
/// a vertex whose "v" is damaged must not shift the indices of all that follow.
constexpr std::array<std::string_view, 39> kReadOver = {
    "vn",   "vt",     "vp",     "g",    "o",     "s",        "mg",       "usemtl",     "mtllib",    "l",
    "p",    "usemap", "maplib", "lod",  "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj", "ctech",
    "csh",  "cstype", "deg",    "bmat", "step",  "curv",     "curv2",    "surf",       "parm",      "trim",
    "hole", "scrv",   "sp",     "end",  "con",   "call",     "stech",    "vc",         "usetex"};

/// The line without a "\" at its end; whether there was one.
bool goes_on(std::string_view& line) {
  const std::size_t last = line.find_last_not_of(" \t\r");
  if (last == std::string_view::npos || line[last] != '\\') return false;
  line = line.substr(0, last);
  return true;
}

/// The words of the next line, which `joined` holds when it goes on over several.
std::vector<std::string_view> next_statement(Words& lines, std::string& joined) {
  std::string_view line = lines.rest_of_line();
  if (!goes_on(line)) return words_of(line);
  joined = line;
  for (bool more = true; more && lines.left() > 0;) {
    line = lines.rest_of_line();
    more = goes_on(line);
    joined += ' ';
    joined += line;
  }
  return words_of(joined);
}

Vec3 position_of(const Words& lines, const std::vector<std::string_view>& statement) {
  if (statement.size() < 4) {
    throw lines.error(fmt::format("a vertex has {} numbers; must have at least 3", statement.size() - 1));
  }
  return {lines.number_in(statement[1]), lines.number_in(statement[2]), lines.number_in(statement[3])};
}

/// The vertex that "7", "7/1/2" or "-1" names, counted from 0.
int vertex_of(const Words& lines, std::string_view corner, int vertices) {
  const int index = lines.integer_in(corner.substr(0, corner.find('/')), -kMostMeshElements, kMostMeshElements);
  const int vertex = index < 0 ? vertices + index : index - 1;
  if (vertex < 0 || vertex >= vertices) {
    throw lines.error(fmt::format("a face names vertex {}; the {} vertices above it are 1 to {}, or -1 to {}", index,
                                  vertices, vertices, -vertices));
  }
  return vertex;
}

}  // namespace

SurfaceFile parse_obj(std::string_view bytes, const std::string& file) {
  Words lines(file, bytes, '#');
  SurfaceBuilder surface(lines);
  std::string joined;
  std::vector<int> corners;
  while (lines.left() > 0) {
    const auto statement = next_statement(lines, joined);
    if (statement.empty()) continue;
    if (statement[0] == "v") {
      surface.add_position(position_of(lines, statement));
    } else if (statement[0] == "f" || statement[0] == "fo") {
      corners.clear();
      for (std::size_t k = 1; k < statement.size(); ++k) {
        corners.push_back(vertex_of(lines, statement[k], surface.position_count()));
      }
      surface.add_face(corners);
    } else if (std::find(kReadOver.begin(), kReadOver.end(), statement[0]) == kReadOver.end()) {
      throw lines.error(fmt::format("\"{}\" begins no line of an OBJ", shown(statement[0])));
    }
  }
  if (!bytes.ends_with('\n')) surface.add_note("its last line has no end; the file may have been cut short");
  return surface.take();
}

}  // namespace myotact::geometry

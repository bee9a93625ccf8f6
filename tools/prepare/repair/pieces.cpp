#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "prepare/remesh/crossing_triangles.h"
#include "prepare/repair/stages.h"
#include "prepare/repair/surface_surgery.h"
#include "prepare/surface/edge_table.h"
#include "prepare/surface/surface_pieces.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

/// V <= this times A^1.5 encloses nothing. A sphere has 0.09, a sheet of 100 x 100 x 0.1 mm 3.5e-4.
constexpr double kNoVolume = 1e-6;
/// Crossings between pieces beyond this number add nothing.
constexpr unsigned kMostPairs = 100000;

struct Piece {
  TriangleMesh mesh;
  double area = 0.0;
  double volume = 0.0;  // signed
};

std::vector<Piece> measured_pieces(const TriangleMesh& mesh) {
  std::vector<Piece> pieces;
  for (TriangleMesh& piece : pieces_of(mesh)) {
    const double area = geometry::surface_area_m2(piece), volume = geometry::enclosed_volume_m3(piece);
    pieces.push_back({std::move(piece), area, volume});
  }
  return pieces;
}

/// Drops the pieces for which `keep` returns false.
void keep_pieces(RepairJob& job, const std::vector<bool>& keep) {
  const std::vector<int> piece = piece_of_triangles(job.mesh);
  std::vector<bool> triangles;
  for (const int p : piece) triangles.push_back(keep[at(p)]);
  keep_triangles(job, triangles, Dropped::LeftOut);
}

double total_area(const std::vector<Piece>& pieces) {
  double area = 0.0;
  for (const Piece& piece : pieces) area += piece.area;
  return area;
}

/// For each piece one that it lies inside, or -1.
std::vector<int> containers_of(const std::vector<Piece>& pieces, const Groups& crossing_groups) {
  Groups crossing = crossing_groups;
  std::vector<int> container(pieces.size(), -1);
  std::vector<Vec3> points;
  for (const Piece& piece : pieces) points.push_back(piece.mesh.positions_m.front());
  for (int outer = 0; outer < static_cast<int>(pieces.size()); ++outer) {
    const std::vector<bool> inside = points_inside(pieces[at(outer)].mesh, points);
    for (int inner = 0; inner < static_cast<int>(inside.size()); ++inner) {
      const bool apart = crossing.group_of(inner) != crossing.group_of(outer);
      const bool smaller = std::abs(pieces[at(inner)].volume) < std::abs(pieces[at(outer)].volume);
      if (inside[at(inner)] && apart && smaller && container[at(inner)] < 0) container[at(inner)] = outer;
    }
  }
  return container;
}

/// Pieces that cross each other, in groups.
Groups crossing_pieces(const RepairJob& job) {
  const TriangleMesh& mesh = job.mesh;
  const std::vector<int> piece = piece_of_triangles(mesh);
  Groups groups(piece.empty() ? 0 : static_cast<std::size_t>(*std::max_element(piece.begin(), piece.end())) + 1);
  if (job.crossing_free) return groups;
  for (const auto& [a, b] : crossing_triangles(mesh, kMostPairs)) groups.join(piece[at(a)], piece[at(b)]);
  return groups;
}

void drop_inner_pieces(RepairJob& job) {
  const std::vector<Piece> pieces = measured_pieces(job.mesh);
  if (pieces.size() < 2) return;
  const std::vector<int> container = containers_of(pieces, crossing_pieces(job));
  std::vector<bool> keep(pieces.size(), true);
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    if (container[p] < 0) continue;
    keep[p] = false;
    const bool against = pieces[p].volume * pieces[at(container[p])].volume < 0.0;
    note(job, against ? "cavities filled" : "shells inside others dropped", 1, pieces[p].mesh.positions_m.front());
  }
  keep_pieces(job, keep);
}

/// Sheets that hung on nothing have become two layers without anything between.
void drop_empty_pieces(RepairJob& job) {
  const std::vector<Piece> pieces = measured_pieces(job.mesh);
  const double area = total_area(pieces);
  std::vector<bool> keep;
  int dropped = 0;
  Vec3 place = Vec3::Zero();
  for (const Piece& piece : pieces) {
    const double fullness = std::abs(piece.volume) / std::pow(piece.area, 1.5);
    keep.push_back(fullness > kNoVolume);
    if (keep.back()) continue;
    if (dropped++ == 0) place = piece.mesh.positions_m.front();
    if (piece.area <= job.settings.floater * area) continue;
    throw refusal(job,
                  fmt::format("encloses nothing: the volume of the piece at {{}} is {:.2g} of its area to the power of "
                              "1.5; must be above {:.0e}. Export a closed body",
                              fullness, kNoVolume),
                  piece.mesh.positions_m.front());
  }
  if (dropped == 0) return;
  keep_pieces(job, keep);
  note(job, "sheets without volume dropped", dropped, place);
}

void wind_outward(RepairJob& job) {
  const std::vector<int> piece = piece_of_triangles(job.mesh);
  const std::vector<Piece> pieces = measured_pieces(job.mesh);
  int flipped = 0;
  Vec3 place = Vec3::Zero();
  for (std::size_t t = 0; t < piece.size(); ++t) {
    if (pieces[at(piece[t])].volume > 0.0) continue;
    std::swap(job.mesh.triangles[t][1], job.mesh.triangles[t][2]);
    if (flipped++ == 0) place = centroid(job.mesh, static_cast<int>(t));
  }
  note(job, "triangles flipped outward", flipped, place);
}

/// Each group as one piece, in the order of their first pieces.
TriangleMesh united(const RepairJob& job, const std::vector<Piece>& pieces, Groups& groups) {
  TriangleMesh whole;
  for (int first = 0; first < static_cast<int>(pieces.size()); ++first) {
    if (groups.group_of(first) != first) continue;
    TriangleMesh body = pieces[at(first)].mesh;
    for (int other = first + 1; other < static_cast<int>(pieces.size()); ++other) {
      if (groups.group_of(other) != first) continue;
      const std::optional<TriangleMesh> both = unite(body, pieces[at(other)].mesh);
      if (!both || !is_closed(*both)) {
        throw refusal(job,
                      "crosses itself: pieces of it cross each other, one of them at {}, and could not be united. "
                      "Unite or part them and export it again",
                      pieces[at(other)].mesh.positions_m.front());
      }
      body = *both;
    }
    append(whole, body);
  }
  return whole;
}

void unite_crossing(RepairJob& job) {
  const std::vector<Piece> pieces = measured_pieces(job.mesh);
  if (pieces.size() < 2) return;
  Groups groups = crossing_pieces(job);
  int joined = 0;
  Vec3 place = Vec3::Zero();
  for (int p = 0; p < static_cast<int>(pieces.size()); ++p) {
    if (groups.group_of(p) == p) continue;
    if (joined++ == 0) place = pieces[at(p)].mesh.positions_m.front();
  }
  if (joined == 0) return;
  adopt(job, united(job, pieces, groups), kPatch);
  job.united = true;
  job.crossing_free = false;
  note(job, "crossing pieces united with others", joined, place);
}

void drop_floaters(RepairJob& job) {
  if (job.settings.several_bodies) return;
  const std::vector<Piece> pieces = measured_pieces(job.mesh);
  if (pieces.size() < 2) return;
  const auto largest =
      std::max_element(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.area < b.area; });
  std::vector<bool> keep;
  for (auto piece = pieces.begin(); piece != pieces.end(); ++piece) {
    keep.push_back(piece == largest);
    const double part = piece->area / largest->area;
    if (piece == largest) continue;
    if (part > job.settings.floater) {
      throw refusal(
          job,
          fmt::format("has {} separate pieces: the one at {{}} has {:.1f} % of the largest one's area; must "
                      "be one piece, and only those below {:.1f} % are dropped. Join them or export each alone",
                      pieces.size(), 100.0 * part, 100.0 * job.settings.floater),
          piece->mesh.positions_m.front());
    }
    note(job, "floating pieces dropped", 1, piece->mesh.positions_m.front());
  }
  keep_pieces(job, keep);
}

}  // namespace

void drop_debris(RepairJob& job) {
  const std::vector<Piece> pieces = measured_pieces(job.mesh);
  if (pieces.size() < 2) return;
  const double area = total_area(pieces);
  double dropped = 0.0;
  std::vector<bool> keep;
  Vec3 place = Vec3::Zero();
  int specks = 0;
  for (const Piece& piece : pieces) {
    keep.push_back(piece.area >= job.settings.debris * area);
    if (keep.back()) continue;
    dropped += piece.area / area;
    if (specks++ == 0) place = piece.mesh.positions_m.front();
  }
  if (specks == 0) return;
  if (dropped > job.settings.all_debris) {
    throw refusal(
        job,
        fmt::format("is shattered into {} separate pieces: specks, one at {{}}, have {:.1f} % of its area; at "
                    "most {:.1f} % is dropped. Join the pieces and export it again",
                    pieces.size(), 100.0 * dropped, 100.0 * job.settings.all_debris),
        place);
  }
  keep_pieces(job, keep);
  note(job, "loose specks dropped", specks, place);
}

void settle_pieces(RepairJob& job) {
  drop_empty_pieces(job);
  drop_inner_pieces(job);
  wind_outward(job);
}

void unite_pieces(RepairJob& job) {
  unite_crossing(job);
  drop_floaters(job);
}

}  // namespace myotact::prepare

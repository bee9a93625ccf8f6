#include "prepare/part/cut_muscle.h"

#include <algorithm>
#include <array>
#include <optional>

#include "geometry/triangle_tree.h"
#include "prepare/field/level_set.h"
#include "prepare/part/film.h"
#include "prepare/surface/surface_pieces.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

/// Triangles that a parted surface is extracted with, roughly; where the body is thin, up to the larger number. Limb
/// muscles get lattices of 0.5 to 1.7 mm.
constexpr double kTriangles = 22000.0;
constexpr double kMostTriangles = 90000.0;
constexpr double kFinestSpacing_m = 4e-4;
/// Half the thickness of films, in spacings. Thinner ones would be missed where they run askew to the lattice.
constexpr double kFilmRadius = 1.25;
/// That of patches, which are made of whole nodes and must not reach the nodes beside them.
constexpr double kPatchRadius = 0.6;
/// What may come off as loose ends, as a part of the volume, before the muscle counts as cut in two.
constexpr double kLooseEnds = 0.02;

/// Dropped pieces that reach farther than this from what is left are no scraps [of the box's diagonal].
constexpr double kLooseReach = 0.05;

/// A core that stays, and how much finer the lattice is that it is looked at on. When the first falls apart, too, a
/// thicker one is taken.
struct Core {
  double depth, spacing;
};
constexpr std::array<Core, 2> kCores = {{{0.4, 1.0}, {0.2, 0.6}}};

/// Coarse enough for the number of triangles; fine enough for the muscle's tendons and for other muscles' films in it,
/// which it is to see two steps thick.
double spacing_for_m(const SignedDistance& body, const Borders& borders) {
  const double area_m2 = geometry::surface_area_m2(body.surface());
  double usual_m =
      std::min(spacing_for_triangles_m(area_m2, kTriangles), spacing_for_thickness_m(area_m2, body.volume_m3()));
  for (const auto* films : {&borders.earlier_films, &borders.later_films}) {
    for (const SignedDistance* film : *films) {
      usual_m = std::min(usual_m, film->volume_m3() / geometry::surface_area_m2(film->surface()));
    }
  }
  return std::max({kFinestSpacing_m, spacing_for_triangles_m(area_m2, kMostTriangles), usual_m});
}

/// The field of what is left of a muscle, ready to be extracted.
BodyField field_of(const Body& own, const Borders& borders, double clearance_m) {
  return [&own, &borders, clearance_m](const Vec3& p) {
    return kFlattening * left_of_m(own, borders, 0.5 * clearance_m, p);
  };
}

/// Around a muscle and its film, which may lie outside of it where bone does.
Eigen::AlignedBox3d box_of(const Body& own, const Borders& borders) {
  Eigen::AlignedBox3d box = own.distance.box();
  if (borders.own_film) box.extend(borders.own_film->box());
  return box;
}

/// The place of a dropped piece that is farthest from what is left, when that is far enough to matter.
std::optional<Vec3> loose_end(const TriangleMesh& piece, const TriangleMesh& left, const geometry::TriangleTree& tree,
                              double least_m) {
  std::optional<Vec3> end;
  for (const Vec3& p : piece.positions_m) {
    const double away_m = tree.nearest(p, left.positions_m).distance_m;
    if (away_m < least_m) continue;
    least_m = away_m;
    end = p;
  }
  return end;
}

Cut cut_on_lattice(const Body& own, const BodyField& field, const Eigen::AlignedBox3d& box, double spacing_m) {
  std::vector<TriangleMesh> pieces = pieces_of(extract_level_set(field, box, spacing_m));
  Cut cut;
  cut.spacing_m = spacing_m;
  if (pieces.empty()) return cut;
  std::stable_sort(pieces.begin(), pieces.end(), [](const TriangleMesh& a, const TriangleMesh& b) {
    return geometry::enclosed_volume_m3(a) > geometry::enclosed_volume_m3(b);
  });
  const geometry::TriangleTree tree(pieces.front());
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    cut.dropped_m3 += geometry::enclosed_volume_m3(pieces[i]);
    const double least_m = kLooseReach * own.distance.box().diagonal().norm();
    if (const auto end = loose_end(pieces[i], pieces.front(), tree, least_m)) cut.loose_ends.push_back(*end);
  }
  cut.left = std::move(pieces.front());
  cut.added_genus = genus(cut.left) - genus(own.distance.surface());
  return cut;
}

Film find_film(const Body& own, const Borders& borders, double clearance_m, const Cut& cut) {
  const BodyField distance = [&](const Vec3& p) { return own.distance(p); };
  const BodyField taken = [&](const Vec3& p) { return taken_m(borders, 0.5 * clearance_m, p); };
  const BodyField left = field_of(own, borders, clearance_m);
  return Film({box_of(own, borders), distance, left, taken, cut.loose_ends}, cut.spacing_m);
}

}  // namespace

Cut cut_muscle(const Body& own, const Borders& borders, double clearance_m) {
  return cut_on_lattice(own, field_of(own, borders, clearance_m), box_of(own, borders),
                        spacing_for_m(own.distance, borders));
}

bool falls_apart(const Body& own, const Cut& cut) {
  return cut.dropped_m3 > kLooseEnds * own.distance.volume_m3();
}

void keep_core(const Body& own, Borders& borders, double clearance_m, Cut& cut) {
  for (const Core& core : kCores) {
    if (!falls_apart(own, cut)) break;
    Borders with_core = borders;
    with_core.core = core.depth;
    const double spacing_m = core.spacing * spacing_for_m(own.distance, borders);
    Cut more = cut_on_lattice(own, field_of(own, with_core, clearance_m), box_of(own, with_core), spacing_m);
    if (more.dropped_m3 >= cut.dropped_m3) continue;
    cut = std::move(more);
    borders = std::move(with_core);
  }
}

TriangleMesh film_surface(const Body& own, const Borders& borders, double clearance_m, const Cut& cut) {
  if (!cut.needs_film()) return {};
  const Film film = find_film(own, borders, clearance_m, cut);
  return film.empty() ? TriangleMesh{} : film.surface(kFilmRadius * cut.spacing_m);
}

TriangleMesh patch(const Body& own, const Borders& borders, double clearance_m, Cut& cut) {
  if (!cut.needs_film()) return {};
  const Film film = find_film(own, borders, clearance_m, cut);
  if (film.empty()) return {};
  const double radius_m = kPatchRadius * cut.spacing_m;
  const BodyField field = field_of(own, borders, clearance_m);
  const auto patched = [&](const Vec3& p) { return std::min(field(p), kFlattening * (film.distance_m(p) - radius_m)); };
  Cut closed = cut_on_lattice(own, patched, box_of(own, borders), cut.spacing_m);
  const bool better = closed.added_genus <= cut.added_genus && closed.loose_ends.size() <= cut.loose_ends.size();
  if (!better) return {};
  cut = std::move(closed);
  return film.surface(radius_m);
}

}  // namespace myotact::prepare

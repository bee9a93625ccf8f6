#include "prepare/part/cut_muscle.h"

#include <algorithm>
#include <array>

#include "prepare/field/level_set.h"
#include "prepare/part/film.h"
#include "prepare/repair/surface_pieces.h"

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

/// A core that stays, and how much finer the lattice is that it is looked at on. When the first falls apart, too, a
/// thicker one is taken.
struct Core {
  double depth, spacing;
};
constexpr std::array<Core, 2> kCores = {{{0.4, 1.0}, {0.2, 0.6}}};

double spacing_for_m(const SignedDistance& body) {
  const double area_m2 = geometry::surface_area_m2(body.surface());
  return std::max(
      {kFinestSpacing_m, spacing_for_triangles_m(area_m2, kMostTriangles),
       std::min(spacing_for_triangles_m(area_m2, kTriangles), spacing_for_thickness_m(area_m2, body.volume_m3()))});
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

Cut cut_on_lattice(const Body& own, const BodyField& field, const Eigen::AlignedBox3d& box, double spacing_m) {
  Cut cut;
  cut.spacing_m = spacing_m;
  double best_m3 = 0.0, sum_m3 = 0.0;
  for (TriangleMesh& piece : pieces_of(extract_level_set(field, box, spacing_m))) {
    const double volume_m3 = geometry::enclosed_volume_m3(piece);
    sum_m3 += volume_m3;
    if (volume_m3 <= best_m3) continue;
    best_m3 = volume_m3;
    cut.left = std::move(piece);
  }
  cut.dropped_m3 = sum_m3 - best_m3;
  cut.tunnels = tunnels(cut.left) - tunnels(own.distance.surface());
  return cut;
}

Film find_film(const Body& own, const Borders& borders, double clearance_m, double spacing_m) {
  const BodyField distance = [&](const Vec3& p) { return own.distance(p); };
  const BodyField taken = [&](const Vec3& p) { return taken_m(borders, 0.5 * clearance_m, p); };
  return Film({box_of(own, borders), distance, field_of(own, borders, clearance_m), taken}, spacing_m);
}

}  // namespace

Cut cut_muscle(const Body& own, Borders& borders, double clearance_m) {
  const double spacing_m = spacing_for_m(own.distance);
  Cut cut = cut_on_lattice(own, field_of(own, borders, clearance_m), box_of(own, borders), spacing_m);
  for (const Core& core : kCores) {
    if (cut.dropped_m3 <= kLooseEnds * own.distance.volume_m3()) break;
    Borders with_core = borders;
    with_core.core = core.depth;
    Cut more =
        cut_on_lattice(own, field_of(own, with_core, clearance_m), box_of(own, with_core), core.spacing * spacing_m);
    if (more.dropped_m3 >= cut.dropped_m3) continue;
    cut = std::move(more);
    borders = std::move(with_core);
  }
  return cut;
}

TriangleMesh film_over_tunnels(const Body& own, const Borders& borders, double clearance_m, const Cut& cut) {
  if (cut.tunnels <= 0) return {};
  const Film film = find_film(own, borders, clearance_m, cut.spacing_m);
  return film.empty() ? TriangleMesh{} : film.surface(kFilmRadius * cut.spacing_m);
}

void patch_tunnels(const Body& own, const Borders& borders, double clearance_m, Cut& cut) {
  if (cut.tunnels <= 0) return;
  const Film film = find_film(own, borders, clearance_m, cut.spacing_m);
  const BodyField field = field_of(own, borders, clearance_m);
  const auto patched = [&](const Vec3& p) {
    return std::min(field(p), kFlattening * (film.distance_m(p) - kPatchRadius * cut.spacing_m));
  };
  Cut closed = cut_on_lattice(own, patched, box_of(own, borders), cut.spacing_m);
  if (closed.tunnels < cut.tunnels) cut = std::move(closed);
}

}  // namespace myotact::prepare

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "prepare/dirty_edits.h"
#include "prepare/dirty_surfaces.h"
#include "prepare/shapes.h"
#include "prepare/surface/surface_pieces.h"

namespace myotact::testing {

using geometry::TriangleMesh;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TriangleMesh box(double low, double high) {
  return box_surface(Vec3::Constant(low), Vec3::Constant(high));
}

/// A strip of `steps` x 1 squares closed to a ring with half a turn.
TriangleMesh moebius() {
  constexpr int kSteps = 24;
  TriangleMesh strip;
  for (int i = 0; i < kSteps; ++i) {
    const double u = 2.0 * std::numbers::pi * i / kSteps;
    for (const double w : {-0.01, 0.01}) {
      const double radius_m = 0.05 + w * std::cos(0.5 * u);
      strip.positions_m.emplace_back(radius_m * std::cos(u), radius_m * std::sin(u), w * std::sin(0.5 * u));
    }
    const bool seam = i + 1 == kSteps;
    const int a = 2 * i, b = 2 * i + 1, c = seam ? 1 : 2 * i + 2, d = seam ? 0 : 2 * i + 3;
    strip.triangles.push_back({a, c, b});
    strip.triangles.push_back({b, c, d});
  }
  return strip;
}

/// The figure-eight immersion of Klein's bottle.
TriangleMesh klein_bottle() {
  constexpr int kRound = 32, kAcross = 16;
  TriangleMesh bottle;
  for (int i = 0; i < kRound; ++i) {
    const double u = 2.0 * std::numbers::pi * i / kRound;
    for (int j = 0; j < kAcross; ++j) {
      const double v = 2.0 * std::numbers::pi * j / kAcross;
      const double r = std::cos(0.5 * u) * std::sin(v + 0.1) - std::sin(0.5 * u) * std::sin(2.0 * v + 0.2);
      const double h = std::sin(0.5 * u) * std::sin(v + 0.1) + std::cos(0.5 * u) * std::sin(2.0 * v + 0.2);
      bottle.positions_m.emplace_back((0.05 + 0.015 * r) * std::cos(u), (0.05 + 0.015 * r) * std::sin(u), 0.015 * h);
      const bool seam = i + 1 == kRound;
      const auto next = [&](int k) {
        return seam ? (kAcross - k % kAcross) % kAcross : (i + 1) * kAcross + k % kAcross;
      };
      const int a = i * kAcross + j, b = i * kAcross + (j + 1) % kAcross;
      bottle.triangles.push_back({a, next(j), b});
      bottle.triangles.push_back({b, next(j), next(j + 1)});
    }
  }
  return bottle;
}

TriangleMesh flat_sheet() {
  constexpr int kCells = 10;
  TriangleMesh sheet;
  for (int i = 0; i <= kCells; ++i) {
    for (int j = 0; j <= kCells; ++j) sheet.positions_m.emplace_back(0.01 * i, 0.01 * j, 1e-3 * std::sin(i + 2.0 * j));
  }
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      const int a = i * (kCells + 1) + j;
      sheet.triangles.push_back({a, a + kCells + 1, a + 1});
      sheet.triangles.push_back({a + 1, a + kCells + 1, a + kCells + 2});
    }
  }
  return sheet;
}

TriangleMesh random_triangles(std::mt19937& random) {
  TriangleMesh heap;
  for (int i = 0; i < 100; ++i) heap.positions_m.push_back(random_vector(random, 0.05));
  for (int i = 0; i < 200; ++i) {
    heap.triangles.push_back(
        {static_cast<int>(random() % 100), static_cast<int>(random() % 100), static_cast<int>(random() % 100)});
  }
  return heap;
}

/// Each triangle shrunk towards its middle, so that none hangs together with another.
TriangleMesh shattered(const TriangleMesh& mesh) {
  TriangleMesh pieces;
  for (const auto& t : mesh.triangles) {
    const Vec3 middle = (mesh.positions_m[at(t[0])] + mesh.positions_m[at(t[1])] + mesh.positions_m[at(t[2])]) / 3.0;
    const int base = static_cast<int>(pieces.positions_m.size());
    for (const int v : t) pieces.positions_m.push_back(middle + 0.8 * (mesh.positions_m[at(v)] - middle));
    pieces.triangles.push_back({base, base + 1, base + 2});
  }
  return pieces;
}

/// Closes the ring to a point that all its sides share.
void pinch(TriangleMesh& mesh, const TubeBody& body, int ring, double width) {
  Vec3 middle = Vec3::Zero();
  for (int side = 0; side < body.sides; ++side) middle += mesh.positions_m[at(body.vertex(ring, side))] / body.sides;
  for (int side = 0; side < body.sides; ++side) {
    Vec3& p = mesh.positions_m[at(body.vertex(ring, side))];
    p = middle + width * (p - middle);
  }
}

void add_specks(TriangleMesh& mesh, const TubeBody& body, int count) {
  for (int i = 0; i < count; ++i) {
    const int row = i / 20;
    const Vec3 corner(2e-3 * (i % 20), 0.08 + 2e-3 * row, 0.05);
    prepare::append(mesh, box_surface(corner, corner + Vec3::Constant(2e-3 * diagonal_of(body.mesh))));
  }
}

void add_pieces(std::vector<DirtyKind>& kinds) {
  using enum Expected;
  kinds.push_back({"specks beside it", edit([](auto& m, const TubeBody& b, auto&) { add_specks(m, b, 5); }), Repaired,
                   "specks", 1e-9});
  kinds.push_back({"two hundred specks", edit([](auto& m, const TubeBody& b, auto&) { add_specks(m, b, 200); }),
                   Repaired, "specks", 1e-9});
  kinds.push_back(
      {"shattered", [](const TubeBody& b, auto&) { return shattered(b.mesh); }, Refused, "separate pieces"});
  kinds.push_back(
      {"a shell inside", edit([](auto& m, const TubeBody& b, auto&) {
         prepare::append(
             m, scaled(b.mesh, 0.3, Vec3(0.0, b.mesh.positions_m[at(b.vertex(b.rings / 2, 0))].y() * 0.35, 0.0)));
       }),
       Repaired, "shells inside", 1e-9});
  kinds.push_back(
      {"a cavity", edit([](auto& m, const TubeBody& b, auto&) {
         prepare::append(
             m,
             turned(scaled(b.mesh, 0.3, Vec3(0.0, b.mesh.positions_m[at(b.vertex(b.rings / 2, 0))].y() * 0.35, 0.0))));
       }),
       Repaired, "cavities", 1e-9});
  kinds.push_back({"a second body far away", edit([](auto& m, const TubeBody& b, auto&) {
                     prepare::append(m, scaled(b.mesh, 1.0, Vec3(0.0, 0.2, 0.0)));
                   }),
                   Refused, "separate pieces"});
  kinds.push_back({"a small body beside it", edit([](auto& m, const TubeBody& b, auto&) {
                     prepare::append(m, scaled(b.mesh, 0.15, Vec3(0.0, 0.2, 0.0)));
                   }),
                   Repaired, "floating", 1e-9});
  kinds.push_back({"a copy shifted by half", edit([](auto& m, const TubeBody& b, auto&) {
                     prepare::append(m, scaled(b.mesh, 1.0, Vec3(0.0613, 0.0011, 0.0007)));
                   }),
                   Repaired, "united", 0.35, 1.55});
  kinds.push_back({"a copy shifted by a little", edit([](auto& m, const TubeBody& b, auto&) {
                     prepare::append(m, scaled(b.mesh, 1.0, Vec3(1.1e-4, 0.7e-4, 0.3e-4)));
                   }),
                   Repaired, "united", 0.1, 1.03});
  kinds.push_back({"a box through it", edit([](auto& m, const TubeBody& b, auto&) {
                     const Vec3 middle = b.mesh.positions_m[at(b.vertex(b.rings / 2, 1))];
                     prepare::append(m, box_surface(middle - Vec3::Constant(0.0061), middle + Vec3::Constant(0.0057)));
                   }),
                   Repaired, "united", 0.1, 1.05});
  kinds.push_back({"two bodies that share a vertex", edit([](auto& m, const TubeBody& b, auto&) {
                     const Vec3 shift = b.mesh.positions_m.back() - b.mesh.positions_m.front();
                     prepare::append(m, scaled(b.mesh, 1.0, shift));
                   }),
                   Refused, "separate pieces"});
  kinds.push_back({"a speck that shares a vertex", edit([](auto& m, const TubeBody& b, auto&) {
                     const Vec3 end = b.mesh.positions_m.back();
                     prepare::append(m, box_surface(end, end + Vec3::Constant(1e-3)));
                   }),
                   Repaired, "specks", 1e-9});
  kinds.push_back({"pinched to a point", edit([](auto& m, const TubeBody& b, auto&) { pinch(m, b, b.rings / 2, 0.0); }),
                   Refused, "separate pieces"});
  kinds.push_back({"pinched to a neck", edit([](auto& m, const TubeBody& b, auto&) { pinch(m, b, b.rings / 2, 0.02); }),
                   Untouched, "", 0.0, 0.0});
}

void add_crossings(std::vector<DirtyKind>& kinds) {
  using enum Expected;
  kinds.push_back({"two neighbours swapped", edit([](auto& m, const TubeBody& b, auto&) {
                     std::swap(m.positions_m[at(b.vertex(1, 3))], m.positions_m[at(b.vertex(1, 4))]);
                   }),
                   Repaired, "crossings", 0.02});
  kinds.push_back({"a spike outward", edit([](auto& m, const TubeBody& b, auto&) {
                     const int v = b.vertex(b.rings / 2, 8);
                     m.positions_m[at(v)] += 0.03 * geometry::vertex_normals(m)[at(v)];
                   }),
                   Untouched, "", 0.0, 0.0});
  kinds.push_back({"a spike through the other side", edit([](auto& m, const TubeBody& b, auto&) {
                     const int v = b.vertex(b.rings / 2, b.sides / 4);
                     const int w = b.vertex(b.rings / 2, 3 * b.sides / 4);
                     m.positions_m[at(v)] = m.positions_m[at(w)] + 0.3 * (m.positions_m[at(w)] - m.positions_m[at(v)]);
                   }),
                   Refused, ""});
  kinds.push_back({"an end bent into the middle", edit([](auto& m, const TubeBody& b, auto&) {
                     for (Vec3& p : m.positions_m) {
                       const double turn = std::max(0.0, p.x() - 0.01) / 0.012;
                       const double reach = std::min(p.x(), 0.01);
                       p = Vec3(reach + 0.012 * std::sin(turn) + p.z() * 0.1, p.y(),
                                p.z() + 0.012 * (1.0 - std::cos(turn)));
                     }
                     m.positions_m[at(b.last())] *= 1.0;
                   }),
                   Refused, "cross"});
  kinds.push_back({"noise of half an edge", edit([](auto& m, auto&, auto& random) {
                     const double edge_m =
                         (m.positions_m[at(m.triangles[700][0])] - m.positions_m[at(m.triangles[700][1])]).norm();
                     for (Vec3& p : m.positions_m) p += random_vector(random, 0.7 * edge_m);
                   }),
                   Refused, ""});
  kinds.push_back({"a vertex that is not finite", edit([](auto& m, auto&, auto&) { m.positions_m[77].y() = kNan; }),
                   Refused, "vertex 77: is not finite"});
  kinds.push_back({"an infinite vertex", edit([](auto& m, auto&, auto&) { m.positions_m[78].z() = kInfinity; }),
                   Refused, "vertex 78: is not finite"});
  kinds.push_back({"an index too high", edit([](auto& m, auto&, auto&) { m.triangles[9][1] = 1'000'000; }), Refused,
                   "triangle 9: names vertex 1000000"});
  kinds.push_back({"a negative index", edit([](auto& m, auto&, auto&) { m.triangles[9][1] = -3; }), Refused,
                   "triangle 9: names vertex -3"});
}

void add_units(std::vector<DirtyKind>& kinds) {
  using enum Expected;
  const auto moved = [](double factor, double shift_m, bool hole) -> Make {
    return [=](const TubeBody& b, auto&) {
      const TriangleMesh mesh = hole ? without(b.mesh, {b.vertex(9, 3)}) : b.mesh;
      return scaled(mesh, factor, Vec3(shift_m, -shift_m, 0.5 * shift_m));
    };
  };
  kinds.push_back({"100 km away", moved(1.0, 1e5, false), Untouched, "", 1e-6});
  kinds.push_back({"100 km away, with a hole", moved(1.0, 1e5, true), Repaired, "holes closed"});
  kinds.push_back({"in kilometres, with a hole", moved(1e-3, 0.0, true), Repaired, "holes closed", 0.01, 1.0, 1e-3});
  kinds.push_back({"in millimetres, with a hole", moved(1e3, 0.0, true), Repaired, "holes closed", 0.01, 1.0, 1e3});
  kinds.push_back({"as thin as paper",
                   [](const TubeBody& b, auto&) {
                     TriangleMesh m = b.mesh;
                     for (Vec3& p : m.positions_m) p.z() *= 2e-3;
                     return m;
                   },
                   Untouched, "", 0.0, 0.0});
  kinds.push_back({"all of slivers",
                   [](const TubeBody& b, auto&) {
                     TriangleMesh m = b.mesh;
                     for (Vec3& p : m.positions_m) p.x() *= 100.0;
                     return m;
                   },
                   Untouched, "", 0.0, 0.0});
  kinds.push_back({"hole, flips, copies and specks", edit([](auto& m, const TubeBody& b, auto&) {
                     m = without(m, {b.vertex(9, 3)});
                     for (const std::size_t t : {10u, 20u, 30u}) flip(m, t);
                     m.triangles.push_back(m.triangles[500]);
                     split_one_side(m, 400);
                     add_fin(m, b, 18, 9);
                     add_specks(m, b, 4);
                   }),
                   Repaired, "holes closed"});
}

/// A body along x from -half to half, as a ring that closes and goes on for 6 % of a turn.
TriangleMesh bent_round(TriangleMesh m) {
  double half_m = 0.0;
  for (const Vec3& p : m.positions_m) half_m = std::max(half_m, p.x());
  for (Vec3& p : m.positions_m) {
    const double turn = 1.06 * std::numbers::pi * p.x() / half_m, radius_m = 1.5 * half_m + p.z();
    p = Vec3(radius_m * std::sin(turn), p.y(), radius_m * std::cos(turn));
  }
  return m;
}

}  // namespace

std::vector<DirtyKind> piece_defects() {
  std::vector<DirtyKind> kinds;
  add_pieces(kinds);
  add_crossings(kinds);
  add_units(kinds);
  return kinds;
}

std::vector<DirtyKind> lone_surfaces() {
  using enum Expected;
  const auto fixed = [](const TriangleMesh& mesh) -> Make { return [mesh](const TubeBody&, auto&) { return mesh; }; };
  const TriangleMesh tetrahedron{{{0, 0, 0}, {0.03, 0, 0}, {0, 0.03, 0}, {0, 0, 0.03}},
                                 {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  TriangleMesh three = tetrahedron, one = tetrahedron, back_to_back = tetrahedron, point = tetrahedron,
               line = tetrahedron;
  three.triangles.pop_back();
  one.triangles.resize(1);
  back_to_back.triangles = {{0, 1, 2}, {0, 2, 1}};
  for (Vec3& p : point.positions_m) p = Vec3(0.1, 0.2, 0.3);
  for (Vec3& p : line.positions_m) p = Vec3(p.x() + 2.0 * p.y() + 3.0 * p.z(), 0.0, 0.0);

  TriangleMesh holed_torus = torus_surface();
  holed_torus.triangles.erase(holed_torus.triangles.begin() + 100, holed_torus.triangles.begin() + 104);
  TriangleMesh edge_boxes = box(0.0, 0.02), face_boxes = box(0.0, 0.02), vertex_boxes = box(0.0, 0.02),
               touching = box(0.0, 0.02), box_with_half_a_side = box(0.0, 0.02);
  prepare::append(edge_boxes, box_surface({0.02, 0.02, 0.0}, {0.04, 0.04, 0.02}));
  prepare::append(face_boxes, box_surface({0.02, 0.0, 0.0}, {0.04, 0.02, 0.02}));
  prepare::append(vertex_boxes, box(0.02, 0.04));
  prepare::append(touching, box_surface({0.02, 0.003, 0.004}, {0.04, 0.013, 0.015}));
  box_with_half_a_side.triangles.pop_back();

  return {{"nothing", fixed({}), Refused, "is empty"},
#ifdef NDEBUG  // takes a minute under sanitizers
          {"a sphere bent until its ends are in each other", fixed(bent_round(sphere_body().mesh)), Repaired,
           "winding number", 0.0, 0.0},
#endif
          {"a muscle bent until its ends are in each other", fixed(bent_round(muscle_body().mesh)), Refused, "cross"},
          {"a tetrahedron", fixed(tetrahedron), Untouched, "", 0.0, 0.0},
          {"a tetrahedron without a side", fixed(three), Refused, "is open"},
          {"a box without half a side", fixed(box_with_half_a_side), Refused, "hole with 3 edges"},
          {"one triangle", fixed(one), Refused, "encloses nothing"},
          {"two triangles back to back", fixed(back_to_back), Refused, "encloses nothing"},
          {"all in one point", fixed(point), Refused, "encloses nothing"},
          {"all on one line", fixed(line), Refused, "encloses nothing"},
          {"Moebius strip", fixed(moebius()), Refused, "one side"},
          {"Klein's bottle", fixed(klein_bottle()), Refused, "one side"},
          {"an open sheet", fixed(flat_sheet()), Refused, "encloses nothing"},
          {"a heap of random triangles", [](const TubeBody&, std::mt19937& random) { return random_triangles(random); },
           Refused, ""},
          {"a torus", fixed(torus_surface()), Untouched, "", 0.0, 0.0},
          {"a torus with a hole", fixed(holed_torus), Repaired, "holes closed", 0.0, 0.0},
          {"two boxes that share a face", fixed(face_boxes), Repaired, "inner walls", 0.0, 0.0},
          {"two boxes that share an edge", fixed(edge_boxes), Refused, "separate pieces"},
          {"two boxes that share a vertex", fixed(vertex_boxes), Refused, "separate pieces"},
          {"two boxes that touch", fixed(touching), Repaired, "united", 0.0, 0.0}};
}

}  // namespace myotact::testing

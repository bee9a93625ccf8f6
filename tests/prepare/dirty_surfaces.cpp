#include "prepare/dirty_surfaces.h"

#include <algorithm>

#include "prepare/dirty_edits.h"
#include "prepare/surface/surface_pieces.h"

namespace myotact::testing {

using geometry::TriangleMesh;

namespace {

void add_holes(std::vector<DirtyKind>& kinds) {
  using enum Expected;
  kinds.push_back({"one triangle missing",
                   edit([](auto& m, auto&, auto&) { m.triangles.erase(m.triangles.begin() + 700); }), Repaired,
                   "holes closed", 2e-3});
  kinds.push_back({"hole of one vertex", [](const TubeBody& b, auto&) { return without(b.mesh, {b.vertex(9, 3)}); },
                   Repaired, "holes closed"});
  kinds.push_back({"hole at an end", [](const TubeBody& b, auto&) { return without(b.mesh, {b.last()}); }, Repaired,
                   "holes closed"});
  kinds.push_back({"round hole", [](const TubeBody& b, auto&) { return with_round_hole(b, 0.06); }, Repaired,
                   "holes closed", 0.02});
  kinds.push_back(
      {"many small holes",
       [](const TubeBody& b, auto&) {
         return without(b.mesh, {b.vertex(3, 1), b.vertex(7, 9), b.vertex(12, 17), b.vertex(16, 5), b.vertex(20, 20)});
       },
       Repaired, "holes closed", 0.02});
}

void add_odd_holes(std::vector<DirtyKind>& kinds) {
  using enum Expected;
  kinds.push_back({"holes that touch in a corner", edit([](auto& m, const TubeBody& b, auto&) {
                     const int v = b.vertex(10, 4);
                     std::vector<std::size_t> around;
                     for (std::size_t t = 0; t < m.triangles.size(); ++t) {
                       if (has_vertex(m.triangles[t], v)) around.push_back(t);
                     }
                     m.triangles.erase(m.triangles.begin() + static_cast<std::ptrdiff_t>(around[3]));
                     m.triangles.erase(m.triangles.begin() + static_cast<std::ptrdiff_t>(around[0]));
                   }),
                   Repaired, "holes closed"});
  kinds.push_back({"hole with a bridge",
                   [](const TubeBody& b, auto&) {
                     TriangleMesh m = without(b.mesh, {b.vertex(10, 4), b.vertex(10, 5), b.vertex(10, 6)});
                     m.triangles.push_back({b.vertex(9, 5), b.vertex(9, 6), b.vertex(11, 5)});
                     return m;
                   },
                   Repaired, "holes closed", 0.02});
  kinds.push_back({"comb of slits", edit([](auto& m, const TubeBody& b, auto&) {
                     for (const int ring : {6, 9, 12, 15, 18}) add_slit(m, b, ring, 2e-3);
                   }),
                   Repaired, "holes closed", 0.02});
  kinds.push_back({"long slit",
                   [](const TubeBody& b, auto&) {
                     TriangleMesh m = b.mesh;
                     std::erase_if(m.triangles, [&](const auto& t) {
                       return std::all_of(t.begin(), t.end(), [&](int v) {
                         return v > 0 && v <= b.vertex(13, b.sides - 1) &&
                                ((v - 1) % b.sides == 2 || (v - 1) % b.sides == 3);
                       });
                     });
                     return m;
                   },
                   Repaired, "holes closed", 0.03});
  kinds.push_back(
      {"large hole", [](const TubeBody& b, auto&) { return with_round_hole(b, 0.18); }, Refused, "is open"});
  kinds.push_back({"half of it",
                   [](const TubeBody& b, auto&) {
                     TriangleMesh m = b.mesh;
                     std::erase_if(m.triangles, [&](const auto& t) {
                       return std::any_of(t.begin(), t.end(), [&](int v) { return v > b.vertex(b.rings / 2, 0); });
                     });
                     return m;
                   },
                   Refused, "is open"});
}

void add_windings_and_copies(std::vector<DirtyKind>& kinds) {
  using enum Expected;
  kinds.push_back(
      {"one triangle flipped", edit([](auto& m, auto&, auto&) { flip(m, 333); }), Repaired, "flipped", 1e-9});
  kinds.push_back({"half flipped at random", edit([](auto& m, auto&, auto& random) {
                     for (std::size_t t = 0; t < m.triangles.size(); ++t) {
                       if (random() % 2 == 0) flip(m, t);
                     }
                   }),
                   Repaired, "flipped", 1e-9});
  kinds.push_back({"inside out", [](const TubeBody& b, auto&) { return turned(b.mesh); }, Repaired, "outward", 1e-9});
  kinds.push_back({"half inside out", edit([](auto& m, auto&, auto&) {
                     for (std::size_t t = 0; t < m.triangles.size() / 2; ++t) flip(m, t);
                   }),
                   Repaired, "flipped", 1e-9});
  kinds.push_back({"triangles twice", edit([](auto& m, auto&, auto&) {
                     for (const std::size_t t : {5u, 50u, 500u}) m.triangles.push_back(m.triangles[t]);
                   }),
                   Repaired, "copies", 1e-9});
  kinds.push_back({"triangles twice, the other way", edit([](auto& m, auto&, auto&) {
                     for (const std::size_t t : {5u, 50u, 500u}) {
                       m.triangles.push_back(m.triangles[t]);
                       flip(m, m.triangles.size() - 1);
                     }
                   }),
                   Repaired, "copies", 1e-9});
  kinds.push_back({"whole surface twice", edit([](auto& m, const TubeBody& b, auto&) { prepare::append(m, b.mesh); }),
                   Repaired, "copies", 1e-9});
  kinds.push_back({"whole surface twice, the other way",
                   edit([](auto& m, const TubeBody& b, auto&) { prepare::append(m, turned(b.mesh)); }), Repaired,
                   "copies", 1e-9});
}

void add_seams(std::vector<DirtyKind>& kinds) {
  using enum Expected;
  const auto soup = [](double gap) -> Make {
    return [gap](const TubeBody& b, std::mt19937& random) { return soup_of(b.mesh, random, gap); };
  };
  kinds.push_back({"triangles of their own vertices", soup(0.0), Repaired, "welded", 1e-9});
  kinds.push_back({"gaps of 1e-12", soup(3e-13), Repaired, "welded", 1e-6});
  kinds.push_back({"gaps of 1e-5", soup(3e-6), Repaired, "welded", 1e-3});
  kinds.push_back({"slits of 5e-5", edit([](auto& m, const TubeBody& b, auto&) { add_slit(m, b, 10, 5e-5); }), Repaired,
                   "welded", 1e-3});
  kinds.push_back(
      {"a T-junction", edit([](auto& m, auto&, auto&) { split_one_side(m, 400); }), Repaired, "split", 1e-9});
  kinds.push_back({"many T-junctions", edit([](auto& m, auto&, auto&) {
                     for (std::size_t t = 3; t < 800; t += 7) split_one_side(m, t);
                   }),
                   Repaired, "split", 1e-9});
  kinds.push_back({"several T-junctions on one edge", edit([](auto& m, auto&, auto&) {
                     split_one_side(m, 400);
                     split_one_side(m, 400);
                     split_one_side(m, m.triangles.size() - 1);
                   }),
                   Repaired, "split", 1e-9});
  kinds.push_back({"caps without area", edit([](auto& m, auto&, auto&) {
                     for (const std::size_t t : {100u, 300u, 600u}) {
                       const int a = m.triangles[t][0], b = m.triangles[t][1];
                       split_one_side(m, t);
                       m.triangles.push_back({b, static_cast<int>(m.positions_m.size()) - 1, a});
                     }
                   }),
                   Repaired, "without area", 1e-9});
  kinds.push_back({"needles without width", edit([](auto& m, const TubeBody& b, auto&) {
                     const int v = b.vertex(8, 8), w = b.vertex(9, 8), copy = static_cast<int>(m.positions_m.size());
                     m.positions_m.push_back(m.positions_m[at(v)]);
                     std::size_t first = 0;
                     while (!has_vertex(m.triangles[first], v) || !has_vertex(m.triangles[first], w)) ++first;
                     for (int& corner : m.triangles[first]) corner = corner == v ? copy : corner;
                     m.triangles.push_back({v, copy, w});
                   }),
                   Repaired, "welded", 1e-9});
  kinds.push_back({"triangles that repeat a corner", edit([](auto& m, auto&, auto&) {
                     m.triangles.push_back({4, 4, 9});
                     m.triangles.push_back({7, 7, 7});
                   }),
                   Repaired, "corners", 1e-9});
  kinds.push_back({"collinear triangles beside it", edit([](auto& m, auto&, auto&) {
                     const int base = static_cast<int>(m.positions_m.size());
                     for (int i = 0; i < 3; ++i) m.positions_m.emplace_back(0.01 * i, 0.0, 0.0);
                     m.triangles.push_back({base, base + 1, base + 2});
                   }),
                   Repaired, "without area", 1e-9});
  kinds.push_back({"vertices without triangles", edit([](auto& m, auto&, auto&) {
                     m.positions_m.emplace_back(9.0, 9.0, 9.0);
                     m.positions_m.emplace_back(0.0, 0.0, 0.0);
                   }),
                   Repaired, "unused", 1e-9});
}

void add_sheets_inside_and_out(std::vector<DirtyKind>& kinds) {
  using enum Expected;
  kinds.push_back(
      {"a fin", edit([](auto& m, const TubeBody& b, auto&) { add_fin(m, b, 10, 3); }), Repaired, "fins", 1e-9});
  kinds.push_back({"a row of fins", edit([](auto& m, const TubeBody& b, auto&) {
                     for (int ring = 3; ring < 20; ++ring) add_fin(m, b, ring, 5);
                   }),
                   Repaired, "fins", 1e-9});
  kinds.push_back({"fins and a hole", edit([](auto& m, const TubeBody& b, auto&) {
                     m = without(m, {b.vertex(15, 15)});
                     add_fin(m, b, 5, 3);
                   }),
                   Repaired, "fins"});
  kinds.push_back({"an inner wall", edit([](auto& m, const TubeBody& b, auto&) { add_wall(m, b, 12); }), Repaired,
                   "inner walls", 1e-9});
  kinds.push_back({"three inner walls and a hole", edit([](auto& m, const TubeBody& b, auto&) {
                     m = without(m, {b.vertex(15, 15)});
                     for (const int ring : {4, 12, 19}) add_wall(m, b, ring);
                   }),
                   Repaired, "inner walls"});
}

}  // namespace

std::vector<DirtyKind> body_defects() {
  std::vector<DirtyKind> kinds;
  kinds.push_back({"clean", [](const TubeBody& b, auto&) { return b.mesh; }, Expected::Untouched, "", 0.0});
  add_holes(kinds);
  add_odd_holes(kinds);
  add_windings_and_copies(kinds);
  add_seams(kinds);
  add_sheets_inside_and_out(kinds);
  return kinds;
}

}  // namespace myotact::testing

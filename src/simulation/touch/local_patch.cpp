#include "simulation/touch/local_patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

#include "core/at.h"
#include "geometry/closest_point.h"

namespace myotact::simulation {
namespace {

/// Skins have edges of about 3 mm: a patch of them is filled within 15 mm in most places.
constexpr double kFirstRadius_m = 0.015;

/// A triangle that the tool may meet, ordered by how near it may come.
struct Candidate {
  double reach_m = 0.0;
  int surface = -1;
  int triangle = -1;

  bool operator<(const Candidate& other) const {
    return std::tie(reach_m, surface, triangle) < std::tie(other.reach_m, other.surface, other.triangle);
  }
};

/// Numbers the vertices of a patch: an open-addressing table on the stack, never more than half full.
class VertexNumbers {
 public:
  /// Place of the vertex in the table; number(place) is -1 when it is new.
  std::size_t place(int surface, int vertex) const {
    const std::uint64_t key = key_of(surface, vertex);
    std::size_t slot = static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> 55U);  // 9 bits
    while (numbers_[slot] >= 0 && keys_[slot] != key) slot = (slot + 1) % kSlots;
    return slot;
  }
  int number(std::size_t place) const { return numbers_[place]; }
  void set(std::size_t place, int surface, int vertex, int number) {
    keys_[place] = key_of(surface, vertex);
    numbers_[place] = static_cast<std::int16_t>(number);
  }
  VertexNumbers() { numbers_.fill(-1); }

 private:
  static constexpr std::size_t kSlots = 512;
  static_assert(kSlots >= 2 * messages::kMaxLocalVertices);

  static std::uint64_t key_of(int surface, int vertex) {
    return (static_cast<std::uint64_t>(surface) << 32U) | static_cast<std::uint32_t>(vertex);
  }
  std::array<std::uint64_t, kSlots> keys_{};
  std::array<std::int16_t, kSlots> numbers_{};
};

/// A lower bound of the distance to the triangle at any time between the frames: between them no vertex is farther than
/// half its way from its nearer frame.
double reach_m(const Vec3& p, const std::array<int, 3>& triangle, std::span<const Vec3> previous_m,
               std::span<const Vec3> current_m) {
  const auto distance = [&](std::span<const Vec3> x) {
    const auto& [a, b, c] = triangle;
    return (geometry::closest_point_on_triangle(p, x[at(a)], x[at(b)], x[at(c)]).position_m - p).norm();
  };
  double way_m2 = 0.0;
  for (const int vertex : triangle)
    way_m2 = std::max(way_m2, (current_m[at(vertex)] - previous_m[at(vertex)]).squaredNorm());
  if (way_m2 == 0.0) return distance(current_m);
  return std::max(0.0, std::min(distance(previous_m), distance(current_m)) - 0.5 * std::sqrt(way_m2));
}

/// A surface's vertices at the last two frames.
struct Frames {
  std::span<const Vec3> previous_m, current_m;
};

/// Gives the triangle's vertices numbers. Returns how many had none.
int number_vertices(int surface, const std::array<int, 3>& triangle, int next, VertexNumbers& numbers) {
  int fresh = 0;
  for (const int vertex : triangle) {
    const std::size_t place = numbers.place(surface, vertex);
    if (numbers.number(place) < 0) numbers.set(place, surface, vertex, next + fresh++);
  }
  return fresh;
}

/// How many of the nearest triangles a model holds: as many as there is room for, and for their vertices.
template <typename Corners>
std::size_t fitting_count(std::span<const Candidate> nearest_first, const Corners& corners) {
  const std::size_t most = std::min(nearest_first.size(), at(messages::kMaxLocalTriangles));
  VertexNumbers numbers;
  int vertices = 0;
  for (std::size_t i = 0; i < most; ++i) {
    vertices += number_vertices(nearest_first[i].surface, corners(nearest_first[i]), vertices, numbers);
    if (vertices > messages::kMaxLocalVertices) return i;
  }
  return most;
}

/// Adds a triangle and its new vertices, which fit.
void add_triangle(const Candidate& candidate, const std::array<int, 3>& triangle, const Frames& frames,
                  VertexNumbers& numbers, messages::LocalModel& model) {
  messages::LocalModel::Triangle& out = model.triangles[at(model.triangle_count++)];
  out.surface = candidate.surface;
  out.triangle = candidate.triangle;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const int vertex = triangle[corner];
    const std::size_t place = numbers.place(candidate.surface, vertex);
    if (numbers.number(place) < 0) {
      numbers.set(place, candidate.surface, vertex, model.vertex_count);
      model.previous_world_m[at(model.vertex_count)] = to_array(frames.previous_m[at(vertex)]);
      model.current_world_m[at(model.vertex_count)] = to_array(frames.current_m[at(vertex)]);
      ++model.vertex_count;
    }
    out.vertices[corner] = numbers.number(place);
  }
}

/// Walks from the place along the line until the string is long enough: +1 towards the insertion, -1 to the origin.
Vec3 string_end(const LineView& line, const LinePlace& place, int direction) {
  const int last = static_cast<int>(line.points_m.size()) - 1;
  int point = direction > 0 ? std::min(place.segment + 1, last) : place.segment;
  double length_m = (line.points_m[at(point)] - place.position_m).norm();
  while (length_m < kShortestString_m && point + direction >= 0 && point + direction <= last) {
    length_m += (line.points_m[at(point + direction)] - line.points_m[at(point)]).norm();
    point += direction;
  }
  return line.points_m[at(point)];
}

}  // namespace

/// The nearest triangles so far, farthest on top. One more than a patch holds: it says how far the coverage goes.
class LocalPatch::NearestTriangles {
 public:
  explicit NearestTriangles(double search_radius_m) : search_radius_m_(search_radius_m) {}

  bool full() const { return count_ == heap_.size(); }
  double radius_m() const { return full() ? heap_.front().reach_m : search_radius_m_; }

  void offer(const Candidate& candidate) {
    if (candidate.reach_m > search_radius_m_) return;
    if (full()) {
      if (!(candidate < heap_.front())) return;
      std::pop_heap(heap_.begin(), heap_.end());
      --count_;
    }
    heap_[count_++] = candidate;
    std::push_heap(heap_.begin(), heap_.begin() + static_cast<std::ptrdiff_t>(count_));
  }

  std::span<Candidate> sorted() {
    std::sort_heap(heap_.begin(), heap_.begin() + static_cast<std::ptrdiff_t>(count_));
    return {heap_.data(), count_};
  }

 private:
  double search_radius_m_;
  std::array<Candidate, messages::kMaxLocalTriangles + 1> heap_;
  std::size_t count_ = 0;
};

LocalPatch::LocalPatch(std::span<const geometry::TriangleMesh* const> surfaces) {
  surfaces_.reserve(surfaces.size());
  for (const geometry::TriangleMesh* mesh : surfaces) {
    surfaces_.push_back(
        {geometry::TriangleTree(*mesh), std::vector<messages::TriangleTissue>(mesh->triangles.size()), {}, {}});
  }
}

void LocalPatch::set_tissue(int surface, std::vector<messages::TriangleTissue> tissue) {
  surfaces_[at(surface)].tissue = std::move(tissue);
}

void LocalPatch::update_surface(int surface, std::span<const Vec3> previous_m,
                                std::span<const Vec3> current_m) noexcept {
  Surface& here = surfaces_[at(surface)];
  here.previous_m = previous_m;
  here.current_m = current_m;
  here.tree.refit(previous_m, current_m);
}

void LocalPatch::collect(const Vec3& centre_m, NearestTriangles& nearest) const noexcept {
  for (int s = 0; s < surface_count(); ++s) {
    const Surface& surface = surfaces_[at(s)];
    if (surface.current_m.empty()) continue;
    surface.tree.visit_within(centre_m, nearest.radius_m(), [&](int t) {
      nearest.offer({reach_m(centre_m, surface.tree.triangle(t), surface.previous_m, surface.current_m), s, t});
      return nearest.radius_m();
    });
  }
}

void LocalPatch::write(const Vec3& centre_m, messages::LocalModel& model) const noexcept {
  // A small radius first: where it fills the patch, most triangles are never measured.
  NearestTriangles nearest(kFirstRadius_m);
  for (const double radius_m : {kFirstRadius_m, 3.0 * kFirstRadius_m, kSearchRadius_m}) {
    nearest = NearestTriangles(radius_m);
    collect(centre_m, nearest);
    if (nearest.full()) break;
  }
  const std::span<Candidate> sorted = nearest.sorted();
  const auto corners = [&](const Candidate& candidate) -> const std::array<int, 3>& {
    return surfaces_[at(candidate.surface)].tree.triangle(candidate.triangle);
  };
  const std::span<Candidate> kept = sorted.first(fitting_count(sorted, corners));
  model.coverage_centre_world_m = to_array(centre_m);
  model.coverage_radius_m = kept.size() < sorted.size() ? sorted[kept.size()].reach_m : kSearchRadius_m;
  std::sort(kept.begin(), kept.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.surface, a.triangle) < std::tie(b.surface, b.triangle);
  });
  VertexNumbers numbers;
  model.vertex_count = 0;
  model.triangle_count = 0;
  for (const Candidate& candidate : kept) {
    const Surface& surface = surfaces_[at(candidate.surface)];
    const Frames frames{surface.previous_m, surface.current_m};
    add_triangle(candidate, corners(candidate), frames, numbers, model);
    model.triangles[at(model.triangle_count - 1)].tissue = surface.tissue[at(candidate.triangle)];
  }
}

LocalPatch::Place LocalPatch::nearest(const Vec3& p, int first, double radius_m) const noexcept {
  Place place;
  for (int s = first; s < surface_count(); ++s) {
    const Surface& surface = surfaces_[at(s)];
    if (surface.current_m.empty()) continue;
    const geometry::SurfacePlace here = surface.tree.nearest(p, surface.current_m, radius_m);
    if (here.triangle < 0) continue;
    radius_m = here.distance_m;
    place = {s, here.triangle, here.point.barycentric, here.point.position_m};
  }
  return place;
}

messages::LocalLine local_line(std::span<const LineView> lines, const LineHand& hand) noexcept {
  messages::LocalLine result;
  const LineView* chosen = nullptr;
  LinePlace place;
  double nearest_m = kLineReach_m;
  for (const LineView& line : lines) {
    if (line.points_m.size() < 2) continue;
    if (line.muscle == hand.grabbed_muscle && line.muscle >= 0) {
      chosen = &line;
      place = place_at_fraction(line.points_m, line.fractions, hand.grab_fraction);
      break;
    }
    const LinePlace here = nearest_place(line.points_m, line.fractions, hand.tool_m);
    const double counts_m = here.distance_m - (line.muscle == hand.offered_muscle ? kLineLead_m : 0.0);
    if (counts_m > nearest_m) continue;
    nearest_m = counts_m;
    chosen = &line;
    place = here;
  }
  if (chosen == nullptr) return result;
  const bool in_hand = hand.grabbed_muscle >= 0 && chosen->muscle == hand.grabbed_muscle;
  const Vec3 proximal_m = string_end(*chosen, place, -1);
  const Vec3 distal_m = string_end(*chosen, place, +1);
  const Vec3 bend_m = in_hand ? hand.tool_m : place.position_m;
  result.muscle = chosen->muscle;
  result.fraction = place.fraction;
  result.grab_point_world_m = to_array(place.position_m);
  result.proximal_point_world_m = to_array(proximal_m);
  result.distal_point_world_m = to_array(distal_m);
  result.tension_N = chosen->tension_N;
  result.length_m = (bend_m - proximal_m).norm() + (distal_m - bend_m).norm();
  result.stiffness_N_m = std::max(0.0, chosen->stiffness_N_m);
  result.damping_Ns_m = std::max(0.0, chosen->damping_Ns_m);
  return result;
}

}  // namespace myotact::simulation

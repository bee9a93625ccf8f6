#include "haptics/moving_surface.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace myotact::haptics {

namespace {

constexpr double kLargest_m = 1000.0;  // nothing of the scene is farther; squares stay far from overflow

bool is_place(const std::array<double, 3>& position_m) {
  return std::all_of(position_m.begin(), position_m.end(), [](double x) { return std::abs(x) < kLargest_m; });
}

double played(const messages::LocalModel& model, std::uint64_t now_ns) {
  if (now_ns <= model.published_at_ns) return 0.0;
  const std::uint64_t age_ns = now_ns - model.published_at_ns;
  return age_ns >= model.dt_ns ? 1.0 : static_cast<double>(age_ns) / static_cast<double>(model.dt_ns);
}

/// A vertex when this share of its way is played. One that rests rests to the bit, so that what was computed holds.
Vec3 place_m(const messages::LocalModel& model, std::size_t vertex, double share) {
  const Vec3 previous_m = to_vec3(model.previous_world_m[vertex]), current_m = to_vec3(model.current_world_m[vertex]);
  return share >= 1.0 ? current_m : Vec3(previous_m + share * (current_m - previous_m));
}

bool all_finite(const std::array<double, 9>& matrix) {
  return std::all_of(matrix.begin(), matrix.end(), [](double x) { return std::isfinite(x); });
}

bool is_sound(const messages::LocalGrip& grip) {
  const auto is_vector = [](const std::array<double, 3>& v) { return to_vec3(v).allFinite(); };
  return is_place(grip.point_rest_m) && is_place(grip.position_world_m) && is_vector(grip.velocity_world_m_s) &&
         is_vector(grip.acceleration_world_m_s2) && is_vector(grip.force_world_N) && all_finite(grip.mobility_1_kg) &&
         all_finite(grip.stiffness_1_s2) && all_finite(grip.damping_1_s);
}

}  // namespace

bool is_sound(const messages::LocalModel& model) noexcept {
  if (model.vertex_count < 0 || model.vertex_count > messages::kMaxLocalVertices) return false;
  if (model.triangle_count < 0 || model.triangle_count > messages::kMaxLocalTriangles) return false;
  for (int i = 0; i < model.vertex_count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (!is_place(model.previous_world_m[at]) || !is_place(model.current_world_m[at])) return false;
  }
  const auto is_finite = [](double x) { return std::isfinite(x); };
  for (int i = 0; i < model.triangle_count; ++i) {
    const messages::LocalModel::Triangle& triangle = model.triangles[static_cast<std::size_t>(i)];
    for (const std::int32_t vertex : triangle.vertices) {
      if (vertex < 0 || vertex >= model.vertex_count) return false;
    }
    if (triangle.tissue.tissue < messages::Tissue::Muscle || triangle.tissue.tissue > messages::Tissue::Skin)
      return false;
    if (!is_finite(triangle.tissue.fibre_edges[0]) || !is_finite(triangle.tissue.fibre_edges[1])) return false;
  }
  const messages::LocalContact& contact = model.contact;
  if (!all_finite(contact.compliance_m_N) || !to_vec3(contact.force_world_N).allFinite()) return false;
  if (!is_sound(model.grip)) return false;
  const messages::LocalLine& line = model.line;
  const bool line_is_finite = is_finite(line.tension_N) && is_finite(line.length_m) && is_finite(line.stiffness_N_m) &&
                              is_finite(line.damping_Ns_m) && is_place(line.proximal_point_world_m) &&
                              is_place(line.distal_point_world_m);
  return is_place(model.coverage_centre_world_m) && std::isfinite(model.coverage_radius_m) && line_is_finite;
}

void MovingSurface::begin_tick(const messages::LocalModel& model, std::uint64_t now_ns, bool is_new) noexcept {
  if (is_new || model_ == nullptr) {
    adopt(model);
  } else {
    from_m_ = to_m_;
  }
  const double s = played(model, now_ns);
  double largest_squared_m2 = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(model.vertex_count); ++i) {
    to_m_[i] = place_m(model, i, s);
    largest_squared_m2 = std::max(largest_squared_m2, (to_m_[i] - from_m_[i]).squaredNorm());
  }
  largest_motion_m_ = std::sqrt(largest_squared_m2);
  last_ns_ = now_ns;
}

std::size_t MovingSurface::slot_of(std::int32_t surface, std::int32_t triangle) noexcept {
  const auto mixed =
      static_cast<std::uint32_t>(surface) * 73856093u ^ static_cast<std::uint32_t>(triangle) * 2654435761u;
  return (mixed >> 8) % kSlots;
}

int MovingSurface::find(std::int32_t surface, std::int32_t triangle) const noexcept {
  for (std::size_t slot = slot_of(surface, triangle); slots_[slot] != 0; slot = (slot + 1) % kSlots) {
    const int local = slots_[slot] - 1;
    const messages::LocalModel::Triangle& found = triangles_[static_cast<std::size_t>(local)];
    if (found.surface == surface && found.triangle == triangle) return local;
  }
  return -1;
}

void MovingSurface::adopt(const messages::LocalModel& model) noexcept {
  const Vertices old_m = to_m_;
  const double s = played(model, last_ns_);
  for (std::size_t i = 0; i < static_cast<std::size_t>(model.vertex_count); ++i) {
    from_m_[i] = place_m(model, i, s);
  }
  // The old triangles are still in place while the new ones look for themselves among them; most are where they were.
  const auto same = [&](int i, const messages::LocalModel::Triangle& fresh) {
    const messages::LocalModel::Triangle& old = triangles_[static_cast<std::size_t>(i)];
    return i < known_count_ && old.surface == fresh.surface && old.triangle == fresh.triangle;
  };
  bool is_same_list = model.triangle_count == known_count_;
  for (int i = 0; i < model.triangle_count; ++i) {
    const messages::LocalModel::Triangle& fresh = model.triangles[static_cast<std::size_t>(i)];
    const bool is_here = same(i, fresh);
    is_same_list = is_same_list && is_here;
    const int old = is_here ? i : find(fresh.surface, fresh.triangle);
    if (old < 0) continue;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      from_m_[static_cast<std::size_t>(fresh.vertices[corner])] =
          old_m[static_cast<std::size_t>(triangles_[static_cast<std::size_t>(old)].vertices[corner])];
    }
  }
  std::copy_n(model.triangles.begin(), model.triangle_count, triangles_.begin());
  known_count_ = model.triangle_count;
  if (!is_same_list) number_triangles();
  model_ = &model;
  ++adopted_count_;
}

void MovingSurface::number_triangles() noexcept {
  slots_.fill(0);
  for (int i = 0; i < known_count_; ++i) {
    const messages::LocalModel::Triangle& triangle = triangles_[static_cast<std::size_t>(i)];
    std::size_t slot = slot_of(triangle.surface, triangle.triangle);
    while (slots_[slot] != 0) slot = (slot + 1) % kSlots;
    slots_[slot] = static_cast<std::int16_t>(i + 1);
  }
}

Vec3 MovingSurface::motion_m(int local, const std::array<double, 3>& barycentric) const noexcept {
  return point_m(local, barycentric, 1.0) - point_m(local, barycentric, 0.0);
}

Vec3 MovingSurface::point_m(int local, const std::array<double, 3>& barycentric, double fraction) const noexcept {
  return barycentric[0] * corner_m(local, 0, fraction) + barycentric[1] * corner_m(local, 1, fraction) +
         barycentric[2] * corner_m(local, 2, fraction);
}

Vec3 MovingSurface::fibre_W(int local) const noexcept {
  const std::array<float, 2>& edges = triangle(local).tissue.fibre_edges;
  const Vec3 origin_m = corner_m(local, 0, 1.0);
  return static_cast<double>(edges[0]) * (corner_m(local, 1, 1.0) - origin_m) +
         static_cast<double>(edges[1]) * (corner_m(local, 2, 1.0) - origin_m);
}

Mat3 MovingSurface::frame_W(int local, double fraction) const noexcept {
  const Vec3 a = corner_m(local, 0, fraction);
  const Vec3 along = corner_m(local, 1, fraction) - a;
  const Vec3 normal = along.cross(corner_m(local, 2, fraction) - a);
  Mat3 frame = Mat3::Identity();
  if (!(normal.squaredNorm() > 0.0)) return frame;  // a triangle without area has no side
  frame.col(0) = along.normalized();
  frame.col(2) = normal.normalized();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

}  // namespace myotact::haptics

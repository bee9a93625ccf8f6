#include "haptics/proxy/moving_surface.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <Eigen/Geometry>

#include "core/at.h"

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

using Frame = Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic>>;  // a column a vertex

Frame frame_m(const std::array<std::array<double, 3>, messages::kMaxLocalVertices>& positions_m, int count) {
  return {positions_m.front().data(), 3, count};
}

/// When this share of its way is played. What rests then rests to the bit, so that what was computed holds.
Vec3 place_m(const Vec3& previous_m, const Vec3& current_m, double share) {
  return share >= 1.0 ? current_m : Vec3(previous_m + share * (current_m - previous_m));
}

/// Of the time that is left of the model's step after `last_ns`, what is gone by `now_ns`.
double share_until(const messages::LocalModel& model, std::uint64_t last_ns, std::uint64_t now_ns) {
  const std::uint64_t end_ns = model.published_at_ns + model.dt_ns;
  if (now_ns >= end_ns || last_ns >= end_ns) return 1.0;
  return now_ns <= last_ns ? 0.0 : static_cast<double>(now_ns - last_ns) / static_cast<double>(end_ns - last_ns);
}

/// Order of the triangles in a model.
std::int64_t key_of(std::int32_t surface, std::int32_t triangle) {
  return (std::int64_t{surface} << 32) + triangle;
}

std::int64_t key_of(const messages::LocalModel::Triangle& triangle) {
  return key_of(triangle.surface, triangle.triangle);
}

bool all_finite(const std::array<double, 9>& matrix) {
  return std::all_of(matrix.begin(), matrix.end(), [](double x) { return std::isfinite(x); });
}

/// Without an early exit at the first invalid one, which would cost more than it saves: models are mostly valid.
bool are_places(const Frame& positions_m) {
  return ((positions_m.array().abs() < kLargest_m).count()) == positions_m.size();
}

bool is_sound(const messages::LocalModel::Triangle& triangle, int vertex_count) {
  for (const std::int32_t vertex : triangle.vertices) {
    if (vertex < 0 || vertex >= vertex_count) return false;
  }
  const messages::TriangleTissue& tissue = triangle.tissue;
  return tissue.tissue >= messages::Tissue::Muscle && tissue.tissue <= messages::Tissue::Skin &&
         std::isfinite(tissue.fibre_edges[0]) && std::isfinite(tissue.fibre_edges[1]);
}

bool is_sound(const messages::LocalGrip& grip) {
  const auto is_vector = [](const std::array<double, 3>& v) { return to_vec3(v).allFinite(); };
  return is_place(grip.point_rest_m) && is_place(grip.position_world_m) && is_vector(grip.velocity_world_m_s) &&
         is_vector(grip.acceleration_world_m_s2) && is_vector(grip.force_world_N) && all_finite(grip.mobility_1_kg) &&
         all_finite(grip.stiffness_1_s2) && all_finite(grip.damping_1_s);
}

bool is_sound(const messages::ReportedContacts& reported) {
  if (reported.count < 0 || reported.count > messages::kMaxReportedContacts) return false;
  for (int i = 0; i < reported.count; ++i) {
    const messages::ReportedContact& contact = reported.contacts[at(i)];
    const bool sound = is_place(contact.point_world_m) && to_vec3(contact.normal_world).allFinite() &&
                       std::abs(contact.penetration_m) < kLargest_m;
    if (!sound) return false;
  }
  return is_place(reported.tool_world_m);
}

bool is_sound(const messages::LocalTether& tether) {
  return std::isfinite(tether.stiffness_N_m) && is_place(tether.anchor_world_m) &&
         to_vec3(tether.anchor_velocity_world_m_s).allFinite();
}

}  // namespace

bool is_sound(const messages::LocalModel& model) noexcept {
  if (model.vertex_count < 0 || model.vertex_count > messages::kMaxLocalVertices) return false;
  if (model.triangle_count < 0 || model.triangle_count > messages::kMaxLocalTriangles) return false;
  if (!are_places(frame_m(model.previous_world_m, model.vertex_count))) return false;
  if (!are_places(frame_m(model.current_world_m, model.vertex_count))) return false;
  for (int i = 0; i < model.triangle_count; ++i) {
    const messages::LocalModel::Triangle& triangle = model.triangles[at(i)];
    if (i > 0 && !(key_of(model.triangles[at(i - 1)]) < key_of(triangle))) return false;
    if (!is_sound(triangle, model.vertex_count)) return false;
  }
  const auto is_finite = [](double x) { return std::isfinite(x); };
  const messages::LocalContact& contact = model.contact;
  if (!all_finite(contact.compliance_m_N) || !to_vec3(contact.force_world_N).allFinite()) return false;
  if (!is_sound(model.grip) || !is_sound(model.reported) || !is_sound(model.tether)) return false;
  const messages::LocalLine& line = model.line;
  const bool line_is_finite = is_finite(line.tension_N) && is_finite(line.length_m) && is_finite(line.stiffness_N_m) &&
                              is_finite(line.damping_Ns_m) && is_place(line.proximal_point_world_m) &&
                              is_place(line.distal_point_world_m);
  return is_place(model.coverage_centre_world_m) && std::isfinite(model.coverage_radius_m) && line_is_finite;
}

void MovingSurface::begin_tick(const messages::LocalModel& model, std::uint64_t now_ns, bool is_new,
                               double lead_share) noexcept {
  if ((is_new || model_ == nullptr) && !has_list_of(model)) {
    adopt_list(model, lead_share);
  } else {
    from_m_.leftCols(vertex_count_) = to_m_.leftCols(vertex_count_);
  }
  model_ = &model;
  const double s = played(model, now_ns), share = share_until(model, last_ns_, now_ns);
  const Frame previous_m = frame_m(model.previous_world_m, vertex_count_);
  const Frame current_m = frame_m(model.current_world_m, vertex_count_);
  double largest_squared_m2 = 0.0;
  for (int i = 0; i < vertex_count_; ++i) {
    const Vec3 led_m = lead_share * (current_m.col(i) - previous_m.col(i));
    lead_m_.col(i) = place_m(lead_m_.col(i), led_m, share);
    to_m_.col(i) = place_m(previous_m.col(i), current_m.col(i), s) + lead_m_.col(i);
    largest_squared_m2 = std::max(largest_squared_m2, (to_m_.col(i) - from_m_.col(i)).squaredNorm());
  }
  largest_motion_m_ = std::sqrt(largest_squared_m2);
  last_ns_ = now_ns;
}

int MovingSurface::find(std::int32_t surface, std::int32_t triangle) const noexcept {
  const auto begin = triangles_.begin(), end = begin + known_count_;
  const std::int64_t key = key_of(surface, triangle);
  const auto found =
      std::lower_bound(begin, end, key, [](const auto& t, std::int64_t wanted) { return key_of(t) < wanted; });
  return found != end && key_of(*found) == key ? static_cast<int>(found - begin) : -1;
}

/// Whether the model holds the same triangles on the same vertices as the last one.
bool MovingSurface::has_list_of(const messages::LocalModel& model) const noexcept {
  static_assert(sizeof(messages::LocalModel::Triangle) == 8 * 4);  // nothing between the members
  const auto bytes = sizeof(messages::LocalModel::Triangle) * static_cast<std::size_t>(known_count_);
  return model.triangle_count == known_count_ && model.vertex_count == vertex_count_ &&
         std::memcmp(model.triangles.data(), triangles_.data(), bytes) == 0;
}

void MovingSurface::adopt_list(const messages::LocalModel& model, double lead_share) noexcept {
  std::array<std::int32_t, messages::kMaxLocalVertices> before;  // the same vertices in the old model
  before.fill(-1);
  // Both lists ascend: one walk along both meets every triangle that both hold.
  for (int fresh = 0, old = 0; fresh < model.triangle_count; ++fresh) {
    const messages::LocalModel::Triangle& triangle = model.triangles[at(fresh)];
    while (old < known_count_ && key_of(triangles_[at(old)]) < key_of(triangle)) ++old;
    const bool is_known = old < known_count_ && key_of(triangles_[at(old)]) == key_of(triangle);
    places_before_[at(fresh)] = static_cast<std::int16_t>(is_known ? old : -1);
    if (!is_known) continue;
    for (std::size_t i = 0; i < 3; ++i) before[at(triangle.vertices[i])] = triangles_[at(old)].vertices[i];
  }
  const double s = played(model, last_ns_);
  const Frame previous_m = frame_m(model.previous_world_m, model.vertex_count);
  const Frame current_m = frame_m(model.current_world_m, model.vertex_count);
  const Vertices leads_m = lead_m_;
  for (int i = 0; i < model.vertex_count; ++i) {
    if (before[at(i)] >= 0) {
      from_m_.col(i) = to_m_.col(before[at(i)]);
      lead_m_.col(i) = leads_m.col(before[at(i)]);
    } else {
      lead_m_.col(i) = lead_share * (current_m.col(i) - previous_m.col(i));
      from_m_.col(i) = place_m(previous_m.col(i), current_m.col(i), s) + lead_m_.col(i);
    }
  }
  std::copy_n(model.triangles.begin(), model.triangle_count, triangles_.begin());
  known_count_ = model.triangle_count;
  vertex_count_ = model.vertex_count;
  ++list_count_;
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

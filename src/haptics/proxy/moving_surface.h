#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/vector.h"
#include "geometry/closest_point.h"
#include "messages/local_model.h"

namespace myotact::haptics {

/// Whether a model can be used: counts, indices and tissues in range, triangles in order, numbers finite and places
/// within 1 km. Real-time safe.
bool is_sound(const messages::LocalModel& model) noexcept;

/// The surface near the tool during one tick, which runs from `fraction` 0 (end of the last tick) to 1 (now).
///
///   model:  previous ---- s = (now - published) / dt ---- current, then held;  + lead
///   tick:             from ====== to
///
/// A step is played while the next one is computed, and so comes late by one: the surface may lead by a share of the
/// step's way. The lead changes evenly over a step. A new model carries on from where the surface was: its vertices
/// start where the same triangles' corners ended, so that an early or late model moves the surface and never makes it
/// jump. Triangles that the old model did not hold start where the new one has them at the end of the last tick.
/// Real-time safe.
class MovingSurface {
 public:
  /// Starts the tick that ends at `now_ns`. `model` must be sound and must stay in place until the next call.
  /// `is_new`: it is not the model of the last call. `lead_share`: of the step's way, >= 0.
  void begin_tick(const messages::LocalModel& model, std::uint64_t now_ns, bool is_new,
                  double lead_share = 0.0) noexcept;

  int triangle_count() const noexcept { return model_ == nullptr ? 0 : model_->triangle_count; }
  const messages::LocalModel::Triangle& triangle(int local) const noexcept {
    return triangles_[static_cast<std::size_t>(local)];
  }
  /// Corner 0 .. 2 of a triangle at a fraction of the tick.
  Vec3 corner_m(int local, int corner, double fraction) const noexcept {
    const std::int32_t vertex = triangle(local).vertices[static_cast<std::size_t>(corner)];
    return from_m_.col(vertex) + fraction * (to_m_.col(vertex) - from_m_.col(vertex));
  }
  /// The place of a triangle next to `p_m` at a fraction of the tick.
  geometry::TrianglePoint closest_point(const Vec3& p_m, int local, double fraction) const noexcept {
    return geometry::closest_point_on_triangle(p_m, corner_m(local, 0, fraction), corner_m(local, 1, fraction),
                                               corner_m(local, 2, fraction));
  }
  Vec3 corner_motion_m(int local, int corner) const noexcept {
    const std::int32_t vertex = triangle(local).vertices[static_cast<std::size_t>(corner)];
    return to_m_.col(vertex) - from_m_.col(vertex);
  }
  /// What a point of a triangle moves by over the whole tick.
  Vec3 motion_m(int local, const std::array<double, 3>& barycentric) const noexcept;
  Vec3 point_m(int local, const std::array<double, 3>& barycentric, double fraction) const noexcept;
  /// Columns: along edge 0-1, across it in the plane, normal out of the tissue. Right-handed, orthonormal.
  Mat3 frame_W(int local, double fraction) const noexcept;
  /// Along the fibres of a triangle's tissue at the end of the tick, of any length; zero: none run along it.
  Vec3 fibre_W(int local) const noexcept;
  /// The farthest that any vertex moves in the tick.
  double largest_motion_m() const noexcept { return largest_motion_m_; }
  /// How many lists of triangles there were so far: with another one, places in the model mean other triangles. Models
  /// with the same triangles, as a hand that hardly moves gets them, count once.
  std::uint64_t list_count() const noexcept { return list_count_; }
  /// The place of a triangle in the list before this one, -1: it was not there.
  int place_before(int local) const noexcept { return places_before_[static_cast<std::size_t>(local)]; }
  /// Place of a triangle in the model, by its numbers in the scene; -1: not in it.
  int find(std::int32_t surface, std::int32_t triangle) const noexcept;

 private:
  using Vertices = Eigen::Matrix<double, 3, messages::kMaxLocalVertices>;

  bool has_list_of(const messages::LocalModel& model) const noexcept;
  void adopt_list(const messages::LocalModel& model, double lead_share) noexcept;

  const messages::LocalModel* model_ = nullptr;
  std::array<messages::LocalModel::Triangle, messages::kMaxLocalTriangles> triangles_{};
  std::array<std::int16_t, messages::kMaxLocalTriangles> places_before_{};
  int known_count_ = 0;   // of triangles_
  int vertex_count_ = 0;  // of the places
  Vertices from_m_ = Vertices::Zero();
  Vertices to_m_ = Vertices::Zero();
  Vertices lead_m_ = Vertices::Zero();
  double largest_motion_m_ = 0.0;
  std::uint64_t last_ns_ = 0;  // end of the last tick
  std::uint64_t list_count_ = 0;
};

}  // namespace myotact::haptics

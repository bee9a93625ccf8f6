#pragma once

#include <array>
#include <cstdint>

#include "core/vector.h"
#include "haptics/proxy/moving_surface.h"
#include "haptics/proxy/near_surface.h"
#include "messages/local_model.h"

namespace myotact::haptics {

/// A smooth skin over the triangles, which stand for a curved surface: a quadratic patch a triangle,
///
///   q(b) = sum b_i x_i + 4 sum h_ij b_i b_j n_ij,   h_ij = (n_j - n_i).(x_j - x_i) / 8 >= 0,   n_ij along n_i + n_j
///
/// with n_i the normal at a vertex; h_ij is the rise of an arc over its chord. Neighbours share their edge's curve, so
/// the skin has no gaps, and a sphere kept off it by its nearest point feels the gradient of one potential: no energy
/// comes out of shading. It lies on or above the triangles, so it puts nothing inside; hollows stay flat,
/// which is harmless: there the sphere goes from triangle to triangle without a jump. At ridges, at borders, and where
/// the model ends there is no vertex normal and the skin lies on the triangles.
///
/// At the end of the tick; computed where it is asked for. Real-time safe; one thread.
class CurvedSurface {
 public:
  /// Upper bound of a rise: a hand cannot distinguish a surface that is off by less from the true one.
  static constexpr double kHighest_m = 0.3e-3;
  /// Of the sphere's radius: shorter edges stay straight, since the sphere itself rolls over them; twice as long ones
  /// have all of their rise.
  static constexpr double kShortest = 0.4;
  /// A patch stands off its triangle by no more than this share of the longest edge, and never by more than 4/3
  /// kHighest_m: 4/3 at its middle times the steepest rise that a smooth vertex allows.
  static constexpr double kSteepest = 0.2;

  explicit CurvedSurface(double radius_m) noexcept : shortest_m_(kShortest * radius_m) {}

  /// For another sphere from the next tick on.
  void resize(double radius_m) noexcept;
  void begin_tick(const MovingSurface& surface) noexcept;
  /// The point of the patch over a triangle that is nearest to `p_m`, by Gauss-Newton from the triangle's own.
  NearestPoint nearest(const NearestPoint& on_triangle, const Vec3& p_m) noexcept;
  /// The patch over a triangle stands off it by no more than this.
  double height_m(int local) noexcept;

 private:
  struct Vertex {
    Vec3 normal = Vec3::UnitZ();
    bool is_smooth = false;
  };
  struct Patch {
    std::array<Vec3, 3> corners_m;
    std::array<Vec3, 3> rises_m;  // 4 h n of the edges 0-1, 1-2, 2-0
    double height_m = 0.0;
  };

  void link_vertices() noexcept;
  const Vertex& vertex(int index) noexcept;
  const Patch& patch(int local) noexcept;

  static constexpr std::size_t kCorners = 3 * messages::kMaxLocalTriangles;

  double shortest_m_;
  const MovingSurface* surface_ = nullptr;
  std::uint64_t linked_list_ = 0;
  std::uint64_t version_ = 1;  // of the places of the vertices
  // Corners (3 * triangle + corner) that meet in a vertex, ascending: its first one, and the next after each, -1: none.
  std::array<std::int16_t, messages::kMaxLocalVertices> first_corner_{};
  std::array<std::int16_t, kCorners> next_corner_{};
  std::array<std::uint64_t, messages::kMaxLocalVertices> vertex_version_{};
  std::array<Vertex, messages::kMaxLocalVertices> vertices_{};
  std::array<std::uint64_t, messages::kMaxLocalTriangles> patch_version_{};
  std::array<Patch, messages::kMaxLocalTriangles> patches_{};
};

}  // namespace myotact::haptics

#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/vector.h"
#include "haptics/proxy/half_space_projection.h"
#include "haptics/proxy/moving_surface.h"
#include "messages/local_model.h"

namespace myotact::haptics {

/// The point of one triangle that is nearest to a place.
struct NearestPoint {
  int local = -1;  // the triangle's place in the model
  double distance_m = 0.0;
  Vec3 point_m = Vec3::Zero();
  std::array<double, 3> barycentric{};
};

/// The triangles that a sphere may meet in a tick, and the half-spaces that keep it off them.
///
/// Most of a model's triangles are out of reach: spheres round them, computed when they come and grown by the motion
/// since, leave those out that the way allowed (`travel`) does not reach. A longer way is allowed by
/// collecting anew from where the first one ended. Real-time safe; one thread.
class NearSurface {
 public:
  /// `stand_off`: what stands on the triangles (a smooth skin) is within the way when it comes as near as they do; at
  /// most `highest_m` and `of_edge` of a triangle's longest edge, and nothing where that is below `shortest_m`.
  struct StandOff {
    double highest_m = 0.0;
    double of_edge = 0.0;
    double shortest_m = 0.0;
  };
  NearSurface(double radius_m, const StandOff& stand_off) noexcept : radius_m_(radius_m), stand_off_(stand_off) {}

  /// Another sphere from the next tick on.
  void resize(double radius_m, const StandOff& stand_off) noexcept;
  /// Starts a tick on this surface, which stays where it is until the next call.
  void begin_tick(const MovingSurface& surface, const messages::LocalModel& model) noexcept;
  /// Takes the triangles that a centre may meet that goes at most `travel_m` from `p_m` while the surface moves.
  void collect(const Vec3& p_m, double travel_m) noexcept;

  /// Nearest points of those triangles to `p_m` at this fraction of the tick, and the half-spaces across the lines to
  /// them. Returns the clearance: the nearest distance.
  double linearise(const Vec3& p_m, double fraction) noexcept;
  /// Where the half-spaces let the centre go. In a fold that closes there may be no room for the whole radius: then for
  /// as much of it as there is, at least the present clearance.
  Projection project(const Vec3& goal_m) noexcept;
  /// The part of a straight move from `from_m` along which all triangles are known. Uses up the way allowed.
  Vec3 allowed(const Vec3& from_m, const Vec3& move_m) noexcept;

  /// The points besides the touched one that are nearest to `p_m` at the end of the tick, within `reach_m`: one of each
  /// other surface, and one of another side of `surface`, the touched one, where that is creased; `outward`, unit, from
  /// the touched point to `p_m`. Nearest first. Returns how many; as many as there is room for.
  int nearest_beside(const Vec3& p_m, std::int32_t surface, const Vec3& outward, double reach_m,
                     std::span<NearestPoint> found) const noexcept;

  double clearance_m() const noexcept { return clearance_m_; }
  double travel_left_m() const noexcept { return travel_left_m_; }
  double stand_off_m() const noexcept { return stand_off_m_; }  // of all triangles, at most
  double stand_off_m(int local) const noexcept { return sphere(local).stand_off_m; }
  /// How far the corners of those triangles move in the tick, at most, relative to something that is carried.
  double relative_motion_m(const Vec3& carried_m) const noexcept;
  int count() const noexcept { return near_count_; }
  const NearestPoint& near(int index) const noexcept { return near_[static_cast<std::size_t>(index)]; }
  const Vec3& normal(int index) const noexcept { return half_spaces_[static_cast<std::size_t>(index)].normal; }
  /// Place of the nearest one, -1: there is none.
  int nearest() const noexcept { return nearest_; }
  /// Tests of a point against a triangle in this tick.
  int tests() const noexcept { return tests_; }

 private:
  struct Sphere {
    Vec3 centre_m = Vec3::Zero();
    double radius_m = 0.0;
    double stand_off_m = 0.0;  // of what stands on the triangle
  };

  void enclose_triangles(bool keeps_known) noexcept;
  Sphere enclosed(int local) const noexcept;
  const Sphere& sphere(int local) const noexcept { return spheres_[static_cast<std::size_t>(local)]; }
  void drop_far_candidates() noexcept;
  Projection project_at(const Vec3& goal_m, double radius_m) noexcept;

  static constexpr std::size_t kMost = messages::kMaxLocalTriangles;

  double radius_m_;
  StandOff stand_off_;
  double stand_off_m_ = 0.0;  // on this model
  const MovingSurface* surface_ = nullptr;
  Vec3 coverage_centre_m_ = Vec3::Zero();
  double coverage_m_ = 0.0;  // the centre may go that far from there
  double travel_left_m_ = 0.0;
  int tests_ = 0;

  // Spheres round the model's triangles where they were when computed.
  std::uint64_t enclosed_list_ = 0;
  double moved_m_ = 0.0;  // since then, at most
  std::array<Sphere, kMost> spheres_{};

  std::array<std::int16_t, kMost> candidates_{};
  int candidate_count_ = 0;
  std::array<NearestPoint, kMost> near_{};
  std::array<HalfSpace, kMost> half_spaces_{};
  int near_count_ = 0;
  int nearest_ = -1;
  double clearance_m_ = 0.0;
  double linearised_at_ = -1.0;  // fraction and place of the nearest points at hand
  Vec3 linearised_m_ = Vec3::Zero();
};

}  // namespace myotact::haptics

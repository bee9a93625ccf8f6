#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/vector.h"
#include "haptics/proxy/contact_settings.h"
#include "haptics/proxy/curved_surface.h"
#include "haptics/proxy/friction.h"
#include "haptics/proxy/half_space_projection.h"
#include "haptics/proxy/moving_surface.h"
#include "haptics/proxy/near_surface.h"
#include "messages/tool_state.h"

namespace myotact::haptics {

/// Where the device is.
struct ProxyGoal {
  Vec3 position_m = Vec3::Zero();
  Vec3 velocity_m_s = Vec3::Zero();
};

/// A surface within this of the sphere is one that it may come to rest on within a step [m]: tissue that gives way
/// under half a newton at 500 N/m.
inline constexpr double kBeside_m = 1e-3;

/// Another surface than the contact's, so near that the sphere may rest on it, too.
struct ProxyNeighbour {
  std::int32_t surface = -1;  // -1: none
  std::int32_t triangle = -1;
  std::array<double, 3> barycentric{};
  Vec3 point_m = Vec3::Zero();  // on the tissue
  Vec3 normal = Vec3::UnitZ();  // unit, from there to the sphere's centre
  double gap_m = 0.0;           // between the sphere and the skin over that point
};

/// The contact that carries most of the force.
struct ProxyContact {
  bool active = false;
  std::int32_t surface = -1;
  std::int32_t triangle = -1;
  std::array<double, 3> barycentric{};
  Vec3 point_m = Vec3::Zero();       // on the tissue
  Vec3 normal = Vec3::UnitZ();       // unit, out of the tissue, along what all contacts together push
  Vec3 velocity_m_s = Vec3::Zero();  // of the tissue at the point
  bool sliding = false;
  int bearing = 0;  // how many triangles hold the sphere against the device, 1 to 3
  std::array<ProxyNeighbour, messages::kMaxContactsBeside> beside{};  // nearest first
};

/// Events since the start.
struct ProxyCounters {
  std::uint64_t rescues = 0;      // found inside and put outside
  std::uint64_t over_budget = 0;  // ticks that stopped short of the goal
};

/// A sphere that stands for the tool and stays outside of the moving tissue while the device goes in (god-object:
/// Zilles and Salisbury 1995; a sphere: Ruspini et al. 1997). What is ours is that the surface moves and deforms under
/// it.
///
/// A triangle is convex, so the plane through its nearest point, across the line to the sphere's centre, keeps all of
/// it on one side: a centre that stays r beyond the plane keeps r from the triangle, and the straight way there never
/// crosses it. A tick is therefore a few projections onto such half-spaces:
///
///   for each safe part of the tick (no vertex comes nearer than half of the clearance)
///     carry the centre with the tissue under its anchor
///     half-spaces of all near triangles --> put the centre where they allow (a moving surface hits a resting proxy)
///   then, at the end of the tick, a few times
///     half-spaces of the touched triangles' skins, and of other surfaces that the centre may come to rest on
///       --> towards the device, less friction, by at most half of the clearance
///     half-spaces of all near triangles --> put the centre where they allow
///
/// Real-time safe; one thread.
class Proxy {
 public:
  /// Smallest sphere: a radius below, 0 included, is felt as a point.
  static constexpr double kPoint_m = 1e-4;

  explicit Proxy(const ContactSettings& settings);

  /// From now on the spring between device and sphere is this stiff, > 0, and so damped.
  void couple(double stiffness_N_m, double damping_Ns_m) noexcept {
    settings_.stiffness_N_m = stiffness_N_m;
    settings_.damping_Ns_m = damping_Ns_m;
    friction_.couple(stiffness_N_m);
  }
  /// From now on the sphere is this large. Its middle stays outside where it is, and what comes to lie inside of a
  /// larger sphere pushes it off in the next tick, into no other surface; what it stuck to is let go.
  void resize(double radius_m) noexcept;
  /// Advances to the end of the surface's tick, `dt_s` > 0 long.
  void tick(const MovingSurface& surface, const messages::LocalModel& model, const ProxyGoal& goal,
            double dt_s) noexcept;
  /// No surface is known: the proxy is where the device is.
  void follow(const Vec3& position_m) noexcept;

  const Vec3& position_m() const noexcept { return p_m_; }
  const ProxyContact& contact() const noexcept { return contact_; }
  const ProxyCounters& counters() const noexcept { return counters_; }

 private:
  /// The place on the tissue that the sphere sticks to, and where its centre is from there.
  struct Anchor {
    bool held = false;
    std::int32_t surface = -1;
    std::int32_t triangle = -1;
    std::array<double, 3> barycentric{};
    Vec3 offset_T_m = Vec3::Zero();  // in the triangle's frame
    int local = -1;                  // its place in the model of this tick, -1: none
  };
  struct Tick {
    const MovingSurface* surface = nullptr;
    ProxyGoal goal;
    double dt_s = 0.0;
    bool slipped = false;
    bool rubbed = false;  // was held by the surface
    Vec3 rubbed_from_m = Vec3::Zero();
    int ways = 0;  // how often it was allowed a longer one
  };

  double longest_way_m(const Tick& tick) const noexcept;
  bool allow_more(Tick& tick, double fraction) noexcept;
  void move_towards(const Vec3& target_m) noexcept;
  void carry(Tick& tick) noexcept;
  void put_outside(Tick& tick, double fraction) noexcept;
  void seek_goal(Tick& tick) noexcept;
  void find_touching() noexcept;
  void keep_off(std::span<const NearestPoint> points, double radius_m) noexcept;
  void keep_off_others(const MovingSurface& surface) noexcept;
  Projection press(Tick& tick) noexcept;
  Vec3 free_target_m(const Tick& tick) const noexcept;
  Vec3 slide(const Projection& held, Tick& tick) noexcept;

  bool rescue_if_inside(const MovingSurface& surface) noexcept;
  void place(const MovingSurface& surface, const Vec3& goal_m) noexcept;
  void remember_home(const MovingSurface& surface) noexcept;

  void find_anchor(const MovingSurface& surface) noexcept;
  Vec3 anchored_m(const MovingSurface& surface, double fraction) const noexcept;
  void settle_contact(const Projection& held, const Tick& tick) noexcept;
  void settle_friction(const Tick& tick) noexcept;
  Vec3 seat_motion_m(const Projection& held, const MovingSurface& surface, const Vec3& strongest_m) const noexcept;
  void settle_beside(const MovingSurface& surface) noexcept;
  void set_anchor(const MovingSurface& surface, int local) noexcept;

  ContactSettings settings_;
  Friction friction_;
  bool placed_ = false;
  Vec3 p_m_ = Vec3::Zero();
  Anchor anchor_;
  ProxyContact contact_;
  ProxyCounters counters_;

  NearSurface near_;
  CurvedSurface skin_;
  Vec3 last_goal_m_ = Vec3::Zero();
  std::int32_t home_surface_ = -1;  // what it was nearest to at the end of the last tick: the side it belongs on
  std::int32_t home_triangle_ = -1;
  static constexpr int kMaxTouching = 32;     // triangles round one corner of a bad mesh
  std::array<int, kMaxTouching> touching_{};  // places in near_; after those touched, others that soon may be
  std::array<HalfSpace, kMaxTouching> touching_spaces_{};
  int touching_count_ = 0;
  double felt_clearance_m_ = 0.0;  // to the skin
};

}  // namespace myotact::haptics

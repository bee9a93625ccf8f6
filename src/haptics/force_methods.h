#pragma once

#include <array>
#include <cstdint>

#include "core/vector.h"
#include "messages/local_model.h"

namespace myotact::haptics {

/// How the force on the hand comes about. Proxy is this project's own; the others are the published ways of giving a
/// 60 Hz engine a 1 kHz hand, as published, flaws included, so that they can be compared with it.
enum class ForceMethod : std::int32_t {
  Proxy,        // a sphere kept outside of the surface (proxy.h); bones in hand move between models (bone_drag.h)
  Penetration,  // A: reported depth, carried on by the tool's motion, in place of the proxy
  Plane,        // B: plane through the reported point, in place of the proxy
  Pulling,      // C: spring to the reported place of the body in hand, in place of BoneDrag; touch is the proxy's
};

/// What of a report is pressed on: the published methods know one contact a body, so it is the deepest of each body (of
/// two equal ones the first). Collision detection on a mesh reports the edges of neighbouring triangles besides, with
/// tilted normals, which are no walls.
struct PressedContact {
  Vec3 normal_W = Vec3::UnitZ();  // unit, out of the touched body
  double depth_m = 0.0;           // of the tool along it; < 0: apart
  int place = 0;                  // in the report
};

/// From the tool to where nothing is pressed any more, as far as the methods know; F = k way_m.
struct WayOut {
  Vec3 way_m = Vec3::Zero();
  int bearing = -1;      // the contact that bears most, by its place in the report; -1: none is pressed
  double depth_m = 0.0;  // of that one
};

/// Several bodies at once: the published methods do not say. Every contact pushes along its own normal, at most by its
/// own depth, and only by what the others leave of that depth:
///
///   way = sum w_i n_i,   0 <= w_i <= max(0, e_i),   n_i . way = e_i where w_i lies between
///
/// So two bodies side by side press once, as deep as the deeper one; floor and wall press both; the sides of a slot
/// press against each other; and, unlike with a choice by angle, nothing jumps when two normals come near each other.
/// Real-time safe.
class PressedContacts {
 public:
  /// The deepest of each body.
  void take(const messages::ReportedContacts& reported) noexcept;
  void clear() noexcept { count_ = 0; }
  void add(const PressedContact& contact) noexcept;  // beyond kMaxReportedContacts: left out
  WayOut way_out() const noexcept;

  int count() const noexcept { return count_; }
  PressedContact& operator[](int i) noexcept { return contacts_[static_cast<std::size_t>(i)]; }

 private:
  std::array<PressedContact, messages::kMaxReportedContacts> contacts_{};
  int count_ = 0;
};

/// A: between the reports of the engine the reported depth goes on with the tool:
///
///   e_i = e_(i-1) - n . (p_i - p_(i-1)),   F = k e n,   none where e < 0
///
/// e is kept while it is negative, so that contact comes back where it was left. A report puts e back to what the
/// engine found, although the tool has moved since the engine looked: the force jumps by k n . (motion since), in every
/// report while the tool moves. That is the method; it is not mended here. Real-time safe; one thread.
class PenetrationMethod {
 public:
  /// The tool's middle in this tick.
  void move(const Vec3& tool_m) noexcept;
  /// A new report, sound (moving_surface.h, is_sound); after move().
  void take(const messages::ReportedContacts& reported) noexcept { pressed_.take(reported); }
  WayOut way_out() const noexcept { return pressed_.way_out(); }

 private:
  PressedContacts pressed_;
  Vec3 tool_m_ = Vec3::Zero();
};

/// B: the touched surface is a plane n . x + D = 0 through the reported point until the next report. Depth is that of
/// the lowest point of the tool, a sphere of radius r, as an engine reports it too:
///
///   e = r - (n . p + D),   D = -n . point,   F = k e n, none where e < 0
///
/// so that on a flat surface at rest A and B agree when the report is as new as the tool's place. A plane does not age
/// while the tool moves, but it is flat, and jumps with each report where the surface is not. Real-time safe.
class PlaneMethod {
 public:
  explicit PlaneMethod(double radius_m) : radius_m_(radius_m) {}

  void take(const messages::ReportedContacts& reported) noexcept;
  WayOut way_out(const Vec3& tool_m) const noexcept;

 private:
  struct Plane {
    Vec3 normal_W = Vec3::UnitZ();  // A, B, C
    double offset_m = 0.0;          // D
    int place = 0;                  // in the report
  };
  double radius_m_;
  std::array<Plane, messages::kMaxReportedContacts> planes_{};
  int count_ = 0;
};

struct PullingSettings {
  double stiffness_N_m = 800.0;  // of the spring as the hand feels it, that is after the force scale
  double force_scale = 1.0;      // felt over simulated force
};

/// C: a spring between the tool H and the body in hand,  F = k0 (p_S - p_H).
///
/// S is the point of the body that was at the tool when the hand closed: the nearest point that the engine knows
/// (LocalGrip), and from there as far as it was to the tool. Its place is the newest one that the engine published,
/// held until the next: nothing is foretold, so the hand drags the age of the model behind it like oil. The engine gets
/// the same spring, as from BoneDrag. No damping, no ramp. Real-time safe; one thread.
class PullingMethod {
 public:
  explicit PullingMethod(const PullingSettings& settings);

  /// Force on the hand [N], scaled, of at most `peak_N`. `model`: the newest, null: none. `holds`: the bone button.
  Vec3 tick(const messages::LocalModel* model, const Vec3& tool_m, bool holds, double peak_N) noexcept;

  // ---- as BoneDrag tells it
  std::int32_t body() const noexcept { return body_; }
  const std::array<double, 3>& point_rest_m() const noexcept { return point_rest_m_; }
  double gain() const noexcept { return gain_; }
  double stiffness_N_m() const noexcept { return gain_ * settings_.stiffness_N_m * to_simulated_; }
  const Vec3& target_m() const noexcept { return target_m_; }

 private:
  PullingSettings settings_;
  double to_simulated_;  // by which a felt stiffness or force becomes one of the simulation
  bool held_before_ = false;
  double gain_ = 0.0;
  std::int32_t body_ = -1;
  std::array<double, 3> point_rest_m_{};
  Vec3 offset_m_ = Vec3::Zero();  // from the engine's point to S
  Vec3 point_m_ = Vec3::Zero();   // newest of the engine's point
  Vec3 target_m_ = Vec3::Zero();
};

}  // namespace myotact::haptics

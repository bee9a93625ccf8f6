#pragma once

#include <array>
#include <cstdint>

#include "core/vector.h"
#include "messages/local_model.h"

namespace myotact::haptics {

/// What of a report is pressed on: the published methods know one contact a body, so it is the deepest of each body (of
/// two equal ones the first). Collision detection on a mesh reports the edges of neighbouring triangles besides, with
/// tilted normals; these are ignored.
struct PressedContact {
  Vec3 normal_W = Vec3::UnitZ();  // unit, out of the touched body
  double depth_m = 0.0;           // of the tool along it; < 0: apart
  int place = 0;                  // in the report
};

/// From the tool to where nothing is pressed any more, as far as the methods know; F = k way_m.
struct Depenetration {
  Vec3 way_m = Vec3::Zero();
  int bearing = -1;      // the contact that carries most, by its place in the report; -1: none is pressed
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
  Depenetration depenetration() const noexcept;

  int count() const noexcept { return count_; }
  PressedContact& operator[](int i) noexcept { return contacts_[static_cast<std::size_t>(i)]; }

 private:
  std::array<PressedContact, messages::kMaxReportedContacts> contacts_{};
  int count_ = 0;
};

/// A (Choi et al. 2011): between the reports of the engine the reported depth goes on with the tool:
///
///   e_i = e_(i-1) - n . (p_i - p_(i-1)),   F = k e n,   none where e < 0
///
/// e is kept while it is negative, so that contact comes back where it was left. A report puts e back to what the
/// engine found, although the tool has moved since the engine looked: the force jumps by k n . (motion since), in every
/// report while the tool moves. That is the method; it is not corrected here. Real-time safe; one thread.
class PenetrationMethod {
 public:
  /// The tool's middle in this tick.
  void move(const Vec3& tool_m) noexcept;
  /// A new report, sound (moving_surface.h, is_sound); after move().
  void take(const messages::ReportedContacts& reported) noexcept { pressed_.take(reported); }
  Depenetration depenetration() const noexcept { return pressed_.depenetration(); }

 private:
  PressedContacts pressed_;
  Vec3 tool_m_ = Vec3::Zero();
};

/// B (Choi et al. 2011): the touched surface is a plane n . x + D = 0 through the reported point until the next report.
/// Depth is that of the lowest point of the tool, a sphere of radius r, as an engine reports it too:
///
///   e = r - (n . p + D),   D = -n . point,   F = k e n, none where e < 0
///
/// so that on a flat surface at rest A and B agree when the report is as new as the tool's place. A plane does not age
/// while the tool moves, but it is flat, and jumps with each report where the surface is not. Real-time safe.
class PlaneMethod {
 public:
  explicit PlaneMethod(double radius_m) : radius_m_(radius_m) {}

  void resize(double radius_m) noexcept { radius_m_ = radius_m; }

  /// The tool's middle in this tick.
  void move(const Vec3& tool_m) noexcept { tool_m_ = tool_m; }
  /// A new report, sound (moving_surface.h, is_sound).
  void take(const messages::ReportedContacts& reported) noexcept;
  Depenetration depenetration() const noexcept;

 private:
  struct Plane {
    Vec3 normal_W = Vec3::UnitZ();  // A, B, C
    double offset_m = 0.0;          // D
    int place = 0;                  // in the report
  };
  double radius_m_;
  Vec3 tool_m_ = Vec3::Zero();
  std::array<Plane, messages::kMaxReportedContacts> planes_{};
  int count_ = 0;
};

}  // namespace myotact::haptics

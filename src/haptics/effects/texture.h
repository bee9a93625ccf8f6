#pragma once

#include "core/vector.h"
#include "haptics/effects/relief.h"
#include "haptics/effects/texture_set.h"
#include "haptics/effects/vibration.h"
#include "haptics/proxy/moving_surface.h"
#include "haptics/proxy/proxy.h"

namespace myotact::haptics {

/// How the tool touches in this tick.
struct TextureTouch {
  ProxyGoal device;
  double normal_N = 0.0;         // of the contact, >= 0
  double stiffness_N_m = 800.0;  // of the coupling
  double dt_s = 1e-3;
};

/// What tissue feels like beyond stiffness and friction, as one more force on the hand:
///
///   relief     h(u, v): shifts the surface along the normal n, F = K h n - (N + K h) grad h, the gradient of the
///   energy
///              (K/2) (depth + h)^2, so that what a ridge takes it gives back
///   vibration  of the slide, an auto-regressive process of force and speed; across the slide and the normal, where it
///              does no work on the movement (how a vibration is directed is hardly felt)
///   knock      a decaying ring along the normal, once a touch
///
/// u and v are the way of the tool over the tissue, counted along and across the fibres from the first touch on. Only
/// ways are added up, so nothing jumps where the fibres' direction changes from triangle to triangle or tissue changes,
/// the relief rides on the tissue, and the energy is one of (u, v). A ridge is found again where it was on the way
/// back; after a round trip over fibres of changing direction it may lie shifted. Without fibres u keeps the direction
/// that it had. Real-time safe; one thread.
class Texture {
 public:
  explicit Texture(TextureSettings settings);

  /// Ends the tick that `contact` describes. On the hand [N]; zero without contact.
  Vec3 tick_N(const MovingSurface& surface, const ProxyContact& contact, const TextureTouch& touch) noexcept;
  /// The most that the relief may give back from here: from a crest to a trough. [J]
  double held_J() const noexcept { return held_J_; }

 private:
  const TextureSet& set_of(const MovingSurface& surface, const ProxyContact& contact) noexcept;
  void begin_touch(const TextureSet& set, const ProxyContact& contact, const TextureTouch& touch) noexcept;
  void rotate_axes(const Vec3& normal) noexcept;
  void travel(const ProxyContact& contact, const TextureTouch& touch) noexcept;
  Vec3 relief_N(const TextureSet& set, const ProxyContact& contact, const TextureTouch& touch) noexcept;
  Vec3 vibration_N(const TextureSet& set, const ProxyContact& contact, const TextureTouch& touch) noexcept;
  double knock_N(double dt_s) noexcept;

  TextureSettings settings_;
  Vibration vibration_;
  Vec3 fibre_W_ = Vec3::UnitX();      // of the touched triangle, or the last that had any
  Vec3 along_W_ = Vec3::UnitX();      // of u
  Vec3 across_W_ = Vec3::UnitY();     // of v
  Vec3 shaking_W_ = Vec3::UnitX();    // where the vibration goes
  Vec3 device_m_ = Vec3::Zero();      // of the last tick
  Vec3 velocity_m_s_ = Vec3::Zero();  // of the tool over the tissue, smoothed
  double slide_m_s_ = 0.0;            // its speed while it slips, smoothed
  Eigen::Vector2d place_m_ = Eigen::Vector2d::Zero();
  double held_J_ = 0.0;
  bool touching_ = false;
  double apart_s_ = 1.0;
  Knock knock_;
  double knock_speed_m_s_ = 0.0, knock_age_s_ = 0.0;
};

}  // namespace myotact::haptics

#pragma once

#include "core/vector.h"
#include "haptics/proxy/contact_settings.h"

namespace myotact::haptics {

/// One question to the law: where the sphere is in the plane of the contact, against where nothing would hold it.
struct FrictionTrial {
  Vec3 lag_m = Vec3::Zero();      // from the sphere to where it would be without friction, in the plane of the contact
  Vec3 slipped_m = Vec3::Zero();  // over the tissue, so far in this tick
  double depth_m = 0.0;           // force along the normal over the coupling's stiffness, >= 0
  Vec3 normal = Vec3::UnitZ();    // unit
  Vec3 fibre = Vec3::Zero();      // any length, any slope; zero: alike in all directions
  double stiffness_N_m = 800.0;   // of the coupling, > 0
  double dt_s = 1e-3;             // > 0
};

/// Friction of a sphere on tissue that a spring pulls along, solved for the end of the tick in closed form (Kikuuwe
/// et al. 2005: no chatter, no drift). In lengths of the coupling spring, K the stiffness and N = K depth:
///
///   lag - s = c + b/(K dt) (slipped + s),   c in the ellipse with half-axes mu_along depth, mu_across depth
///
/// s is the further slip, c what Coulomb's part holds back. Of all c the law takes the one that loses most power (s
/// normal to the ellipse), which makes it the ellipse's point nearest to lag - b/(K dt) slipped: one projection.
/// Inside the ellipse nothing moves, however long it lasts.
///
///   mu(v) = mu_d + (mu_s - mu_d) exp(-(v / v_s)^2)   (Stribeck)
///
/// v is the speed of the *tool* over the tissue, as in models with bristles (Canudas de Wit et al. 1995), not of the
/// sphere: the sphere has no mass, and mu that falls with its own speed would throw it back and forth between two
/// ticks. Real-time safe; one thread.
class Friction {
 public:
  explicit Friction(const ContactSettings& settings) : settings_(settings) {}

  /// From now on the coupling spring is this stiff, > 0.
  void couple(double stiffness_N_m) noexcept { settings_.stiffness_N_m = stiffness_N_m; }
  /// How far the sphere slips on, in the plane of the contact. Zero while it sticks.
  Vec3 slip_m(const FrictionTrial& trial) const noexcept;
  /// Ends a tick in contact: how far the sphere slipped in it, and how fast the tool goes over the tissue.
  void settle(double slipped_m, double tool_speed_m_s, double dt_s) noexcept;
  /// Contact was lost: the next one starts stuck.
  void release() noexcept;

  bool sliding() const noexcept { return sliding_; }
  /// Coefficient across the fibres (everywhere on tissue without fibres) at this moment.
  double coefficient() const noexcept;

 private:
  ContactSettings settings_;
  bool sliding_ = false;
  double speed_m_s_ = 0.0;  // that mu follows
  int slow_ticks_ = 0;
};

/// The point of the ellipse x^2/a^2 + y^2/b^2 <= 1 nearest to (x, y); a, b >= 0. Exact to 1e-12 of the larger axis.
Eigen::Vector2d nearest_in_ellipse(const Eigen::Vector2d& point, const Eigen::Vector2d& half_axes) noexcept;

}  // namespace myotact::haptics

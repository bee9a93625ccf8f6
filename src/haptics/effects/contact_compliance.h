#pragma once

#include <array>
#include <cstdint>

#include "core/vector.h"
#include "haptics/proxy/proxy.h"
#include "messages/local_model.h"

namespace myotact::haptics {

/// How the touched tissue gives way between two steps of the simulation, and the coupling spring that goes with it.
///
///   device d o--/\/\-- proxy p, on the surface x + C (F - F_used)     F = K (d - p), both on the tissue
///              K
///
/// x is the surface as played from step to step, F_used and C (the compliance of the touched place, 3 x 3, and c along
/// the normal) are played with it: x and F_used always belong together, so that F_used = F at rest and nothing jumps
/// when a model comes. Both springs in a row are one spring A = 1 / (1/K + c) between the played surface and the device
/// shifted by C F_used: the proxy and its friction work on x, with that device and that spring.
///
/// A is what the device has to render, K is what hides the tissue: A is made no stiffer than the device supports now,
/// and K as stiff as that allows (1/K = 1/A - c). Tissue whose one step is softer than the device's bound is therefore
/// felt as it is, to K / kLargestCoupling_N_m; stiffer tissue and bone as that bound.
/// Once the tissue is known, K becomes softer at once and stiffer slowly (kStiffens_s): c and the room below vary from
/// step to step, and would make the tissue's answer vary with them.
///
/// A sphere that comes to lie on a second surface meets a bone perhaps. K falls to the device's bound on the last
/// millimetre of the way there: were it to fall at the touch, the same force would need a hand 1 mm deeper from one
/// step to the next, and there is none; hand and tissue would swing between both.
///
/// The simulation tells how the surface next to the tool gives way before it is touched, so that a touch is as soft as
/// the tissue from its first tick.
///
/// The matrix matters along the surface: were c taken there, too, a step of the simulation would answer a change of the
/// force by (1/K + c) / (1/K + C) times as much, ten times where a strand gives way to the side only. Directions in
/// which the tissue is softer than A are taken as soft as A leaves room for: they lag, which is calm. Real-time safe;
/// one thread.
class ContactCompliance {
 public:
  /// What the device supports from now on [N/m]; next to nothing where it is 0.
  void limit_stiffness(double stiffness_N_m) noexcept;
  /// Plays the model's contact on to `now_ns`. `touching`: what the proxy touched at the end of the last tick; surfaces
  /// that it rests on together give way together. `dt_s` > 0, of the tick.
  void tick(const messages::LocalModel& model, const ProxyContact& touching, std::uint64_t now_ns,
            double dt_s) noexcept;
  /// Nothing is known of the tissue any more: as rigid as before the first contact.
  void forget() noexcept;

  /// That the compliance is of; -1: none.
  std::int32_t surface() const noexcept { return surface_; }
  /// From the device to where it would press as hard into the played surface [m].
  Vec3 shift_m() const noexcept { return given_m_N_ * used_N_; }
  /// What the tissue would have moved by in the last tick, beyond the played surface, if nothing touched it [m]. A
  /// compliance that changes is no motion: it leaves the touched tissue where it is.
  const Vec3& unloaded_moved_m() const noexcept { return unloaded_moved_m_; }
  /// A: > 0, of the spring between the played surface and that place.
  double felt_stiffness_N_m() const noexcept;
  /// Part of a slow motion of the hand that the touched tissue would go along with on a coupling of 800 N/m: 0 where it
  /// is rigid, below 1.
  double softness() const noexcept;
  /// K: > 0, of the spring between tissue and device, for the simulation.
  double coupling_stiffness_N_m() const noexcept;
  /// From the played surface to where the tissue is while the hand feels `on_hand_N` [m].
  Vec3 tissue_shift_m(const Vec3& on_hand_N) const noexcept { return given_m_N_ * (-on_hand_N - used_N_); }

 private:
  double stiffest_N_m() const noexcept;  // that K may be

  double stiffness_N_m_ = 1e-3;
  std::int32_t surface_ = -1;           // that the compliance belongs to
  Mat3 compliance_m_N_ = Mat3::Zero();  // C
  double normal_m_N_ = 0.0;             // c
  double sure_m_N_ = 0.0;               // what K counts on of it
  Mat3 given_m_N_ = Mat3::Zero();       // C where A leaves room for it
  Vec3 normal_ = Vec3::UnitZ();         // of the last touch, unit
  std::array<double, 9> model_rows_{};  // the last that a model said, and
  Mat3 model_m_N_ = Mat3::Zero();       // what of it is sound
  double room_ = 1.0;                   // beside the sphere, 0 .. 1
  Vec3 used_N_ = Vec3::Zero();          // force on the tissue that belongs to the played surface
  Vec3 unloaded_moved_m_ = Vec3::Zero();
  double touched_s_ = 0.0;  // how long without a break; 0: not in the last tick
};

}  // namespace myotact::haptics

#pragma once

#include <cstdint>

#include "core/vector.h"
#include "haptics/proxy/proxy.h"
#include "messages/local_model.h"

namespace myotact::haptics {

/// How the touched tissue gives way between two steps of the simulation, and the coupling spring that goes with it.
///
///   device d o--/\/\-- proxy p, on the surface x + c (F - F_used)     F = K (d - p), both on the tissue
///              K
///
/// x is the surface as played from step to step, F_used and c (the compliance of the touched place along the normal)
/// are played with it: x and F_used always belong together, so that F_used = F at rest and nothing jumps when a model
/// comes. Both springs in a row are one spring A = 1 / (1/K + c) between the played surface and the device shifted by
/// c F_used: the proxy and its friction work on x, with that device and that spring.
///
/// A is what the device has to render, K is what hides the tissue: A is made no stiffer than the device supports now,
/// and K as stiff as that allows (1/K = 1/A - c). Tissue whose one step is softer than the device's bound is therefore
/// felt as it is, to K / kLargestCoupling_N_m; stiffer tissue and bone as that bound. Real-time safe; one thread.
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

  /// From the device to where it would press as hard into the played surface [m].
  Vec3 shift_m() const noexcept { return compliance_m_N_ * used_N_; }
  /// A: > 0, of the spring between the played surface and that place.
  double felt_stiffness_N_m() const noexcept;
  /// K: > 0, of the spring between tissue and device, for the simulation.
  double coupling_stiffness_N_m() const noexcept;
  /// From the played surface to where the tissue is while the hand feels `on_hand_N` [m].
  Vec3 tissue_shift_m(const Vec3& on_hand_N) const noexcept { return compliance_m_N_ * (-on_hand_N - used_N_); }

 private:
  double stiffness_N_m_ = 1e-3;
  std::int32_t surface_ = -1;  // that the compliance belongs to
  double compliance_m_N_ = 0.0;
  Vec3 used_N_ = Vec3::Zero();  // force on the tissue that belongs to the played surface
};

}  // namespace myotact::haptics

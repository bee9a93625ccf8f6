#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/triangle_mesh.h"
#include "haptics/proxy/contact_settings.h"
#include "haptics/proxy/moving_surface.h"
#include "haptics/proxy/proxy.h"
#include "messages/local_model.h"
#include "simulation/touch/local_patch.h"

namespace myotact::measure {

/// A proxy on one surface, still or moving, in lockstep and without a device: what a simulation and a haptic loop do
/// with it, on a virtual clock.
///
///   surface --LocalPatch::write, when the proxy nears the patch's end--> LocalModel --> MovingSurface --> Proxy
class SurfaceTouch {
 public:
  /// A surface at rest at the mesh's own positions. Builds its tree.
  SurfaceTouch(const geometry::TriangleMesh& mesh, const haptics::ContactSettings& contact);

  /// The surface is at `previous_m` at `begin_ns`, moves straight to `current_m` within `dt_ns` and stays there.
  void play(std::vector<Vec3> previous_m, std::vector<Vec3> current_m, std::uint64_t begin_ns, std::uint64_t dt_ns);
  /// The same from where it is now.
  void move_to(std::span<const Vec3> target_m, std::uint64_t begin_ns, std::uint64_t dt_ns);
  /// One tick of the proxy, against the surface at `now_ns`, which never runs backwards. Where the patch does not reach
  /// as far as the way to the device, the tick goes on with a new patch.
  void tick(const haptics::ProxyGoal& goal, std::uint64_t now_ns);
  /// A new proxy: the next tick begins at the device, or outside of the surface where the device is inside.
  void restart(const haptics::ContactSettings& contact);

  const haptics::Proxy& proxy() const { return proxy_; }
  const haptics::ContactSettings& contact() const { return contact_; }
  /// Coupling force on the hand [N]: not limited.
  Vec3 force_N(const haptics::ProxyGoal& goal) const;
  /// The surface at the last tick. Recomputes all vertices when it moved.
  const std::vector<Vec3>& positions_m();
  /// Frames between which the surface moves.
  std::span<const Vec3> previous_m() const { return previous_m_; }
  std::span<const Vec3> current_m() const { return current_m_; }
  /// Wall time of the last tick, without the patches, which are the simulation's work.
  std::uint64_t tick_duration_ns() const { return duration_ns_; }
  std::uint64_t last_refit_ns() const { return refit_ns_; }

 private:
  bool coverage_is_used_up() const;
  void renew_patch(const Vec3& centre_m);
  void advance(const haptics::ProxyGoal& goal, std::uint64_t now_ns, double dt_s);

  haptics::ContactSettings contact_;
  std::vector<Vec3> previous_m_, current_m_, now_m_;
  simulation::LocalPatch patch_;
  messages::LocalModel model_;
  haptics::MovingSurface surface_;
  haptics::Proxy proxy_;
  std::uint64_t begin_ns_ = 0;
  std::uint64_t dt_ns_ = 1;
  std::uint64_t last_ns_ = 0;
  std::uint64_t duration_ns_ = 0;
  std::uint64_t refit_ns_ = 0;
  double now_share_ = -1.0;    // of the way between the frames at which now_m_ is; < 0: to be computed
  bool patch_is_old_ = true;   // another frame came
  bool model_is_new_ = false;  // not yet taken by the proxy
  bool started_ = false;
};

}  // namespace myotact::measure

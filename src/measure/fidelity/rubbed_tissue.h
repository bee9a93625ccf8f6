#pragma once

#include <functional>
#include <vector>

#include "geometry/triangle_mesh.h"
#include "haptics/proxy/moving_surface.h"
#include "haptics/proxy/proxy.h"
#include "simulation/touch/local_patch.h"

namespace myotact::measure {

/// A surface whose motion is known, sent to one proxy as a simulation of 100 Hz would, on a virtual clock of 1 kHz.
class RubbedTissue {
 public:
  static constexpr double kTick_s = 1e-3;
  /// Positions at a time, one a vertex of the mesh.
  using Motion = std::function<void(double time_s, std::vector<Vec3>& positions_m)>;

  /// `tissue`: one a triangle, or none. Without motion the mesh rests.
  RubbedTissue(const geometry::TriangleMesh& mesh, const haptics::ContactSettings& settings,
               std::vector<messages::TriangleTissue> tissue = {}, Motion motion = {});

  /// One tick of the proxy towards a place of the device, which moves there evenly.
  void tick(const Vec3& device_m);

  double time_s() const { return 1e-9 * static_cast<double>(now_ns_); }  // of the last tick
  const haptics::Proxy& proxy() const { return proxy_; }
  const haptics::MovingSurface& surface() const { return surface_; }
  const haptics::ProxyGoal& device() const { return device_; }
  /// On the hand, after a tick.
  Vec3 force_N() const { return force_N_; }
  /// Where the touched material was at rest.
  Vec3 contact_rest_m() const;

 private:
  void publish();

  geometry::TriangleMesh mesh_;
  Motion motion_;
  haptics::ContactSettings settings_;
  simulation::LocalPatch patch_;
  haptics::MovingSurface surface_;
  haptics::Proxy proxy_;
  haptics::ProxyGoal device_;
  messages::LocalModel model_;
  std::vector<Vec3> previous_m_, current_m_;
  std::uint64_t now_ns_ = 0;
  bool started_ = false;
  Vec3 force_N_ = Vec3::Zero();
};

}  // namespace myotact::measure

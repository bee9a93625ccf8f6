#include "measure/probe/surface_touch.h"

#include <algorithm>
#include <array>
#include <utility>

#include "haptics/haptic_loop.h"
#include "realtime/periodic_loop.h"

namespace myotact::measure {

namespace {

/// New patches within one tick, at most: with a million triangles one reaches some tenths of a millimetre farther than
/// the sphere, and a hand at 1 m/s moves a millimetre in a tick.
constexpr int kMostPatches = 32;
/// Of the way that a patch allows: used up, the next tick might be stopped by its end.
constexpr double kUsedUp = 0.5;

}  // namespace

SurfaceTouch::SurfaceTouch(const geometry::TriangleMesh& mesh, const haptics::ContactSettings& contact)
    : contact_(contact),
      previous_m_(mesh.positions_m),
      current_m_(mesh.positions_m),
      patch_(std::array{&mesh}),
      proxy_(contact) {
  patch_.update_surface(0, previous_m_, current_m_);
}

void SurfaceTouch::play(std::vector<Vec3> previous_m, std::vector<Vec3> current_m, std::uint64_t begin_ns,
                        std::uint64_t dt_ns) {
  previous_m_ = std::move(previous_m);
  current_m_ = std::move(current_m);
  begin_ns_ = begin_ns;
  dt_ns_ = std::max<std::uint64_t>(1, dt_ns);
  now_share_ = -1.0;
  patch_is_old_ = true;
  const std::uint64_t start_ns = realtime::steady_now_ns();
  patch_.update_surface(0, previous_m_, current_m_);
  refit_ns_ = realtime::steady_now_ns() - start_ns;
}

void SurfaceTouch::move_to(std::span<const Vec3> target_m, std::uint64_t begin_ns, std::uint64_t dt_ns) {
  play(positions_m(), {target_m.begin(), target_m.end()}, begin_ns, dt_ns);
}

const std::vector<Vec3>& SurfaceTouch::positions_m() {
  double share = 0.0;
  if (last_ns_ > begin_ns_)
    share = std::min(1.0, static_cast<double>(last_ns_ - begin_ns_) / static_cast<double>(dt_ns_));
  if (share == now_share_) return now_m_;
  now_share_ = share;
  now_m_.resize(current_m_.size());
  for (std::size_t i = 0; i < now_m_.size(); ++i) now_m_[i] = (1.0 - share) * previous_m_[i] + share * current_m_[i];
  return now_m_;
}

void SurfaceTouch::renew_patch(const Vec3& centre_m) {
  patch_.write(centre_m, model_);
  ++model_.sequence;
  model_.published_at_ns = begin_ns_;
  model_.dt_ns = dt_ns_;
  patch_is_old_ = false;
  model_is_new_ = true;
}

bool SurfaceTouch::coverage_is_used_up() const {
  const double gone_m = (proxy_.position_m() - to_vec3(model_.coverage_centre_world_m)).norm();
  return gone_m > kUsedUp * std::max(0.0, model_.coverage_radius_m - contact_.radius_m);
}

void SurfaceTouch::advance(const haptics::ProxyGoal& goal, std::uint64_t now_ns, double dt_s) {
  const std::uint64_t start_ns = realtime::steady_now_ns();
  surface_.begin_tick(model_, now_ns, model_is_new_);
  proxy_.tick(surface_, model_, goal, dt_s);
  duration_ns_ += realtime::steady_now_ns() - start_ns;
  model_is_new_ = false;
}

void SurfaceTouch::tick(const haptics::ProxyGoal& goal, std::uint64_t now_ns) {
  const double dt_s = now_ns > last_ns_ ? 1e-9 * static_cast<double>(now_ns - last_ns_) : 1e-3;
  duration_ns_ = 0;
  if (patch_is_old_ || coverage_is_used_up()) renew_patch(started_ ? proxy_.position_m() : goal.position_m);
  advance(goal, now_ns, dt_s);
  started_ = true;
  last_ns_ = now_ns;
  for (int patch = 1; patch < kMostPatches && coverage_is_used_up(); ++patch) {
    const Vec3 before_m = proxy_.position_m();
    renew_patch(before_m);
    advance(goal, now_ns, dt_s);
    if ((proxy_.position_m() - before_m).norm() < 1e-7) break;  // it is where it wants to be
  }
}

void SurfaceTouch::restart(const haptics::ContactSettings& contact) {
  contact_ = contact;
  proxy_ = haptics::Proxy(contact);
  started_ = false;
  patch_is_old_ = true;
}

Vec3 SurfaceTouch::force_N(const haptics::ProxyGoal& goal) const {
  return haptics::coupling_force_N(proxy_, goal, contact_);
}

}  // namespace myotact::measure

#include "measure/fidelity/rubbed_tissue.h"

#include <array>

#include "haptics/haptic_loop.h"

namespace myotact::measure {

namespace {

constexpr std::uint64_t kTick_ns = 1'000'000;
constexpr std::uint64_t kStep_ns = 10'000'000;

simulation::LocalPatch patch_of(const geometry::TriangleMesh& mesh) {
  const std::array<const geometry::TriangleMesh*, 1> surfaces = {&mesh};
  return simulation::LocalPatch(surfaces);
}

}  // namespace

RubbedTissue::RubbedTissue(const geometry::TriangleMesh& mesh, const haptics::ContactSettings& settings,
                           std::vector<messages::TriangleTissue> tissue, Motion motion)
    : mesh_(mesh),
      motion_(std::move(motion)),
      settings_(settings),
      patch_(patch_of(mesh)),
      proxy_(settings),
      previous_m_(mesh.positions_m),
      current_m_(mesh.positions_m) {
  if (!tissue.empty()) patch_.set_tissue(0, std::move(tissue));
}

void RubbedTissue::publish() {
  if (motion_) {
    previous_m_ = current_m_;
    motion_(time_s() + 1e-9 * static_cast<double>(kStep_ns), current_m_);
    if (!started_) motion_(time_s(), previous_m_);
  }
  patch_.update_surface(0, previous_m_, current_m_);
  patch_.write(started_ ? proxy_.position_m() : device_.position_m, model_);
  ++model_.sequence;
  model_.published_at_ns = now_ns_;
  model_.dt_ns = kStep_ns;
}

void RubbedTissue::tick(const Vec3& device_m) {
  device_.velocity_m_s = started_ ? Vec3((device_m - device_.position_m) / kTick_s) : Vec3::Zero();
  device_.position_m = device_m;
  now_ns_ += kTick_ns;
  const bool is_new = !started_ || now_ns_ >= model_.published_at_ns + kStep_ns;
  if (is_new) publish();
  started_ = true;
  surface_.begin_tick(model_, now_ns_, is_new);
  proxy_.tick(surface_, model_, device_, kTick_s);
  force_N_ = haptics::coupling_force_N(proxy_, device_, settings_);
}

Vec3 RubbedTissue::contact_rest_m() const {
  const haptics::ProxyContact& contact = proxy_.contact();
  if (!contact.active) return Vec3::Zero();
  const auto& corners = mesh_.triangles[static_cast<std::size_t>(contact.triangle)];
  Vec3 place_m = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    place_m += contact.barycentric[i] * mesh_.positions_m[static_cast<std::size_t>(corners[i])];
  }
  return place_m;
}

}  // namespace myotact::measure

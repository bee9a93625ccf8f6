#include "measure/fidelity/point_tissue.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "core/at.h"
#include "haptics/haptic_thread.h"

namespace myotact::measure {

namespace {

constexpr double kPlate_m = 0.2;  // side: no path crosses its rim

/// Where the tool rests in the air before it goes down.
constexpr double kStart_m = 2e-3;

}  // namespace

PointPress::PointPress(const PointTissue& tissue, const haptics::HapticSettings& settings,
                       const device::DeviceProfile& profile, const device::HandProfile& hand)
    : tissue_(tissue),
      device_("simulated", (settings.contact.radius_m + kStart_m) * tissue.normal, profile, hand),
      loop_(device_, settings),
      radius_m_(settings.contact.radius_m) {
  const Vec3 x = 0.5 * kPlate_m * tissue.normal.unitOrthogonal(), y = tissue.normal.cross(x);
  // The middle lies off the diagonal between the two triangles.
  const Vec3 middle_m = 0.1 * x - 0.2 * y;
  corners_m_ = {middle_m - x - y, middle_m + x - y, middle_m + x + y, middle_m - x + y};
  device_.set_hand_target({to_array(device_.position_world_m()), {}, 0});
  loop_.prepare(now_ns_ = haptics::kTickPeriod_ns);
  publish();
}

Vec3 PointPress::touching_m() const {
  return radius_m_ * tissue_.normal;
}

void PointPress::tick(const Vec3& hand_target_m, std::uint32_t buttons) {
  now_ns_ += haptics::kTickPeriod_ns;
  device_.set_hand_target({to_array(hand_target_m), {}, buttons});
  loop_.tick(now_ns_);
  for (haptics::HapticTick tick; loop_.ticks().pop(tick);) {  // the only reader of the queue
  }
  if (now_ns_ % static_cast<std::uint64_t>(std::llround(tissue_.dt_s * 1e9)) != 0) return;
  step();
  publish();
}

void PointPress::step() {
  const messages::ToolContact& contact = loop_.tool_state().contact;
  const double h = tissue_.dt_s;
  const double inertia_N_m = tissue_.mass_kg / (h * h);
  touched_ = contact.surface == 0;
  const double spring_N_m = touched_ ? contact.stiffness_N_m : 0.0;
  Vec3 rest_m = Vec3::Zero();  // of the spring, from the touched point where the tissue rests
  if (touched_) {
    rest_m = to_vec3(contact.target_world_m);
    const std::array<int, 3> corners =
        contact.triangle == 0 ? std::array<int, 3>{0, 1, 2} : std::array<int, 3>{0, 2, 3};
    for (std::size_t c = 0; c < 3; ++c) rest_m -= contact.barycentric[c] * corners_m_[at(corners[c])];
  }
  const Vec3 next_m = (inertia_N_m * (now_m_ + h * velocity_m_s_) + spring_N_m * rest_m) /
                      (inertia_N_m + tissue_.stiffness_N_m + spring_N_m);
  velocity_m_s_ = (next_m - now_m_) / h;
  last_m_ = std::exchange(now_m_, next_m);
  used_N_ = spring_N_m * (rest_m - now_m_);
}

void PointPress::publish() {
  auto model = std::make_unique<messages::LocalModel>();
  model->tool_sequence = loop_.tool_state().sequence;
  model->coverage_radius_m = 0.5 * kPlate_m;
  model->vertex_count = 4;
  model->triangle_count = 2;
  for (std::size_t v = 0; v < 4; ++v) {
    model->previous_world_m[v] = to_array(corners_m_[v] + last_m_);
    model->current_world_m[v] = to_array(corners_m_[v] + now_m_);
  }
  model->triangles[0].surface = model->triangles[1].surface = 0;
  model->triangles[0].triangle = 0;
  model->triangles[1].triangle = 1;
  model->triangles[0].vertices = {0, 1, 2};
  model->triangles[1].vertices = {0, 2, 3};
  if (touched_) {
    model->contact.surface = 0;
    model->contact.force_world_N = to_array(used_N_);
    const double inertia_N_m = tissue_.mass_kg / (tissue_.dt_s * tissue_.dt_s);
    for (const int diagonal : {0, 4, 8})
      model->contact.compliance_m_N[at(diagonal)] = tissue_.told_share / (inertia_N_m + tissue_.stiffness_N_m);
  }
  waiting_.push_back(std::move(model));
  if (static_cast<int>(waiting_.size()) <= tissue_.late_steps) return;
  messages::LocalModel& out = loop_.models().back();
  out = *waiting_.front();
  waiting_.pop_front();
  out.sequence = ++sequence_;
  out.published_at_ns = now_ns_;
  out.dt_ns = static_cast<std::uint64_t>(std::llround(tissue_.dt_s * 1e9));
  loop_.models().publish();
}

void Jitter::add(double value, double dt_s) {
  if (count_ == 0) slow_ = value;
  slow_ += (1.0 - std::exp(-2.0 * std::numbers::pi * 20.0 * dt_s)) * (value - slow_);
  sum_ += (value - slow_) * (value - slow_);
  ++count_;
}

double Jitter::rms() const {
  return count_ == 0 ? 0.0 : std::sqrt(sum_ / static_cast<double>(count_));
}

}  // namespace myotact::measure

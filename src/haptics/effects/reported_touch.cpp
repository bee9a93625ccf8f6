#include "haptics/effects/reported_touch.h"

namespace myotact::haptics {

ReportedTouch::ReportedTouch(const Method& method, const ContactSettings& settings)
    : settings_(settings), method_(method) {}

void ReportedTouch::resize(double radius_m) noexcept {
  settings_.radius_m = radius_m;
  if (auto* plane = std::get_if<PlaneMethod>(&method_)) plane->resize(radius_m);
}

/// A report that makes the spring jump from d0 to d1 changes its energy by k (d1^2 - d0^2) / 2; per force k d0, that is
/// a motion of its end.
TouchTick ReportedTouch::tick(const HandTick& hand, double share) noexcept {
  const messages::ReportedContacts nothing;
  const messages::ReportedContacts& reported = hand.model == nullptr ? nothing : hand.model->reported;
  tool_m_ = hand.hand.position_m;
  Vec3 before_m;
  std::visit(
      [&](auto& method) {
        method.move(tool_m_);
        before_m = method.depenetration().way_m;
        if (hand.is_new || hand.model == nullptr) method.take(reported);
        depenetration_ = method.depenetration();
      },
      method_);
  const bool presses = depenetration_.bearing >= 0;
  if (presses) bearing_ = reported.contacts[static_cast<std::size_t>(depenetration_.bearing)];
  const double before_m2 = before_m.squaredNorm();
  TouchTick tick;
  tick.force_N = stiffness_N_m(share) * depenetration_.way_m;
  tick.stiffness_N_m = presses ? stiffness_N_m(share) : 0.0;
  tick.end_m = tool_m_ + depenetration_.way_m;
  if (before_m2 > 0.0) tick.end_moved_m = (0.5 * (depenetration_.way_m.squaredNorm() / before_m2 - 1.0)) * before_m;
  tick.surface = &no_surface_;
  return tick;
}

void ReportedTouch::report(const Vec3& force_N, double share, messages::ToolState& tool) const noexcept {
  tool.proxy_position_world_m = to_array(tool_m_ + depenetration_.way_m);
  if (depenetration_.bearing < 0 || !(share > 0.0)) return;
  const Vec3 normal_W = to_vec3(bearing_.normal_world);
  const Vec3 lowest_m = tool_m_ - settings_.radius_m * normal_W;
  const Vec3 touched_m = lowest_m + depenetration_.depth_m * normal_W;
  const double k = stiffness_N_m(share);
  tool.contact = {bearing_.surface, -1, {}, bearing_.normal_world, to_array(touched_m - force_N / k), k};
  tool.touched_world_m = to_array(touched_m);
}

}  // namespace myotact::haptics

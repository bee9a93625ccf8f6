#include "haptics/effects/proxy_touch.h"

#include <algorithm>

#include "haptics/faults.h"

namespace myotact::haptics {

namespace {

/// A moving hand is ahead of the tissue that is played, by the part of its way that the tissue goes along with, and
/// feels that against the tissue's inertia. So the tissue leads by a part of its last step: a quarter where it is
/// firm, for more swings on thin sheets, and the more the softer it is, half a step at 500 N/m. With three quarters of
/// c A 44 of 75 places of the whole limbs are good, 35 with a quarter everywhere; but where A is large, tissue of
/// 2000 N/m swings. A whole step comes 2 to 4 ms early and gives the hand 0.9 mJ a press.
constexpr double kLeastLead = 0.25, kMostLead = 0.85;

}  // namespace

Vec3 coupling_force_N(const Proxy& proxy, const ProxyGoal& device, const ContactSettings& settings) noexcept {
  const ProxyContact& contact = proxy.contact();
  if (!contact.active) return Vec3::Zero();
  const Vec3 spring_N = settings.stiffness_N_m * (proxy.position_m() - device.position_m);
  const double approach_m_s = std::max(0.0, -contact.normal.dot(device.velocity_m_s - contact.velocity_m_s));
  const double normal_N = spring_N.dot(contact.normal);
  const Vec3 tangential_N = spring_N - normal_N * contact.normal;
  return tangential_N + std::max(0.0, normal_N + settings.damping_Ns_m * approach_m_s) * contact.normal;
}

ProxyTouch::ProxyTouch(const ContactSettings& settings) : settings_(settings), proxy_(settings) {}

TouchTick ProxyTouch::tick(const HandTick& hand, double share) noexcept {
  if (hand.model != nullptr) surface_.begin_tick(*hand.model, hand.now_ns, hand.is_new, lead_share());
  TouchTick tick;
  tick.force_N = force_N(hand, share);
  tick.end_m = proxy_.position_m() - compliance_.shift_m();
  if (proxy_.contact().active) {
    tick.stiffness_N_m = compliance_.felt_stiffness_N_m();
    tick.end_moved_m = hand.dt_s * proxy_.contact().velocity_m_s + compliance_.unloaded_moved_m();
  }
  tick.surface = &surface_;
  tick.contact = proxy_.contact();
  tick.faults = new_faults();
  return tick;
}

double ProxyTouch::lead_share() const noexcept {
  return std::max(kLeastLead, kMostLead * compliance_.softness());
}

Vec3 ProxyTouch::force_N(const HandTick& hand, double share) noexcept {
  const messages::LocalModel* model = hand.model;
  const bool nothing_known = model == nullptr || (model->triangle_count == 0 && !(model->coverage_radius_m > 0.0));
  if (nothing_known) {
    proxy_.follow(hand.hand.position_m);
    compliance_.forget();
    return Vec3::Zero();
  }
  compliance_.limit_stiffness(share * settings_.stiffness_N_m);
  compliance_.tick(*model, proxy_.contact(), hand.now_ns, hand.dt_s);
  ContactSettings felt = settings_;
  felt.stiffness_N_m = compliance_.felt_stiffness_N_m();
  felt.damping_Ns_m *= felt.stiffness_N_m / settings_.stiffness_N_m;  // soft tissue would be pushed out of the way
  const ProxyGoal played{hand.hand.position_m + compliance_.shift_m(), hand.hand.velocity_m_s};
  proxy_.couple(felt.stiffness_N_m, felt.damping_Ns_m);
  proxy_.tick(surface_, *model, played, hand.dt_s);
  return share > 0.0 ? coupling_force_N(proxy_, played, felt) : Vec3::Zero();
}

std::uint32_t ProxyTouch::new_faults() noexcept {
  const ProxyCounters& now = proxy_.counters();
  std::uint32_t faults = 0;
  if (now.rescues != counted_.rescues) faults |= bit(Fault::ProxyRescued);
  if (now.over_budget != counted_.over_budget) faults |= bit(Fault::ProxyBudget);
  counted_ = now;
  return faults;
}

void ProxyTouch::report(const Vec3& force_N, double share, messages::ToolState& tool) const noexcept {
  const Vec3 tissue_shift_m = compliance_.tissue_shift_m(force_N);  // from the played surface
  tool.proxy_position_world_m = to_array(proxy_.position_m() + tissue_shift_m);
  const ProxyContact& contact = proxy_.contact();
  if (!contact.active || !(share > 0.0)) return;
  // What the simulation said is of one surface; a sphere on another one, bone perhaps, is not known to give way.
  const bool is_known = contact.surface == compliance_.surface();
  const Vec3 shift_m = is_known ? tissue_shift_m : Vec3(Vec3::Zero());
  const Vec3 touched_m = contact.point_m + shift_m;
  const double stiffness_N_m = compliance_.coupling_stiffness_N_m();
  tool.contact = {contact.surface,
                  contact.triangle,
                  contact.barycentric,
                  to_array(contact.normal),
                  to_array(touched_m - force_N / stiffness_N_m),
                  stiffness_N_m};
  tool.touched_world_m = to_array(touched_m);
  // The same spring pulls those beside, as soon as the sphere that it pulls comes to lie on them: from where the sphere
  // is, with the same shift, or the seats of one sphere would pull against each other.
  for (std::size_t i = 0; i < contact.beside.size(); ++i) {
    const ProxyNeighbour& near = contact.beside[i];
    if (near.surface < 0) break;
    tool.beside[i] = {near.surface,
                      near.triangle,
                      {near.barycentric[0], near.barycentric[1], 1.0 - near.barycentric[0] - near.barycentric[1]},
                      to_array(near.normal),
                      to_array(near.point_m + shift_m + near.gap_m * near.normal - force_N / stiffness_N_m),
                      stiffness_N_m};
  }
}

}  // namespace myotact::haptics

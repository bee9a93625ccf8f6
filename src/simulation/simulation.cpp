#include "simulation/simulation.h"

#include <algorithm>
#include <cmath>

#include "core/at.h"
#include "core/error.h"
#include "core/text.h"
#include "simulation/follower/bone_fit.h"
#include "simulation/limb/settle.h"
#include "simulation/limb/step.h"
#include "simulation/muscle/activation.h"
#include "simulation/simulation_impl.h"
#include "simulation/touch/tool_springs.h"

namespace myotact::simulation {
namespace {

/// A step that fails is cut in halves this often before it is given up.
constexpr int kMostHalvings = 3;
/// Every so many steps the stiffness of one muscle is refreshed: seven muscles in 0.21 s, as fast as a plot is read.
constexpr int kStepsPerRefresh = 3;

double unit_range(double value) {
  return value >= 0.0 ? std::min(value, 1.0) : 0.0;
}  // NaN becomes 0

}  // namespace

Simulation::Impl::Impl(const anatomy::Specimen& given, const SimulationSettings& chosen)
    : specimen(given),
      settings(chosen),
      limb(specimen, settings.tissue, settings.tendon, settings.contact, settings.fascia),
      workers(chosen.workers),
      surfaces(specimen, limb) {
  limb.gravity_m_s2 = settings.gravity_m_s2;
  excitations.assign(specimen.muscles.size(), 0.0);
  line_agreements.assign(specimen.muscles.size(), LineAgreement{1.0, 1.0});
  workers.run(static_cast<int>(specimen.muscles.size()), [&](int m) {
    if (limb.muscles[at(m)].rigid) return;
    line_agreements[at(m)] = fit_fibres(m);
  });
  for (int m = 0; m < static_cast<int>(specimen.muscles.size()); ++m) {
    const auto found = std::find_if(specimen.lines.begin(), specimen.lines.end(),
                                    [m](const anatomy::MuscleLine& l) { return l.muscle == m; });
    LineGeometry geometry;
    measure_line(*found, limb.skeleton, geometry);
    lines.push_back({&*found, arc_fractions(line_points_W(*found, limb.skeleton)), geometry.length_m});
  }
  if (settings.shapes) fit_followers();
  workers.run(surfaces.count(), [&](int surface) { surfaces.follow(limb, surface, true); });
  if (settings.tether) tether.emplace(*settings.tether, specimen);
  read_out(limb);
}

LineAgreement Simulation::Impl::fit_fibres(int index) {
  LimbMuscle& muscle = limb.muscles[at(index)];
  const bool on_bones = settings.contact != Contact::None;
  const anatomy::Muscle& carried = specimen.muscles[at(index)];
  const std::optional<anatomy::FibreFit>& fit = on_bones ? carried.fibre_fit_on_bones : carried.fibre_fit;
  const bool known =
      muscle.tissue.model == TissueModel::Fem && fit && fit->of == calibration_fingerprint(specimen, index, on_bones);
  if (!known) return calibrate_muscle(specimen, index, limb.skeleton, muscle);
  apply_fit(*fit, muscle.tissue.fibre_map);
  return {fit->force != 0.0 ? fit->force : std::nan(""), 1.0};
}

void Simulation::Impl::fit_followers() {
  const bool any = std::any_of(limb.muscles.begin(), limb.muscles.end(), [](const auto& m) { return m.rigid; });
  if (!any) return;
  const BoneSurfaces bones = make_bone_surfaces(specimen);
  workers.run(static_cast<int>(limb.muscles.size()), [&](int m) {
    LimbMuscle& muscle = limb.muscles[at(m)];
    if (!muscle.follower) return;
    const MuscleTissue& tissue = muscle.tissue;
    fit_to_bones({tissue.mesh, tissue.body, specimen.muscles[at(m)].skin, surfaces.skins()[at(m)], bones},
                 limb.skeleton, *muscle.follower);
  });
}

void Simulation::Impl::place_followers() {
  workers.run(static_cast<int>(limb.muscles.size()), [&](int m) { place_follower(limb, m); });
}

bool Simulation::Impl::find_next_stale() {
  const int count = static_cast<int>(limb.muscles.size());
  for (int k = 1; k <= count; ++k) {
    const int next = (refreshed + k) % count;
    if (limb.muscles[at(next)].sleep && !is_stale(limb, next)) continue;
    refreshed = next;
    return true;
  }
  return false;
}

void Simulation::Impl::rest(int muscle, AfterSettle after_settle) {
  if (settings.sleep && may_sleep(limb, muscle, excitations[at(muscle)], settings.dt_s))
    fall_asleep(limb, muscle, after_settle);
}

/// Two backward-Euler steps of half the length, or more parts where those fail too.
bool Simulation::Impl::advance_in_parts(double dt_s, int halvings) {
  for (int half = 0; half < 2; ++half) {
    push_history(limb);
    const StepReport report = advance(limb, {0.5 * dt_s, false}, workers);
    residual_share = report.residual_share;
    if (report.sound) continue;
    restore_last(limb);
    if (halvings >= kMostHalvings || !advance_in_parts(0.5 * dt_s, halvings + 1)) return false;
  }
  return true;
}

Simulation::Simulation(const anatomy::Specimen& specimen, const SimulationSettings& settings) {
  const std::string defect = anatomy::find_defect(specimen);
  if (!defect.empty()) throw bad_data("specimen", specimen.name, defect);
  if (!(settings.dt_s > 0.0 && settings.dt_s <= 0.1)) {
    throw bad_data("scene", "/dt_s", "is " + to_text(settings.dt_s) + " s; must be in (0, 0.1]");
  }
  if (!settings.tissue.empty() && settings.tissue.size() != specimen.muscles.size()) {
    throw bad_data("scene", "/tissue",
                   "names " + std::to_string(settings.tissue.size()) + " models for " +
                       std::to_string(specimen.muscles.size()) + " muscles; must be one a muscle");
  }
  impl_ = std::make_unique<Impl>(specimen, settings);
}

Simulation::~Simulation() = default;

void Simulation::set_excitation(int muscle, double excitation) {
  impl_->excitations[at(muscle)] = unit_range(excitation);
}

void Simulation::set_joint_locked(int joint, bool locked) {
  if (impl_->limb.skeleton.locked(joint) == locked) return;
  impl_->limb.skeleton.set_locked(joint, locked);
  impl_->limb.now.velocity_rad_s[joint] = 0.0;
  impl_->whole_steps = 0;
}

void Simulation::set_gravity(const Vec3& gravity_m_s2) {
  if (impl_->limb.gravity_m_s2 == gravity_m_s2) return;
  wake_all(impl_->limb);
  impl_->limb.gravity_m_s2 = gravity_m_s2;
}

void Simulation::set_joint_torque(int joint, double torque_Nm) {
  impl_->limb.external_torque_Nm[joint] = std::isfinite(torque_Nm) ? torque_Nm : 0.0;
}

void Simulation::restart() {
  impl_->offered_lines.clear();
  return_to_file_pose(impl_->limb);
}

bool Simulation::settle(std::span<const double> joint_angles_rad, std::span<const double> activations) {
  Impl& in = *impl_;
  const bool usable =
      joint_angles_rad.size() == static_cast<std::size_t>(in.limb.skeleton.joint_count()) &&
      std::all_of(joint_angles_rad.begin(), joint_angles_rad.end(), [](double q) { return std::isfinite(q); });
  if (!usable) return false;
  for (std::size_t m = 0; m < in.limb.muscles.size(); ++m) {
    in.excitations[m] = m < activations.size() ? unit_range(activations[m]) : 0.0;
  }
  const bool settled = settle_limb(in.limb, joint_angles_rad, in.excitations, in.workers);
  refresh_stiffness(in.limb, in.workers);
  for (int m = 0; m < muscle_count(); ++m) in.rest(m, settled ? AfterSettle::Yes : AfterSettle::No);
  in.place_followers();
  in.workers.run(in.surfaces.count(), [&](int surface) { in.surfaces.follow(in.limb, surface, true); });
  if (in.tether) in.tether->restart();
  in.whole_steps = in.settled_steps = 0;
  in.refreshed = -1;
  return settled;
}

void Simulation::step(std::span<const messages::ToolState> tools) {
  Impl& in = *impl_;
  const double dt_s = in.settings.dt_s;
  for (std::size_t m = 0; m < in.limb.muscles.size(); ++m) {
    const anatomy::Muscle& muscle = in.specimen.muscles[m];
    double& activation = in.limb.muscles[m].state.activation;
    activation =
        step_activation(activation, in.excitations[m], {muscle.activation_tau_s, muscle.deactivation_tau_s}, dt_s);
  }
  const TouchableParts touchable{in.specimen, in.surfaces.skins()};
  in.limb.springs = tool_springs(tools, touchable, in.limb);
  const std::vector<ToolSpring> ahead = springs_ahead(tools, touchable, in.surfaces.patch());
  in.limb.springs.insert(in.limb.springs.end(), ahead.begin(), ahead.end());
  wake_disturbed(in.limb, dt_s);
  push_history(in.limb);
  const StepReport report = advance(in.limb, {dt_s, in.whole_steps > 0}, in.workers);
  in.residual_share = report.residual_share;
  bool sound = report.sound;
  ++in.whole_steps;
  if (!sound) {
    in.whole_steps = 0;
    ++in.failed_steps;
    restore_last(in.limb);
    sound = in.advance_in_parts(dt_s, 1);
    if (!sound) stop_moving(in.limb);  // in the last usable pose
  }
  in.place_followers();
  const bool refreshes = in.settled_steps++ % kStepsPerRefresh == 0 && in.find_next_stale();
  place_sleepers(in.limb, refreshes ? in.refreshed : -1, in.workers);
  const bool awake = refreshes && !in.limb.muscles[at(in.refreshed)].sleep;
  // One muscle's stiffness beside the surfaces: it reads the positions that they read.
  in.workers.run(in.surfaces.count() + 1, [&](int task) {
    if (task > 0) in.surfaces.follow(in.limb, task - 1, false);
    if (task == 0 && awake) refresh_muscle_stiffness(in.limb, in.limb.muscles[at(in.refreshed)]);
  });
  if (awake) in.rest(in.refreshed, AfterSettle::No);
  if (in.tether) in.tether->step(tools, dt_s);
  ++in.steps;
  std::vector<int> offered;
  for (std::size_t t = 0; t < tools.size(); ++t) {
    offered.push_back(in.line_at(tools[t], static_cast<int>(t)).muscle);
  }
  in.offered_lines = std::move(offered);
}

double Simulation::time_s() const {
  return impl_->time_s();
}
double Simulation::activation(int muscle) const {
  return impl_->limb.muscles[at(muscle)].state.activation;
}
double Simulation::excitation(int muscle) const {
  return impl_->excitations[at(muscle)];
}
double Simulation::pull_over_line(int muscle) const {
  return impl_->line_agreements[at(muscle)].force;
}
std::optional<anatomy::FibreFit> Simulation::fibre_fit(int muscle) const {
  const MuscleTissue& tissue = impl_->limb.muscles[at(muscle)].tissue;
  if (tissue.model != TissueModel::Fem) return std::nullopt;
  const double force = pull_over_line(muscle);
  const FibreMap& map = tissue.fibre_map;
  return anatomy::FibreFit{calibration_fingerprint(impl_->specimen, muscle, impl_->settings.contact != Contact::None),
                           map.offset,
                           map.scale,
                           map.gain,
                           map.beyond,
                           std::isfinite(force) ? force : 0.0};
}
bool Simulation::asleep(int muscle) const {
  return impl_->limb.muscles[at(muscle)].sleep.has_value();
}
int Simulation::failed_steps() const {
  return impl_->failed_steps;
}

}  // namespace myotact::simulation

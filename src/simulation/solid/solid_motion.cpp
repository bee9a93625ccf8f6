#include "simulation/solid/solid_motion.h"

#include <algorithm>
#include <cmath>

namespace myotact::simulation {
namespace {

/// A step ends where the forces along it have fallen to this part of what they were, or still point onwards.
constexpr double kLineSearchDrop = 0.5;
constexpr int kMostCuts = 12;

}  // namespace

SolidMotion::SolidMotion(const Solid& solid, const SolidLoads& loads, const MotionOptions& options)
    : solid_(solid),
      loads_(loads),
      options_(options),
      system_(solid, loads.held),
      evaluation_(solid.make_evaluation()) {
  set_state(solid.rest_m(), Eigen::VectorXd::Zero(solid.rest_m().size()));
}

void SolidMotion::set_state(const Eigen::VectorXd& position_m, const Eigen::VectorXd& velocity_m_s) {
  now_ = {position_m, velocity_m_s};
  for (const HeldDof& dof : loads_.held) {
    const Eigen::Index k = 3 * dof.node + dof.component;
    now_.position_m[k] = solid_.rest_m()[k] + dof.displacement_m;
    now_.velocity_m_s[k] = 0.0;
  }
  before_ = now_;
  has_history_ = false;
}

void SolidMotion::add_inertia(const TimeRule& rule, bool tangent, Instant& next) {
  next.velocity_m_s = rule.rate_1_s * next.position_m - rule.history(now_.position_m, before_.position_m);
  const Eigen::VectorXd acceleration =
      rule.rate_1_s * next.velocity_m_s - rule.history(now_.velocity_m_s, before_.velocity_m_s);
  for (Eigen::Index node = 0; node < solid_.mass_kg().size(); ++node) {
    const double mass = solid_.mass_kg()[node];
    evaluation_.force_N.segment<3>(3 * node) += mass * acceleration.segment<3>(3 * node);
    if (tangent) {
      evaluation_.stiffness.add_diagonal(static_cast<int>(node), mass * rule.rate_1_s * rule.rate_1_s);
    }
  }
}

void SolidMotion::look(const TimeRule& rule, Solid::Tangent tangent, Instant& next) {
  out_of_balance(solid_, loads_, 1.0, next.position_m, tangent, evaluation_);
  add_inertia(rule, tangent != Solid::Tangent::None, next);
  system_.drop_held(evaluation_.force_N);
}

bool SolidMotion::find_direction(const TimeRule& rule, Instant& next, Eigen::VectorXd& direction) {
  for (const Solid::Tangent tangent : {Solid::Tangent::Exact, Solid::Tangent::Definite}) {
    look(rule, tangent, next);
    system_.hold(evaluation_.stiffness);
    if (!system_.factor.factor(evaluation_.stiffness) || !system_.factor.positive()) continue;
    direction = system_.factor.solve(-evaluation_.force_N);
    system_.drop_held(direction);
    return direction.allFinite();
  }
  return false;
}

/// Every force of a step, inertia included, has a potential. The step goes along the Newton direction as far as that
/// falls; its slope there tells. Nearly always the whole way, and then this costs nothing but the look at the forces
/// that the residual needs anyway.
bool SolidMotion::newton_step(const TimeRule& rule, Instant& next) {
  Eigen::VectorXd direction;
  if (!find_direction(rule, next, direction)) return false;
  const double slope = -evaluation_.force_N.dot(direction);
  const Eigen::VectorXd start = next.position_m;
  double part = 1.0;
  for (int cut = 0; cut < kMostCuts; ++cut) {
    next.position_m = start + part * direction;
    look(rule, Solid::Tangent::None, next);
    const double there = -evaluation_.force_N.dot(direction);
    if (there > -kLineSearchDrop * slope) return true;
    part *= std::isfinite(there) ? std::clamp(slope / (slope - there), 0.1, 0.7) : 0.3;
  }
  return std::isfinite(evaluation_.force_N.norm());
}

bool SolidMotion::step() {
  const TimeRule rule =
      options_.second_order && has_history_ ? second_order(options_.dt_s) : backward_euler(options_.dt_s);
  Instant next = now_;
  for (int k = 0; k < options_.newton_steps; ++k) {
    if (!newton_step(rule, next)) return false;
  }
  residual_share_ = evaluation_.force_N.norm() / (evaluation_.force_scale_N + 1e-30);
  before_ = now_;
  now_ = next;
  has_history_ = true;
  return true;
}

double SolidMotion::kinetic_energy_J() const {
  double energy = 0.0;
  for (Eigen::Index node = 0; node < solid_.mass_kg().size(); ++node) {
    energy += 0.5 * solid_.mass_kg()[node] * now_.velocity_m_s.segment<3>(3 * node).squaredNorm();
  }
  return energy;
}

}  // namespace myotact::simulation

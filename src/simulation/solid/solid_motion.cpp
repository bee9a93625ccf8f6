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
      elastic_(solid.make_evaluation()),
      matrix_(solid.pattern()) {
  if (options.single_precision) {
    single_ = BlockFactor(solid.pattern());
  } else {
    exact_ = ExactBlockFactor(solid.pattern());
  }
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

void SolidMotion::look(const Eigen::VectorXd& position_m, Solid::Tangent tangent) {
  if (known_ == tangent && known_m_ == position_m) return;
  out_of_balance({solid_, loads_}, 1.0, position_m, tangent, elastic_);
  known_ = tangent;
  known_m_ = position_m;
}

void SolidMotion::balance(const TimeRule& rule, Instant& next) {
  next.velocity_m_s = rule.rate_1_s * next.position_m - rule.history(now_.position_m, before_.position_m);
  const Eigen::VectorXd acceleration =
      rule.rate_1_s * next.velocity_m_s - rule.history(now_.velocity_m_s, before_.velocity_m_s);
  residual_N_ = elastic_.force_N;
  for (Eigen::Index node = 0; node < solid_.mass_kg().size(); ++node) {
    residual_N_.segment<3>(3 * node) += solid_.mass_kg()[node] * acceleration.segment<3>(3 * node);
  }
  system_.drop_held(residual_N_);
}

bool SolidMotion::solve(Eigen::VectorXd& direction) {
  const auto with = [&](auto& factor) {
    if (!factor.factor(matrix_) || !factor.positive()) return false;
    direction = factor.solve(-residual_N_);
    return true;
  };
  return options_.single_precision ? with(single_) : with(exact_);
}

bool SolidMotion::find_direction(const TimeRule& rule, Instant& next, Eigen::VectorXd& direction) {
  for (const Solid::Tangent tangent : {Solid::Tangent::Exact, Solid::Tangent::Definite}) {
    look(next.position_m, tangent);
    balance(rule, next);
    std::copy_n(elastic_.stiffness.lower().valuePtr(), matrix_.lower().nonZeros(), matrix_.values());
    for (int node = 0; node < solid_.nodes(); ++node) {
      matrix_.add_diagonal(node, solid_.mass_kg()[node] * rule.rate_1_s * rule.rate_1_s);
    }
    system_.hold(matrix_);
    if (!solve(direction)) continue;
    system_.drop_held(direction);
    return direction.allFinite();
  }
  return false;
}

/// Every force of a step, inertia included, has a potential. The step goes along the Newton direction as far as that
/// falls; its slope there says so. Nearly always the whole way, and what is found there is the start of the next step.
bool SolidMotion::newton_step(const TimeRule& rule, Instant& next) {
  Eigen::VectorXd direction;
  if (!find_direction(rule, next, direction)) return false;
  const double slope = -residual_N_.dot(direction);
  const Eigen::VectorXd start = next.position_m;
  double part = 1.0;
  for (int cut = 0; cut < kMostCuts; ++cut) {
    next.position_m = start + part * direction;
    look(next.position_m, Solid::Tangent::Exact);
    balance(rule, next);
    const double there = -residual_N_.dot(direction);
    if (there > -kLineSearchDrop * slope) return true;
    part *= std::isfinite(there) ? std::clamp(slope / (slope - there), 0.1, 0.7) : 0.3;
  }
  return std::isfinite(residual_N_.norm());
}

bool SolidMotion::step() {
  const TimeRule rule =
      options_.second_order && has_history_ ? second_order(options_.dt_s) : backward_euler(options_.dt_s);
  Instant next = now_;
  for (int k = 0; k < options_.newton_steps; ++k) {
    if (!newton_step(rule, next)) return false;
  }
  residual_share_ = residual_N_.norm() / (elastic_.force_scale_N + 1e-30);
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

#include "simulation/solid/static_solve.h"

#include <algorithm>
#include <cmath>

#include "simulation/linear/block_factor.h"

namespace myotact::simulation {
namespace {

constexpr double kSmallestLoadStep = 1.0 / 1024.0;
/// A guess that folds elements over farther than this is not looked at.
constexpr double kSmallestJ = -0.5;
/// A step ends where the forces along it have fallen to this part of what they were, or still point onwards.
constexpr double kLineSearchDrop = 0.5;
constexpr int kMostCuts = 12;
/// Newton steps without a tenth less residual after which a load step is given up.
constexpr int kMostIdle = 15;

class StaticSolver {
 public:
  StaticSolver(const Solid& solid, const SolidLoads& loads, const StaticOptions& options)
      : solid_(solid),
        loads_(loads),
        options_(options),
        system_(solid, loads.held),
        factor_(solid.pattern()),
        now_(solid.make_evaluation()),
        smallest_step_m_(options.tolerance * size_m(solid)) {}

  StaticResult run(const Eigen::VectorXd& start_m) {
    result_.position_m = x_ = start_m;
    const double largest = 1.0 / std::max(1, options_.load_steps);
    double step = largest;
    while (result_.load < 1.0) {
      const double load = std::min(1.0, result_.load + step);
      if (reach(load < 1.0 - 1e-12 ? load : 1.0)) {
        result_.load = load < 1.0 - 1e-12 ? load : 1.0;
        ++result_.load_steps;
        result_.position_m = x_;
        step = std::min(largest, 2.0 * step);
        continue;
      }
      x_ = result_.position_m;
      step *= 0.5;
      if (step < kSmallestLoadStep) break;
    }
    result_.converged = result_.load >= 1.0;
    finish();
    return result_;
  }

 private:
  static double size_m(const Solid& solid) {
    const Eigen::Map<const Eigen::Matrix3Xd> nodes(solid.rest_m().data(), 3, solid.nodes());
    return (nodes.rowwise().maxCoeff() - nodes.rowwise().minCoeff()).maxCoeff();
  }

  double share() const { return residual_.norm() / (now_.force_scale_N + external_scale_N() + 1e-30); }

  double external_scale_N() const { return loads_.nodal_force_N.size() > 0 ? loads_.nodal_force_N.norm() : 0.0; }

  void look(double load, Solid::Tangent tangent) {
    out_of_balance({solid_, loads_}, load, x_, tangent, now_);
    residual_ = now_.force_N;
    system_.drop_held(residual_);
  }

  /// Displacements of held components still to come at this load.
  Eigen::VectorXd missing(double load) const {
    Eigen::VectorXd gap = Eigen::VectorXd::Zero(x_.size());
    for (const HeldDof& dof : loads_.held) {
      const Eigen::Index k = 3 * dof.node + dof.component;
      gap[k] = solid_.rest_m()[k] + load * dof.displacement_m - x_[k];
    }
    return gap;
  }

  bool factor_tangent(double load, const Eigen::VectorXd& gap, Eigen::VectorXd& right) {
    exact_ = true;
    for (const Solid::Tangent tangent : {Solid::Tangent::Exact, Solid::Tangent::Definite}) {
      look(load, tangent);
      right = -residual_;
      if (gap.squaredNorm() > 0.0) {
        Eigen::VectorXd pushed = now_.stiffness.lower().selfadjointView<Eigen::Lower>() * gap;
        system_.drop_held(pushed);
        right -= pushed;
      }
      system_.hold(now_.stiffness);
      if (factor_.factor(now_.stiffness) && factor_.positive()) {
        return true;
      }
      exact_ = false;
    }
    return false;
  }

  /// An exact Newton step estimates what is left to go. Where the stress vanishes everywhere (free contraction) no
  /// other measure works: the elements' forces are round-off themselves.
  bool is_there(const Eigen::VectorXd& direction) const {
    return exact_ && direction.lpNorm<Eigen::Infinity>() < smallest_step_m_;
  }

  /// Goes along `direction` as far as the energy falls. False when no part of it helps.
  bool search(double load, const Eigen::VectorXd& direction) {
    const double slope = -residual_.dot(direction);
    const Eigen::VectorXd start = x_;
    double part = 1.0;
    for (int cut = 0; cut < kMostCuts; ++cut) {
      x_ = start + part * direction;
      look(load, Solid::Tangent::None);
      const double there = -residual_.dot(direction);  // > 0: still falling
      const bool seen = std::isfinite(there) && now_.smallest_J > kSmallestJ;
      if (seen && there > -kLineSearchDrop * slope) return true;
      part *= seen ? std::clamp(slope / (slope - there), 0.1, 0.7) : 0.3;
    }
    x_ = start;
    return false;
  }

  bool reach(double load) {
    double best = 1e300;
    int idle = 0;
    for (int iteration = 0; iteration < options_.most_iterations; ++iteration) {
      const Eigen::VectorXd gap = missing(load);
      Eigen::VectorXd right;
      if (!factor_tangent(load, gap, right)) return false;
      Eigen::VectorXd direction = factor_.solve(right);
      system_.drop_held(direction);
      ++result_.iterations;
      if (!direction.allFinite()) return false;
      if (gap.squaredNorm() > 0.0) {
        x_ += direction + gap;
        look(load, Solid::Tangent::None);
        if (!(now_.smallest_J > kSmallestJ) || !std::isfinite(residual_.norm())) return false;
      } else if (!search(load, direction)) {
        return share() < options_.tolerance || is_there(direction);
      }
      if (options_.progress) options_.progress(load, share());
      if (share() < options_.tolerance || (gap.squaredNorm() == 0.0 && is_there(direction))) return true;
      idle = share() < 0.9 * best ? 0 : idle + 1;
      best = std::min(best, share());
      if (idle > kMostIdle) return false;
    }
    return false;
  }

  void finish() {
    x_ = result_.position_m;
    look(result_.load, Solid::Tangent::None);
    result_.residual_share = share();
    result_.reaction_N = now_.force_N - residual_;
  }

  const Solid& solid_;
  const SolidLoads& loads_;
  const StaticOptions& options_;
  HeldSystem system_;
  ExactBlockFactor factor_;
  Solid::Evaluation now_;
  Eigen::VectorXd x_, residual_;
  double smallest_step_m_;
  bool exact_ = true;  // the tangent factored last was not projected
  StaticResult result_;
};

}  // namespace

void out_of_balance(const LoadedSolid& loaded, double load, const Eigen::VectorXd& position_m, Solid::Tangent tangent,
                    Solid::Evaluation& out) {
  const auto& [solid, loads] = loaded;
  solid.evaluate(position_m, load * loads.activation, tangent, out);
  for (const PressureFace& face : loads.pressure) {
    add_pressure(face, load, position_m, tangent != Solid::Tangent::None, out);
  }
  if (loads.nodal_force_N.size() > 0) out.force_N -= load * loads.nodal_force_N;
  for (Eigen::Index node = 0; node < solid.mass_kg().size(); ++node) {
    out.force_N.segment<3>(3 * node) -= load * solid.mass_kg()[node] * loads.gravity_m_s2;
  }
}

StaticResult solve_static(const Solid& solid, const SolidLoads& loads, const Eigen::VectorXd& start_m,
                          const StaticOptions& options) {
  return StaticSolver(solid, loads, options).run(start_m);
}

}  // namespace myotact::simulation

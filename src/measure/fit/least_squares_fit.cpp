#include "measure/fit/least_squares_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <unsupported/Eigen/NonLinearOptimization>

namespace myotact::measure {

namespace {

/// Of what cannot be: finite, so that the algorithm's ratios are, and worse than everything.
constexpr double kWorstResidual = 1e100;
/// Of the algorithm's variables, which run through about 3, and of parameters' logarithms: differences over it are good
/// to 1e-8 of smooth functions, and of finite elements that are solved to 1e-8.
constexpr double kFitStep = 1e-4;

/// A parameter p of the algorithm's variable u, which has no bounds: with z = log p or p,
///   z = (z_low + z_high)/2 + (z_high - z_low)/2 sin u,
/// as MINUIT does. It reaches a bound at a finite u, with a slope of zero.
class BoundedMap {
 public:
  explicit BoundedMap(const BoundedParameter& p)
      : p_(p), middle_(0.5 * (scaled(p.low) + scaled(p.high))), half_(0.5 * (scaled(p.high) - scaled(p.low))) {}

  double scaled(double value) const { return p_.logarithmic() ? std::log(value) : value; }
  double of_scaled(double z) const { return std::clamp(p_.logarithmic() ? std::exp(z) : z, p_.low, p_.high); }
  double value(double u) const { return of_scaled(middle_ + half_ * std::sin(u)); }
  double variable(double value) const { return std::asin(std::clamp((scaled(value) - middle_) / half_, -1.0, 1.0)); }
  /// -1, 1 or 0: a millionth of the way between the bounds counts as at one.
  int bound_at(double u) const {
    constexpr double kAtBound = 1.0 - 2e-6;
    return std::sin(u) < -kAtBound ? -1 : std::sin(u) > kAtBound ? 1 : 0;
  }
  /// Step for a difference of z.
  double step() const { return p_.logarithmic() ? kFitStep : kFitStep * half_; }

 private:
  BoundedParameter p_;
  double middle_, half_;
};

/// What the algorithm asks of a function.
class FitFunctor {
 public:
  FitFunctor(const std::vector<BoundedParameter>& parameters, const FitResiduals& residuals)
      : maps_(parameters.begin(), parameters.end()), residuals_(residuals) {}

  int inputs() const { return static_cast<int>(maps_.size()); }
  int values() const { return count_; }

  std::vector<double> values_at(const Eigen::VectorXd& u) const {
    std::vector<double> values;
    for (std::size_t j = 0; j < maps_.size(); ++j) values.push_back(maps_[j].value(u[static_cast<Eigen::Index>(j)]));
    return values;
  }

  Eigen::VectorXd residuals(const std::vector<double>& values) {
    ++evaluations;
    Eigen::VectorXd found = residuals_(values);
    if (count_ == 0) count_ = static_cast<int>(found.size());
    if (found.size() != count_ || !found.allFinite()) found.setConstant(count_, kWorstResidual);
    return found;
  }

  int operator()(const Eigen::VectorXd& u, Eigen::VectorXd& out) {
    out = residuals(values_at(u));
    return 0;
  }

  /// Central differences; to one side where the other cannot be.
  Eigen::VectorXd slope(const std::function<Eigen::VectorXd(double)>& at, double step) {
    const Eigen::VectorXd ahead = at(step), behind = at(-step);
    const bool good_ahead = usable(ahead), good_behind = usable(behind);
    if (good_ahead && good_behind) return (ahead - behind) / (2.0 * step);
    if (!good_ahead && !good_behind) return Eigen::VectorXd::Zero(count_);
    const Eigen::VectorXd here = at(0.0);
    return good_ahead ? (ahead - here) / step : (here - behind) / step;
  }

  int df(const Eigen::VectorXd& u, Eigen::MatrixXd& out) {
    for (Eigen::Index j = 0; j < u.size(); ++j) {
      out.col(j) = slope(
          [&](double step) {
            Eigen::VectorXd moved = u;
            moved[j] += step;
            return residuals(values_at(moved));
          },
          kFitStep);
    }
    return 0;
  }

  /// By z and not by u, whose slope vanishes at the bounds.
  Eigen::MatrixXd scaled_jacobian(const std::vector<double>& values) {
    Eigen::MatrixXd jacobian(count_, inputs());
    for (std::size_t j = 0; j < maps_.size(); ++j) {
      const BoundedMap& map = maps_[j];
      const double z = map.scaled(values[j]);
      // At a bound the step to the outside is clamped to it, so that both sides make one.
      const auto value_after = [&](double step) { return map.of_scaled(z + step); };
      const double ahead = map.scaled(value_after(map.step())), behind = map.scaled(value_after(-map.step()));
      std::vector<double> moved = values;
      moved[j] = map.of_scaled(ahead);
      const Eigen::VectorXd r_ahead = residuals(moved);
      moved[j] = map.of_scaled(behind);
      const Eigen::VectorXd r_behind = residuals(moved);
      const bool good = usable(r_ahead) && usable(r_behind) && ahead > behind;
      jacobian.col(static_cast<Eigen::Index>(j)) =
          good ? Eigen::VectorXd((r_ahead - r_behind) / (ahead - behind)) : Eigen::VectorXd::Zero(count_);
    }
    return jacobian;
  }

  const std::vector<BoundedMap>& maps() const { return maps_; }
  int evaluations = 0;

 private:
  static bool usable(const Eigen::VectorXd& residuals) { return residuals.cwiseAbs().maxCoeff() < kWorstResidual; }

  std::vector<BoundedMap> maps_;
  const FitResiduals& residuals_;
  int count_ = 0;
};

}  // namespace

LeastSquaresFit fit_least_squares(const std::vector<BoundedParameter>& parameters, const FitResiduals& residuals) {
  FitFunctor functor(parameters, residuals);
  Eigen::VectorXd u(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    u[static_cast<Eigen::Index>(j)] = functor.maps()[j].variable(parameters[j].start);
  }
  functor.residuals(functor.values_at(u));  // how many there are
  Eigen::LevenbergMarquardt<FitFunctor> search(functor);
  // A thousandth of the noise's own uncertainty; what the algorithm takes for its own limits is as good an end.
  search.parameters.ftol = 1e-10;
  search.parameters.xtol = 1e-8;
  search.parameters.factor = 1.0;  // first step: the variables run through about 3
  search.parameters.maxfev = 400;
  const auto status = search.minimize(u);
  LeastSquaresFit fit;
  fit.converged = status != Eigen::LevenbergMarquardtSpace::TooManyFunctionEvaluation &&
                  status != Eigen::LevenbergMarquardtSpace::ImproperInputParameters;
  fit.iterations = static_cast<int>(search.iter);
  fit.values = functor.values_at(u);
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    fit.bound.push_back(functor.maps()[j].bound_at(u[static_cast<Eigen::Index>(j)]));
  }
  fit.residuals = functor.residuals(fit.values);
  fit.jacobian = functor.scaled_jacobian(fit.values);
  fit.evaluations = functor.evaluations;
  return fit;
}

}  // namespace myotact::measure

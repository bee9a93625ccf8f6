#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

// Least squares between bounds, by the Levenberg-Marquardt algorithm of MINPACK (More, Garbow, Hillstrom, ANL-80-74,
// 1980) as Eigen has it.

namespace myotact::measure {

/// A free parameter, low < start < high.
struct BoundedParameter {
  double start = 0.0, low = 0.0, high = 0.0;

  /// Of one that is positive the logarithm is sought: scales are unknown by factors.
  bool logarithmic() const { return low > 0.0; }
};

/// Weighted differences between fitted and measured values, always as many. Empty where the values cannot be, which
/// the search takes for very bad.
using FitResiduals = std::function<Eigen::VectorXd(const std::vector<double>& values)>;

struct LeastSquaresFit {
  std::vector<double> values;
  Eigen::VectorXd residuals;  // n
  Eigen::MatrixXd jacobian;   // n x p: their derivatives by the parameters, or by the logarithms of logarithmic ones
  std::vector<int> bound;     // of each parameter: -1 it ended at its lower bound, 1 at the upper, 0 between
  bool converged = false;
  int iterations = 0;   // of the algorithm
  int evaluations = 0;  // of `residuals`, those for derivatives included
};

/// Minimises the sum of squares from the start. Deterministic. `residuals` at the start must not be empty, and have at
/// least as many entries as there are parameters.
LeastSquaresFit fit_least_squares(const std::vector<BoundedParameter>& parameters, const FitResiduals& residuals);

}  // namespace myotact::measure
